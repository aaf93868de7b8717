// Whether the base comes to rest when it is told to, and stays there. What does not stop loses its
// power; what is pushed or carried is told.
#pragma once

#include "engine/config.h"
#include "engine/health/creep_watch.h"
#include "engine/health/motion_witness.h"
#include "engine/health/rest_input.h"
#include "engine/health/rim_history.h"
#include "engine/health/rim_motion.h"
#include "engine/health/silent_base.h"
#include "engine/health/slope_pardon.h"

namespace drover::engine {

enum class RestState : std::uint8_t {
  driving,      ///< something is commanded, or the ramp to zero needs its time
  settling,     ///< rest is due and not yet confirmed for a second
  resting,      ///< confirmed
  carried,      ///< was resting, and moves though the wheels do not show it
  rolling,      ///< was resting, and the wheels turn without a command
  not_stopping  ///< did not come to rest: its power has to be cut. Until reset()
};

/// What is faster than it was ever allowed to be, and its wheels do not show it, is cut at once:
/// drives with frozen encoders push with all that they have. Else rest is due when the speed that
/// was commanded has been taken back at the configured deceleration; what moves before anything was
/// commanded is told, but for drives that run on by what the program before this one said. What
/// still moves 0.3 s later is cut: wheels that turn, or two witnesses besides wheels that say
/// nothing of it (their encoders may be frozen). After a second of confirmed rest, or when a person
/// released the drives, no motion is ours any more: nothing is cut then, since who pushes the robot
/// or carries it away must not find it latched, unless a person asks for a stop while it moves.
///
/// Where it would only roll without power, or rolls and is being caught, a cut is the lesser evil
/// only for what a drive in closed loop moves the way that it was driven, or up, or turns on the
/// spot so. Not for what rolls back, where no drive runs, for what creeps down, nor for what one
/// device says alone that contradicts itself. README.md has the rules in tables.
class RestWatch final {
 public:
  explicit RestWatch(const EngineConfig& config);

  MotionWitness& witness() { return witness_; }
  const MotionWitness& witness() const { return witness_; }

  RestState update(const RestInput& input);
  RestState state() const { return state_; }
  /// Confirmed, and not of what may only be held up; or it was, and who moves it since is a person.
  bool knows_rest() const {
    const bool pushed = has_rested() && !ours_ && !silence_.unheard();
    return (state_ == RestState::resting || pushed) && !silence_.suspect();
  }
  /// Sign in which it was driven last; 0 before.
  double direction() const { return last_.direction; }
  /// What is silent may go on by a command that it has: nothing but its power stops it.
  bool may_drive_on() const { return silence_.unheard() && (ours_ || silence_.has_a_command()); }
  /// And it was not at rest when it fell silent, or nobody knows.
  bool drives_on() const { return may_drive_on() && silence_.keeps_on() && !spared_; }
  /// Anything says that the base moves now.
  bool moves(Time now) const { return history_.turns() || witness_.hear(now).moving > 0; }
  /// Its wheels say that they do.
  bool turns() const { return history_.turns(); }
  bool hears_wheels() const { return hears_wheels_; }
  bool misses_wheels() const { return misses_wheels_; }
  /// What is wrong, in words; empty when nothing is.
  const Reason& reason() const { return reason_; }
  /// A wheel turns now and nobody drove it, be it only an arming drive's swing: no moment to start.
  Reason turns_by_itself() const;
  /// The program before this one knew the base at rest.
  void recall_at_rest() { silence_.recall_at_rest(); }
  /// A person asked for a stop: what still drives then is ours, whoever commanded it.
  void on_stop_asked() { stop_asked_ = true; }
  /// A wheel ran away and everything was stopped: rest is due at once, whoever moved it.
  void expect_stop(Time now);
  /// A person reset the cut.
  void reset();

 private:
  bool due(const RestInput& input);
  bool bolts(const RestInput& input, const RimMotion& rims) const;
  bool creeps_on(const RestInput& input, const RimMotion& rims);
  bool cannot_be_stopped(const RestInput& input);
  bool has_rested() const;
  SlopePardon pardon(const RestInput& input) const { return {input, witness_, last_}; }
  void watch_silence(const RestInput& input, const RimMotion& rims);
  bool is_driven_by_us(const RestInput& input) const;
  bool may_be_cut(const RestInput& input, const RimMotion& rims) const;
  void settle(const RestInput& input, const RimMotion& rims, const Testimony& said);
  void stay(const RestInput& input, const RimMotion& rims, const Testimony& said);
  bool others_say_so(const RestInput& input, const RimMotion& rims, const Testimony& said);
  void tell(const char* what, const RimMotion& rims, const Testimony& said);

  EngineConfig config_;
  RimReader rims_;
  RimHistory history_;
  MotionWitness witness_;
  SilentBase silence_;
  CreepWatch creep_;
  RestState state_ = RestState::settling;
  Reason reason_;
  bool stop_asked_ = false;  ///< since the last cycle
  bool ours_ = false;        ///< we moved it since it rested last
  bool began_ = false;
  LastDrive last_;
  bool on_slope_ = false;  ///< it could roll without power, since rest is due
  bool may_roll_ = false;  ///< it could without power, or was caught, since rest is due
  bool coasts_ = false;    ///< the e-stop took its power while it moved: friction alone stops it
  bool hears_wheels_ = false;  ///< at least one, in the last cycle
  bool misses_wheels_ = false;
  Time crept_at_ = kNever;   ///< silent, when the receiver last saw it go down slowly
  bool spared_ = false;      ///< silent on a slope: it stands, creeps, or may be caught yet
  double expected_mps_ = 0;  ///< how fast it may still be
  Time due_ = kNever;        ///< since when it should rest
  Time moves_since_ = kNever;
  Time alone_since_ = kNever;
  Time quiet_since_ = kNever;
};

}  // namespace drover::engine
