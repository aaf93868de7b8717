// What is taken from the samples of an inertial sensor: the turn about the vertical in slots of
// time, roll and pitch, and the bias at rest. Refuses what no sensor can mean.
#pragma once

#include <cstdint>
#include <optional>

#include "drover/measurement.h"
#include "engine/estimate/rest_bias.h"
#include "engine/estimate/tilt.h"

namespace drover::engine::estimate {

/// How the base turns from one slot of time until the next such entry.
struct TurnRate {
  double radps = 0;                  ///< about the vertical, bias not removed
  std::uint8_t source = 0;           ///< which sensor
  double rest_bias_radps = 0;        ///< of the z axis, as learned at rest
  double rest_bias_sigma = kAbsent;  ///< rad/s; absent: none learned yet
  double roll_rad = 0;
  double pitch_rad = 0;
  double left_mps2 = 0;    ///< felt to the left, without gravity
  bool rocks = false;      ///< rolls or pitches fast, so that a sensor high up is swung about
  bool saturated = false;  ///< the truth is larger
};

struct TurnSlot {
  Time slot = kNever;
  TurnRate rate;
};

class ImuIntake final {
 public:
  explicit ImuIntake(Duration slot) : slot_(slot) {}

  enum class Verdict : std::uint8_t { taken, absurd, repeated };
  /// A sample is the mean rate since the one before it. `absurd` when no sensor can mean it,
  /// `repeated` when it is not newer than the last. `standing` and `speed_mps` by the wheels.
  Verdict take(const ImuSample& sample, Time at, bool standing, double speed_mps);
  /// What the last sample completed: samples that come closer than the slots are summed up, and the
  /// turn stays the same however the slots cut it.
  const std::optional<TurnSlot>& finished() const { return finished_; }
  const RestBias& bias() const { return bias_; }
  const Tilt& tilt() const { return tilt_; }
  /// The last rate about the base's z axis, without the bias that was learned at rest, rad/s.
  double turn_radps() const { return turn_radps_; }

 private:
  TurnRate turn(double radps) const;

  Duration slot_;
  Tilt tilt_;
  RestBias bias_;
  Time last_ = kNever;
  Time from_ = kNever;     ///< slot in which the present sum began
  double turned_rad_ = 0;  ///< since then
  double turn_radps_ = 0;
  double left_mps2_ = 0;
  bool rocks_ = false;
  bool saturated_ = false;
  std::optional<TurnSlot> finished_;
};

}  // namespace drover::engine::estimate
