// Takes drives back that let go: at the speed that their wheels have, and down to rest.
#pragma once

#include <array>
#include <span>

#include "drover/driver.h"
#include "drover/snapshot.h"
#include "engine/base/kinematics.h"
#include "engine/config.h"

namespace drover::engine {

struct TakeBackInput {
  Time now = kNever;
  Duration dt{};
  std::span<const AxisSnapshot> axes;
  bool guard_has_bus = false;
  Time since = kNever;  ///< they are to be taken back
};

class TakeBack final {
 public:
  explicit TakeBack(const EngineConfig& config);

  void step(const TakeBackInput& input);
  void end() { catches_ = {}; }
  bool active() const;
  /// `rest` where there is nothing to be done.
  AxisCommand command(AxisId id) const;
  /// This drive talks, and its driver is content.
  bool heard(Time now, const AxisSnapshot& axis) const;
  /// This drive has a fault of its own: it is not taken back as long as it has.
  static bool failed(const AxisSnapshot& axis) {
    return axis.state == AxisState::fault && !axis.lapsed;
  }

 private:
  /// One attempt to take an axis back.
  struct Catch {
    bool active = false;
    Time since = kNever;
    Time next = kNever;  ///< not before
    double velocity_radps = 0;
  };
  void begin(const TakeBackInput& input, const AxisSnapshot& axis, Catch& it) const;
  void follow(const TakeBackInput& input, const AxisSnapshot& axis, Catch& it) const;
  bool others_hold(const TakeBackInput& input) const;

  Kinematics base_;
  JointSet driven_;
  Duration stale_;
  double falls_radps2_;
  std::array<Catch, kMaxAxes> catches_{};
};

}  // namespace drover::engine
