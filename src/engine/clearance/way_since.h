// How far the base went since an instant: an answer about the way ahead is older than now.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

#include "drover/time.h"
#include "drover/twist.h"

namespace drover::engine {

struct WaySince {
  // Whichever way it went, never negative.
  double driven_m = 0;
  double turned_rad = 0;
  // With their signs: ahead and counter-clockwise positive.
  double along_m = 0;
  double yaw_rad = 0;
  bool known = false;  ///< the instant is in the memory
};

/// The ways of the last third of a second or more.
class WayMemory final {
 public:
  /// Once a cycle.
  void note(const BodyMotion& body, Time now) {
    const auto& [vx_mps, wz_radps, vy_mps] = body.twist;
    if (!body.known || !std::isfinite(vx_mps + wz_radps + vy_mps)) return forget();
    if (last_ != kNever && now > last_) {
      const double dt_s = to_s(now - last_);
      const double way_m = vx_mps * dt_s;
      const double turn_rad = wz_radps * dt_s;
      here_.driven_m += std::hypot(way_m, vy_mps * dt_s);
      here_.turned_rad += std::abs(turn_rad);
      here_.along_m += way_m;
      here_.yaw_rad += turn_rad;
    }
    last_ = now;
    here_.at = now;
    if (marks_[newest_].at != kNever && now - marks_[newest_].at < kStep) return;
    newest_ = (newest_ + 1) % marks_.size();
    marks_[newest_] = here_;
  }
  /// To the last note. An instant between two marks counts from the earlier one: no way is lost.
  WaySince since(Time t) const {
    for (std::size_t i = 0; i < marks_.size(); ++i) {
      const Mark& mark = marks_[(newest_ + marks_.size() - i) % marks_.size()];
      if (mark.at == kNever) break;
      if (mark.at > t) continue;
      return {here_.driven_m - mark.driven_m, here_.turned_rad - mark.turned_rad,
              here_.along_m - mark.along_m, here_.yaw_rad - mark.yaw_rad, true};
    }
    return {};
  }

 private:
  static constexpr Duration kStep = std::chrono::milliseconds(10);
  struct Mark {
    Time at = kNever;
    double driven_m = 0;
    double turned_rad = 0;
    double along_m = 0;
    double yaw_rad = 0;
  };
  void forget() {
    marks_.fill({});
    last_ = kNever;
  }

  std::array<Mark, 40> marks_{};
  std::size_t newest_ = 0;
  Mark here_;
  Time last_ = kNever;
};

}  // namespace drover::engine
