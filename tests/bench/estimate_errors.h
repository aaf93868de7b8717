// How far an estimate is from the truth of a recorded drive.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "bench/field_record.h"
#include "drover/angle.h"

namespace drover::bench {

inline constexpr double kOut_s = 20;  ///< when an outage begins
inline constexpr double kOutage_s = 30;

/// Of one estimate of one drive.
struct Errors {
  double rms_m = 0, p95_m = 0, max_m = 0;
  double sigma_m = 0;  ///< mean, published
  double heading_rms_rad = 0;
  double two_sigma = 0, three_sigma = 0;  ///< shares of the time
  double outside_s = 0;                   ///< moved beyond its own bound
  double of_the_way = 0;                  ///< error at the end of the outage over the way in it
};

/// From the start of the task on.
class ErrorSum final {
 public:
  void look(const FieldRecord::Tick& tick, const Pose& told, double bound_m) {
    if (tick.since_s < 0) return;
    const double error_m = std::hypot(told.x_m - tick.truth.x_m, told.y_m - tick.truth.y_m);
    if (tick.moves && error_m > bound_m) errors_.outside_s += kTick_s;
    if (tick.since_s >= kOut_s && tick.since_s < kOut_s + kOutage_s) {
      way_m_ += std::abs(tick.truth.vx_mps) * kTick_s;
      errors_.of_the_way = way_m_ > 0 ? error_m / way_m_ : 0;
    }
    if (ticks_++ % kTicksEach != 0) return;
    all_m_.push_back(error_m);
    const double yaw_rad = wrap_rad(told.yaw_rad - tick.truth.yaw_rad);
    square_m2_ += error_m * error_m;
    square_rad2_ += yaw_rad * yaw_rad;
    errors_.sigma_m += told.position_sigma_m;
    errors_.two_sigma += error_m <= 2 * told.position_sigma_m ? 1 : 0;
    errors_.three_sigma += error_m <= 3 * told.position_sigma_m ? 1 : 0;
  }

  Errors conclude() {
    if (all_m_.empty()) return errors_;
    const auto n = static_cast<double>(all_m_.size());
    std::sort(all_m_.begin(), all_m_.end());
    errors_.rms_m = std::sqrt(square_m2_ / n);
    errors_.heading_rms_rad = std::sqrt(square_rad2_ / n);
    errors_.p95_m = all_m_[static_cast<std::size_t>(0.95 * (n - 1))];
    errors_.max_m = all_m_.back();
    for (double* share : {&errors_.sigma_m, &errors_.two_sigma, &errors_.three_sigma}) *share /= n;
    return errors_;
  }

 private:
  static constexpr double kTick_s = 0.005;
  static constexpr int kTicksEach = 10;
  Errors errors_;
  int ticks_ = 0;
  double way_m_ = 0;
  double square_m2_ = 0, square_rad2_ = 0;
  std::vector<double> all_m_;
};

struct Spread {
  double median = 0, least = 0, most = 0;
};

inline Spread spread_of(std::vector<double> values) {
  if (values.empty()) return {};
  std::sort(values.begin(), values.end());
  const std::size_t n = values.size();
  return {(values[(n - 1) / 2] + values[n / 2]) / 2, values.front(), values.back()};
}

/// Of all seeds of a drive.
struct Figures {
  std::vector<Errors> drover, usual;

  Spread of(const std::vector<Errors>& who, double Errors::*value) const {
    std::vector<double> values;
    for (const Errors& e : who) values.push_back(e.*value);
    return spread_of(values);
  }
  /// The estimate's over the peer's, seed by seed.
  Spread ratio(double Errors::*value) const {
    std::vector<double> values;
    for (std::size_t i = 0; i < drover.size(); ++i)
      values.push_back(drover[i].*value / usual[i].*value);
    return spread_of(values);
  }
};

}  // namespace drover::bench
