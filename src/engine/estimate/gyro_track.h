// What the gyro, the wheels and the receiver's heading said about the turn lately: the gyro's bias
// is learned from it, the wheels' gain, and which of them is wrong when they contradict each other.
#pragma once

#include <cstdint>

#include "drover/time.h"
#include "engine/base/kinematics.h"
#include "engine/config.h"
#include "engine/estimate/filter.h"
#include "engine/estimate/jump_watch.h"

namespace drover::engine::estimate {

/// Who is taken to be wrong about the turn.
enum class TurnTrouble : std::uint8_t {
  none,
  slip,       ///< the wheels: the gyro agrees with the receiver's heading
  gyro,       ///< the gyro: the wheels agree with the receiver's heading; it is not used
  undecided,  ///< nobody can tell: the heading grows uncertain by what lies between them
  pushed,     ///< the gyro turns while the wheels stand
};

struct GyroTrack {
  std::uint8_t source = 0;  ///< which sensor
  double rate_radps = 0;    ///< the latest about the vertical, as measured
  Time at = kNever;         ///< when it was measured; kNever: none that can be used
  double roll_rad = 0;
  double pitch_rad = 0;
  bool tilt_known = false;    ///< roll and pitch were measured once,
  double tilt_yaw_rad = 0;    ///< with this heading,
  double tilt_unseen_m = 0;   ///< so many metres of the rims ago,
  double tilt_unseen_s = 0;   ///< and so long, silence at rest not counted
  bool tilt_guessed = false;  ///< the sensor is silent since
  double left_mps2 = 0;       ///< of the base, without gravity
  bool rocks = false;

  // The slice of time that is being summed up.
  double slice_s = 0;
  double turned_rad = 0;  ///< by the gyro, as measured
  double rim_rad = 0;     ///< by the rims, gain not applied
  double way_m = 0;
  bool stood = true;

  // The last seconds, the older the less.
  double apart_rad = 0;  ///< turn by the gyro less turn by the wheels
  double white_rad2 = 0;
  double wheel_turn_rad = 0;
  double recent_way_m = 0;
  double recent_s = 0;

  // Against the receiver's headings, which vote when the other two contradict each other.
  double heading_rad = 0;        ///< the latest, as yaw
  Time heard = kNever;           ///< when
  double gyro_since_rad = 0;     ///< turn by the gyro since then
  double wheels_since_rad = 0;   ///< turn by the wheels since then
  double gyro_residual_rad = 0;  ///< turn by the receiver less turn by the gyro, lately
  double wheels_residual_rad = 0;

  TurnTrouble trouble = TurnTrouble::none;
  double apart_radps = 0;         ///< while there is trouble: how far they are apart
  Time contested_since = kNever;  ///< while undecided
  double contested_rad = 0;       ///< while undecided: how far apart the headings have become
  Time agrees_since = kNever;     ///< while the gyro is not believed
  double patience_s = 3;          ///< how long it must agree to be believed again
  double doubted_bias_radps = 0;
  JumpWatch rest;  ///< rates at rest that are not the bias
  double rest_radps = 0;
  double learned_s = 0;  ///< how long the bias was seen at rest

  bool fresh(Time now, Duration stale) const { return at != kNever && now - at <= stale; }
  bool believed() const { return trouble != TurnTrouble::gyro; }
};

/// What the prediction is to use of it at `now`.
GyroMotion motion_of(const GyroTrack& gyro, const Belief& belief, const BodyMotion& body, Time now,
                     const EstimateConfig& config);

/// Sums up `dt_s` of motion that ended at `now`, and judges each finished slice. Corrects the
/// belief.
void follow_turn(GyroTrack& gyro, Belief& belief, const BodyMotion& body, Time now, double dt_s,
                 const EstimateConfig& config, const TurnErrors& errors);

/// A heading of the receiver, whether the estimate believes it or not.
void hear_heading(GyroTrack& gyro, double yaw_rad, Time at);

}  // namespace drover::engine::estimate
