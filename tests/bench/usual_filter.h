// The peer of the estimate: an extended Kalman filter of the usual shape of robot localisation, 15
// states and a model of constant acceleration. It knows no biases, no correlated errors, and takes
// each sensor for what it says.
#pragma once

#include <array>
#include <cstddef>
#include <deque>

#include "bench/small_matrix.h"
#include "drover/time.h"

namespace drover::bench {

/// Its states: place in the map, attitude, velocity and rates in the base, acceleration.
enum UsualState : std::size_t {
  kPlaceX,
  kPlaceY,
  kPlaceZ,
  kRoll,
  kPitch,
  kHeading,
  kSpeedX,
  kSpeedY,
  kSpeedZ,
  kRollRate,
  kPitchRate,
  kYawRate,
  kAccelerationX,
  kAccelerationY,
  kAccelerationZ,
  kUsualStates
};

/// What a user sets to his robot. These are what `bench_estimators --tune` finds.
struct UsualTuning {
  // Process noise, a second.
  double place_m2 = 1e-3;
  double heading_rad2 = 1e-4;
  double speed_m2ps2 = 1;
  double rate_rad2ps2 = 0.1;
  double acceleration_m2ps4 = 1;
  double gnss_scale = 1;         ///< times what is told of a position
  double wheel_yaw_radps = 0.1;  ///< one sigma of the wheels' turn
  /// Beyond that distance (Mahalanobis) nothing is taken. Any gate that was tried makes it worse:
  /// it believes itself more than it may, and keeps off what would put it right after a slip.
  double gate_sigma = 1e6;
};

using UsualMatrix = SquareMatrix<kUsualStates>;
using UsualVector = std::array<double, kUsualStates>;

struct UsualBelief {
  Time time = kNever;
  UsualVector mean{};
  UsualMatrix covariance;
};

/// Some states at once, measured directly and independently.
struct UsualSeen {
  static constexpr std::size_t kMost = 6;
  Time time = kNever;
  std::size_t count = 0;
  std::array<std::size_t, kMost> what{};
  std::array<double, kMost> value{};
  std::array<double, kMost> sigma{};
  /// A place is so far from the base, in the base: brought there by the attitude of the moment.
  std::array<double, 3> lever_m{};

  void add(std::size_t state, double measured, double one_sigma) {
    what[count] = state;
    value[count] = measured;
    sigma[count++] = one_sigma;
  }
};

/// Where `mean` leads within dt_s, and by what each state leads there (of `jacobian`, if any).
UsualVector predicted(const UsualVector& mean, double dt_s, UsualMatrix* jacobian);

class UsualFilter final {
 public:
  /// `replays`: what comes late goes where it belongs, and what came after is taken again; else it
  /// is taken when it comes.
  UsualFilter(const UsualTuning& tuning, bool replays) : tuning_(tuning), replays_(replays) {}

  void begin(const UsualBelief& belief);
  bool begun() const { return now_.time != kNever; }
  void see(const UsualSeen& seen);
  const UsualBelief& belief() const { return now_; }

 private:
  struct Past {
    UsualSeen seen;
    UsualBelief after;
  };

  void take(const UsualSeen& seen);
  void advance(Time to);
  void correct(const UsualSeen& seen);

  UsualTuning tuning_;
  bool replays_;
  UsualBelief now_;
  std::deque<Past> past_;
};

}  // namespace drover::bench
