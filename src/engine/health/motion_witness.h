// What else than the wheels says that the base moves: the receiver's speed, the gyro, and the way
// between the receiver's positions.
#pragma once

#include <array>

#include "drover/measurement.h"
#include "drover/path.h"
#include "drover/time.h"
#include "engine/config.h"

namespace drover::engine {

/// What the witnesses say together.
struct Testimony {
  int heard = 0;    ///< witnesses that said something lately
  int moving = 0;   ///< of these: that the base moves
  Reason in_words;  ///< of those who say that it moves; empty when nobody does
};

/// Each witness has noise of its own, so one alone proves little. A receiver's speed without an RTK
/// fix is mostly noise: how much is learned while the base rests.
class MotionWitness final {
 public:
  explicit MotionWitness(const EngineConfig& config) : config_(config) {}

  void on_speed(const GnssVelocity& velocity, Time at);
  void on_position(const GnssPosition& position, Time at);
  /// `turn_radps` about the vertical, without the bias.
  void on_turn(double turn_radps, Time at);

  /// From `at` on the base should rest: the way counts from the next position.
  void expect_rest(Time at);
  /// While the base rests, what the receiver's speed says is noise.
  void set_at_rest(bool rests) { rests_ = rests; }

  Testimony hear(Time now) const;
  /// The receiver's speed when it is fresh and no noise, else 0, m/s.
  double speed_mps(Time now) const;
  /// From where rest was expected, m; x east, y north. Zero without a position.
  PathPoint way(Time now) const;

 private:
  double speed_noise_mps() const;
  bool fresh(Time at, Time now) const;

  EngineConfig config_;
  double speed_mps_ = kAbsent;
  Time speed_at_ = kNever;
  bool rests_ = false;
  double learned_noise_mps2_ = 0;  ///< squared, of this kind of fix
  GnssPosition from_;              ///< where rest began
  Time from_at_ = kNever;
  Time wanted_from_ = kNever;
  GnssPosition position_;
  Time position_at_ = kNever;
  double turn_radps_ = 0;  ///< smoothed
  Time turn_at_ = kNever;
};

}  // namespace drover::engine
