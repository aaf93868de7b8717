// What people and programs ask of the engine.
#pragma once

#include <cstdint>
#include <string_view>
#include <variant>

#include "drover/fixed_text.h"
#include "drover/fixed_vector.h"
#include "drover/measurement.h"
#include "drover/path.h"
#include "drover/time.h"
#include "drover/twist.h"

namespace drover {

/// Who asked, and under which number the answer is expected.
struct RequestId {
  enum class Source : std::uint8_t { mqtt, cli, internal, aimrt, ros2 } source = Source::internal;
  std::uint64_t number = 0;
};

/// As long as a broker may hold a command back without being called late; and some more.
inline constexpr Duration kBrokerLateUnnoticed = std::chrono::milliseconds(600);

/// Drive along `path` from where the robot is to point `target` (index from 0) and stop there.
/// The engine takes the path, and gives it back in a PathReleased event whatever becomes of the
/// task.
struct StartTask {
  const Path* path = nullptr;
  std::uint32_t target = 0;
  double speed_mps = 0;
  /// A stop that was asked for after it is obeyed already: refused.
  bool overtaken = false;
};
/// Always stops; success also when nothing runs.
struct CancelTask {};
/// A person's emergency stop: zero at once, latched until ResetStop.
struct EngageStop {};
/// Clears a latched software stop; refused while its cause persists. Never starts motion.
struct ResetStop {};
/// Asks for the present position as a new origin; answered by OriginProposed or a refusal.
struct ProposeOrigin {};
/// The origin is stored; take it. Also given at start-up.
struct SetOrigin {
  GeodeticPoint origin;
};

/// Which values of a JointCommand a joint outside the base follows; the others have to be 0.
enum class JointFollows : std::uint8_t {
  impedance,  ///< all five
  position,   ///< and a velocity with it; stiffness and damping are the configuration's
  velocity,
  effort,  ///< with damping
};

/// What one joint is to do. The wheels of the base follow a velocity; a joint outside of it what
/// its configuration says.
struct JointTarget {
  AxisId axis = 0;
  double velocity_radps = 0;
  double position_rad = 0;
  double effort_Nm = 0;
  double stiffness_Nmprad = 0;
  double damping_Nmsprad = 0;
};
/// One message of a stream of joint commands. Of the base: joints that it does not name come to
/// rest, unless it names none; a stream begins with all velocities 0, and ends when it is silent
/// for health.joint_command_timeout_s. Joints outside the base that it does not name are left as
/// they are.
struct JointTargets {
  FixedVector<JointTarget, kMaxAxes> joints;
};
/// A joint command that was not understood or not permitted, so that it is seen and counted.
struct JointTargetsRefused {
  Reason reason;
  /// Its sender may have been there before the gateway, or its way, was: he may not know that the
  /// robot was stopped.
  bool was_there = false;
};
/// Lets the drives go, so that a person can push the robot. Until ArmHold, also over restarts.
/// Refused while it moves, and on a slope, where it would roll, unless the person says so.
struct ReleaseHold {
  bool on_slope = false;
};
/// Takes the drives into closed loop and holds the robot where it is; ends a release.
struct ArmHold {};
/// A person has seen where the robot stands: from now on its receiver is believed, whatever wheels
/// and gyro made of the way there. Refused while it moves, and without an RTK fix.
struct AcceptPosition {};
/// What drives taught the robot of itself is no longer so: a wheel, an antenna was changed. Refused
/// while a task runs, it moves, or its place is not in order.
struct ForgetLearned {};
/// Drive straight ahead for a short way, so that a receiver with one antenna shows the heading.
struct FindHeading {};
/// What a key asks for is obeyed for so long, and moves nothing before it was held for so long.
inline constexpr Duration kKeyHeld = std::chrono::milliseconds(300);
/// None counts that may have been so long on its way to the program that reads it.
inline constexpr Duration kKeyLate = std::chrono::milliseconds(300);
/// After it was let go at most: then the ramp begins.
inline constexpr Duration kKeyRests = kKeyLate + kKeyHeld;
/// Drive so while a key is held down: one message of a row, obeyed for kKeyHeld from when the key
/// came (Command::received). Zero: the key is up.
struct DriveByHand {
  std::uint64_t hand = 0;  ///< whose key it is: one drives at a time
  Twist twist;
};

/// One message of a stream of twists (ROS 2's cmd_vel), which counts from when it came to this
/// computer (Command::received) and is obeyed for 0.3 s. A stream begins with zero twists.
struct FollowTwist {
  Twist twist;
  bool after_motion = false;  ///< one before it, which was not handed on, was no zero
};
/// One that was not understood or not permitted, so that it is seen and counted.
struct TwistRefused {
  Reason reason;
  bool ends = false;  ///< nor is any other followed now: two programs write
};

struct Command {
  RequestId id;
  Time received = kNever;
  std::variant<std::monostate, StartTask, CancelTask, EngageStop, ResetStop, ProposeOrigin,
               SetOrigin, JointTargets, JointTargetsRefused, FindHeading, ReleaseHold, ArmHold,
               AcceptPosition, ForgetLearned, DriveByHand, FollowTwist, TwistRefused>
      body;
};

}  // namespace drover
