// Which drives of the base are armed, held, let go or left as they are: decided here, and nowhere
// else. Joints outside it are armed by their group, by rules of their own (group/joint_servo.h).
#pragma once

#include <array>
#include <span>

#include "drover/command.h"
#include "drover/driver.h"
#include "drover/remembered.h"
#include "drover/snapshot.h"
#include "engine/base/kinematics.h"
#include "engine/event_queue.h"
#include "engine/health/health.h"
#include "engine/own/take_back.h"

namespace drover::engine {

struct ArmingInput {
  Time now = kNever;
  Duration dt{};
  const HealthReport& health;
  std::span<const AxisSnapshot> axes;
  bool driven = false;    ///< an owner moves the robot, or brings it to rest
  bool run_away = false;  ///< a wheel does not obey its drive: that drive is not armed again
  bool power_cut = false;
  bool guard_has_bus = false;
  bool joints = false;  ///< that owner commands single joints, also such as are not the base's
};

/// Nobody else commands a drive armed, held or idle: the table is in README.md. Drives that were
/// armed by a person and lose their closed loop (a restart of the gateway, a dip of their supply)
/// are armed again at once, at the speed that they have, and ramped down to rest.
/// It tries to hold again for 10 s from when they last held, or were first heard after a restart.
/// After an e-stop, a release, a power cut or a boot nothing is armed until a person does: he
/// starts what moves the robot, or arms it where it stands.
class Arming final {
 public:
  explicit Arming(const EngineConfig& config);

  /// Before the first cycle: what the program before this one left.
  void recall(const Remembered& remembered);
  /// `hindrance`: why nothing of the kind can be done now; empty: it can.
  void release(const RequestId& id, const ReleaseHold& release, const Reason& hindrance,
               double tilt_deg, Time now, EventQueue& events);
  void arm(const RequestId& id, const Reason& hindrance, Time now, EventQueue& events);

  void step(const ArmingInput& input, EventQueue& events);

  /// What this axis is to do now; where it runs, how fast is its owner's.
  const AxisCommand& command(AxisId axis) const { return commands_[axis]; }
  /// An owner has the drives.
  bool driven() const { return has_owner_; }
  /// Why nobody may drive now; empty: they may.
  Reason hindrance() const;
  HoldState state() const { return state_; }
  bool released() const { return released_; }
  /// What was held before a restart waits until an e-stop's line has told of itself: until then the
  /// drives' power stays as it was found.
  bool waits_for_lines() const { return lines_awaited_ && !lines_known_; }
  /// The drives hold, or are to hold again: for the memory that outlives the program.
  bool armed() const { return armed_; }

 private:
  bool estop(const ArmingInput& input);
  void forfeit() { armed_ = asked_ = recalled_ = false; }
  void keep_time(const ArmingInput& input, EventQueue& events);
  void take_back(const ArmingInput& input, bool wanted);
  AxisCommand decide(const ArmingInput& input, AxisId id) const;

  EngineConfig config_;
  JointSet driven_;
  TakeBack take_back_;
  std::array<AxisCommand, kMaxAxes> commands_{};
  bool has_owner_ = false;
  bool armed_ = false;     ///< by a person, and nothing since ended it
  bool asked_ = false;     ///< by a person with ArmHold, and they do not run yet
  bool recalled_ = false;  ///< from before a restart; not all drives were heard since
  bool released_ = false;
  bool gave_up_ = false;
  bool heard_ = false;          ///< all drives of the base are, now
  bool failed_ = false;         ///< one of them has, and is not taken back as it is
  bool lines_awaited_ = false;  ///< it held before a restart
  bool lines_known_ = false;
  Time begun_ = kNever;
  Time last_held_ = kNever;
  Time wanted_ = kNever;  ///< since when drives are to be taken back
  HoldState state_ = HoldState::idle;
};

}  // namespace drover::engine
