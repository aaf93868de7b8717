// The closed part of the estimate: nine correlated numbers, predicted by wheels and a gyro,
// corrected by scalar measurements. It knows no sensor; the models do.
#pragma once

#include <array>
#include <cstddef>

#include "drover/twist.h"
#include "engine/config.h"

namespace drover::engine::estimate {

constexpr double square(double v) {
  return v * v;
}

/// Indices of the state.
enum : std::size_t {
  kX,          ///< base_link in `map`, m
  kY,          ///< m
  kYaw,        ///< rad
  kGain,       ///< true yaw rate over the one that the base tells: 1 / yaw_slip_factor
  kScale,      ///< true speed over the one that the base tells
  kBiasX,      ///< slowly changing error of the GNSS position, m
  kBiasY,      ///< m
  kGyroBias,   ///< what the gyro says of a base that does not turn, rad/s
  kGyroScale,  ///< true turn over the one that the gyro gives, bias removed
  kStates
};

using Vector = std::array<double, kStates>;
using Matrix = std::array<Vector, kStates>;

/// What the gyro says about an interval. Without it the wheels tell the turn.
struct GyroMotion {
  double rate_radps = 0;  ///< about the vertical, as measured
  bool known = false;     ///< fresh and believed
  /// The base turns while its wheels stand: somebody pushes or lifts it, and it may move, too.
  bool pushed = false;
};

struct Belief {
  Vector mean{};
  Matrix covariance{};

  /// Sets one entry as known to `sigma`, independent of the others.
  void reset(std::size_t i, double value, double sigma);
  /// Corrects by one scalar: `innovation` = measured - predicted, `row` = its derivative,
  /// `variance` of the measurement's own noise.
  void correct(const Vector& row, double innovation, double variance);
  /// row * covariance * other^T
  double project(const Vector& row, const Vector& other) const;
  /// Lifts the variance of an entry to at least `variance`.
  void floor_variance(std::size_t i, double variance);
  /// Lowers it to at most that, and what depends on it likewise.
  void limit_variance(std::size_t i, double variance);
  bool finite() const;
};

/// Two sigma of the larger horizontal axis, m.
double two_sigma_position_m(const Belief& belief);

/// Moves the belief over `dt_s` (short: some 20 ms) by the motion that the base tells.
/// `heading_known` false: the position stays and its uncertainty grows by the distance.
/// `bias_sigma` is the stationary sigma of the GNSS error, m. With a gyro the turn is the gyro's,
/// and the wheels' gain has no part in it.
void predict(Belief& belief, const BodyMotion& body, double dt_s, bool heading_known,
             double bias_sigma_x_m, double bias_sigma_y_m, const EstimateConfig& config,
             const GyroMotion& gyro = {});

}  // namespace drover::engine::estimate
