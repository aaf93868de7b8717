// Who moves the base, decided in one place: e-stop, manual, task, cmd_vel, joint commands, in that
// order.
#pragma once

#include "engine/gate/joint_gate.h"
#include "engine/gate/target_gate.h"
#include "engine/health/arm_wait.h"
#include "engine/health/latch.h"
#include "engine/health/wheels.h"
#include "engine/navigate/navigator.h"
#include "engine/own/hand_drive.h"
#include "engine/own/heading_creep.h"
#include "engine/own/joint_stream.h"
#include "engine/own/twist_stream.h"

namespace drover::engine {

struct OwnInput {
  Time now = kNever;
  Duration dt{};
  const Estimate& estimate;
  const HealthReport& health;
  WheelFault wheels = WheelFault::none;
  const Reason& wheel_reason;
  const NavOutput& task;
  double speed_cap_mps = 1e9;        ///< of the first way after the start, for a search
  double joints_cap_mps = 1e9;       ///< likewise, for joint commands and cmd_vel
  double hand_cap_mps = 1e9;         ///< likewise, for a person with a key
  Reason not_held = {};              ///< why the drives cannot be had now; empty: they can
  Twist stream = {};                 ///< what `stream_radps` make of the base
  double ahead_cap_mps = 1e9;        ///< of what is free straight ahead
  double rim_cap_mps = 1e9;          ///< of what is free where the stream goes
  bool too_near = false;             ///< something came into the way where no ramp ends before it
  Twist twist = {};                  ///< what `by_twist` is let do, but for the limits of speed
  double curvature_radpm = kAbsent;  ///< that the wheels of a base that steers make now
};

/// What the gates let through this cycle.
struct Motion {
  Owner owner = Owner::nobody;
  bool at_once = false;  ///< it was stopped, without a ramp
  bool joints = false;   ///< single joints are commanded, otherwise `twist`
  Twist twist;
  Twist asked;  ///< by its owner, before anything bounded it
  /// The drives are to run for him, also while they ramp down.
  bool drives() const { return !at_once && owner != Owner::nobody && owner != Owner::estop; }
};

/// The owners below the task, both gates, and the rank among all. A lower owner is refused while a
/// higher one is active, and takes nothing over: it has to begin anew.
class Owners final {
 public:
  /// A stop of joint commands is latched there, and what is latched there hinders them.
  Owners(const EngineConfig& config, Latch& latch);

  void take(const JointTargets& targets, Time now);
  void refuse(const JointTargetsRefused& refused) { stream_.refuse_quietly(refused.reason); }
  /// `no_sideways`: why nothing goes aside now; empty: it does.
  void take(const FollowTwist& follow, Time received, std::string_view no_sideways, Time now);
  void refuse(const TwistRefused& refused, Time now);
  void find_heading(const RequestId& id, const Estimate& estimate, const HealthReport& health,
                    Time now, EventQueue& events);
  /// `proved`: wheels, gyro and receiver agree with each other.
  void drive_by_hand(const Command& command, const DriveByHand& wanted, const HealthReport& health,
                     bool proved, Time now, EventQueue& events);
  bool hand_drives() const { return hand_.active(); }
  /// What a person asks for with his key now, or the program that sends cmd_vel.
  Twist by_twist() const { return hand_.active() ? hand_.wanted() : cmd_vel_.wanted(); }
  /// A person's cancel stops every owner.
  void cancel(Time now, EventQueue& events);
  /// Why a task cannot take the base over now; empty: it can. An idle stream makes way.
  Reason hinders_task() const;
  /// A task begins: forget old motion.
  void on_task_started();

  /// Nobody steered for a while: what came to rest by itself meanwhile is not moved by a ramp.
  void slow_to(const BodyMotion& measured) {
    if (measured.known) twist_gate_.slow_to(measured.twist);
  }
  const Motion& step(const OwnInput& input, EventQueue& events);

  bool at_rest() const { return twist_gate_.at_rest() && joint_gate_.at_rest(); }
  TargetRefusal refusal() const { return twist_gate_.refusal(); }
  const JointVelocities& joint_velocities_radps() const { return joint_gate_.velocities_radps(); }
  /// What the stream of joint commands asks for now, rad/s by AxisId.
  const JointVelocities& stream_radps() const { return stream_.velocities_radps(); }
  const JointStream& stream() const { return stream_; }
  const TwistStream& cmd_vel() const { return cmd_vel_; }
  /// Why the last search for a heading ended without one.
  const Reason& no_heading() const { return creep_.failed(); }
  /// Silence after which that owner's motion ends, s; absent when there is no such time.
  double timeout_s(Owner owner) const;

 private:
  Owner rank(const OwnInput& input) const;
  Reason hindrance(const OwnInput& input) const;
  Reason hinders_joints(const OwnInput& input) const;
  Reason hinders_twists(const OwnInput& input) const;
  Stop watch_stream(const OwnInput& input, bool at_once);
  struct ByTwist {
    Twist twist;
    bool lost = false;  ///< a drive that ran does no more: the others may not go on
  };
  ByTwist watch_hand(const OwnInput& input, bool at_once, double cap_mps, EventQueue& events);
  ByTwist watch_cmd_vel(const OwnInput& input, bool at_once, double cap_mps);
  Twist asked(const OwnInput& input, const Twist& creep) const;
  Reason why_at_once(const OwnInput& input) const;
  void latch(const Reason& why, bool anyone);

  EngineConfig config_;
  Latch& latch_;
  Kinematics base_;
  BodyLimits body_;
  TargetGate twist_gate_;
  JointGate joint_gate_;
  JointStream stream_;
  TwistStream cmd_vel_;
  HeadingCreep creep_;
  HandDrive hand_;
  ArmWait stream_drives_;
  ArmWait hand_drives_;
  ArmWait cmd_vel_drives_;
  Time hand_since_ = kNever;   ///< it waits for the drives, or has them
  bool hand_moved_ = false;    ///< since it began
  Reason hand_busy_;           ///< why nobody may drive by hand; empty: he may
  Reason busy_;                ///< why joint commands cannot be followed; empty: they can
  Reason twists_busy_;         ///< likewise cmd_vel
  Reason no_start_;            ///< why nothing new may begin; empty: it may
  Owner drove_ = Owner::task;  ///< who asked for a twist last
  Motion motion_;
};

}  // namespace drover::engine
