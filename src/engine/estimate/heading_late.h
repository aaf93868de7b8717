// How much later a receiver's headings are than their stamps say, as the gyro tells it in turns.
#pragma once

#include <array>

#include "engine/config.h"

namespace drover::engine::estimate {

/// Told headings less the gyro's are the same all the time, but for the gyro's slow error; where it
/// turns, a late one lags behind by the rate. Two numbers by recursive least squares.
class HeadingLate final {
 public:
  HeadingLate() = default;
  explicit HeadingLate(const EstimateConfig& config);

  /// What an earlier program had found.
  void recall(double late_s, double sigma_s) {
    late_s_ = late_s;
    covariance_[1][1] = sigma_s * sigma_s;
  }
  /// The first heading, or one after a pause.
  void begin(double told_rad);
  bool begun() const { return begun_; }
  void pause() { begun_ = false; }
  /// The next one, as it was told, `dt_s` (above zero) and a turn by the gyro after the last one.
  void hear(double told_rad, double gyro_turn_rad, double dt_s, const EstimateConfig& config);
  /// How far it lags behind.
  double lag_rad() const { return radps_ * late_s_; }

  double late_s() const { return late_s_; }
  double sigma_s() const;
  /// They are late, by more than can be chance.
  bool known() const;

 private:
  bool begun_ = false;
  double told_rad_ = 0;
  double beside_rad_ = 0;  ///< told less gyro since it began
  double offset_rad_ = 0;  ///< its constant part
  double late_s_ = 0;
  double radps_ = 0;  ///< of the turn, smoothed
  std::array<std::array<double, 2>, 2> covariance_{};
};

}  // namespace drover::engine::estimate
