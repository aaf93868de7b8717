// Keeps the robot where it is: what the drives were holding is held again when they let go.
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

namespace drover::engine {

struct HoldInput {
  Time now = kNever;
  Duration dt{};
  const HealthReport& health;
  std::span<const AxisSnapshot> axes;
  bool driven = false;    ///< an owner has the drives: what they do is its own
  bool run_away = false;  ///< a wheel does not obey its drive: that drive is not armed again
  bool power_cut = false;
  bool guard_has_bus = false;
};

/// Drives that were armed by a person and lose their closed loop (a restart of the gateway, a dip
/// of their supply) are armed again at once, at the speed that they have, and ramped down to rest.
/// It tries for 10 s from when they last held, or were first heard after a restart. After an
/// e-stop, a release, a power cut or a boot nothing is armed until a person does.
class Hold final {
 public:
  explicit Hold(const EngineConfig& config);

  /// Before the first cycle: what the program before this one left.
  void recall(const Remembered& remembered);
  /// `hindrance`: why nothing of the kind can be done now; empty: it can.
  void release(const RequestId& id, const ReleaseHold& release, const Reason& hindrance,
               double tilt_deg, Time now, EventQueue& events);
  void arm(const RequestId& id, const Reason& hindrance, Time now, EventQueue& events);

  void step(const HoldInput& input, EventQueue& events);

  /// What this axis is to do now; `rest` where there is nothing to be done.
  const AxisCommand& command(AxisId axis) const { return commands_[axis]; }
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
  /// One attempt to take an axis back.
  struct Catch {
    bool active = false;
    Time since = kNever;
    Time next = kNever;  ///< not before
    double velocity_radps = 0;
  };
  bool estop(const HoldInput& input);
  void forfeit() { armed_ = asked_ = recalled_ = false; }
  void keep_time(const HoldInput& input, EventQueue& events);
  void take_back(const HoldInput& input, AxisId id);
  void begin(const HoldInput& input, const AxisSnapshot& axis, Catch& it) const;
  void follow(const HoldInput& input, const AxisSnapshot& axis, Catch& it) const;
  bool others_hold(const HoldInput& input) const;
  bool heard(const HoldInput& input, const AxisSnapshot& axis) const;

  EngineConfig config_;
  Kinematics base_;
  JointSet driven_;
  double falls_radps2_;
  std::array<Catch, kMaxAxes> catches_{};
  std::array<AxisCommand, kMaxAxes> commands_{};
  bool armed_ = false;     ///< by a person, and nothing since ended it
  bool asked_ = false;     ///< by a person with ArmHold, and they do not run yet
  bool recalled_ = false;  ///< from before a restart; not all drives were heard since
  bool released_ = false;
  bool gave_up_ = false;
  bool heard_ = false;          ///< all drives of the base are, now
  bool lines_awaited_ = false;  ///< it held before a restart
  bool lines_known_ = false;
  Time begun_ = kNever;
  Time last_held_ = kNever;
  Time wanted_ = kNever;  ///< since when drives are to be taken back
  HoldState state_ = HoldState::idle;
};

}  // namespace drover::engine
