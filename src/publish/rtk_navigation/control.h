// The messages of `mqtt_control`: strict text in, typed commands or a refusal out.
//
// RTK navigation protocol, "控制命令表" and the sections after it.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>

#include "drover/result.h"
#include "drover/time.h"
#include "publish/arrival.h"
#include "store/track.h"

namespace drover::publish {

struct GetAllTrajectory {};
/// `track.origin` is left for the receiver to fill in.
struct SaveTrajectory {
  store::Track track;
};
struct DeleteTrajectory {
  std::string name;
};
struct DeleteAllTrajectory {};
struct StartTaskRequest {
  std::string name;
  std::int64_t id = 0;   ///< as the operator counts; any integer
  double speed_mps = 0;  ///< finite; range is the engine's
  /// UTC at which the operator pressed, since 1970; nothing when the message does not tell.
  std::optional<Duration> time{};
};
struct CancelTaskRequest {
  std::string note{};  ///< what is wrong with the message, though it is obeyed
};
struct InitRtkData {};
/// A later edition's emergency stop (`manual_control`, `terminate`).
struct TerminateRequest {
  std::string note{};  ///< as above
};
/// A short straight way that shows the heading. The command line's.
struct FindHeadingRequest {};
/// Clears a latched software stop. The command line's; no message of the protocol gives it.
struct ResetStopRequest {};
/// Lets the drives go, so that a person can push the robot. The command line's.
struct ReleaseRequest {
  bool on_slope = false;
};
/// Takes the drives into closed loop at rest. The command line's.
struct HoldRequest {};
/// A person's word that the receiver is right. The command line's.
struct AcceptPositionRequest {};

/// What was learned of the robot is no longer so. The command line's.
struct ForgetLearnedRequest {};

using ControlCommand =
    std::variant<GetAllTrajectory, SaveTrajectory, DeleteTrajectory, DeleteAllTrajectory,
                 StartTaskRequest, CancelTaskRequest, InitRtkData, TerminateRequest,
                 ResetStopRequest, FindHeadingRequest, ReleaseRequest, HoldRequest,
                 AcceptPositionRequest, ForgetLearnedRequest>;

struct ControlRefusal {
  std::string feedback_cmd;  ///< always one that can be published, "unknown_failse" at worst
  std::string reason;        ///< for the operator
};

struct ControlLimits {
  std::size_t max_bytes = std::size_t{2} << 20;
  std::size_t max_depth = 16;
  std::size_t max_values = 300'000;   ///< what so many bytes can hold of points
  std::size_t max_name_bytes = 1200;  ///< 300 characters of the longest kind
};

/// Accepts exactly the document's messages, comments included; unknown members are ignored. Nothing
/// is coerced: 1.9 and true are no point id (2.0 is 2). A text that is no JSON is refused in the
/// name of the command that it tells, where it tells one. But what tells a stop stops, whatever is
/// wrong with it otherwise: the request's note says what. A message that the broker had stored is
/// refused whatever it says: nobody sends it now. Of those that are to be retained, only what stops
/// is taken: who presses stop may have forgotten the flag, and a start would come again some day.
Result<ControlCommand, ControlRefusal> parse_control(std::string_view payload, Retain retain,
                                                     const ControlLimits& limits = {});

/// Whether it is one that stops: never limited, never behind others.
bool is_stop(const ControlCommand& command);
bool is_stop(const Result<ControlCommand, ControlRefusal>& request);

/// Whether a message may be one that stops, without parsing it: false is certain. For the middle of
/// a flood.
bool may_stop(std::string_view payload);

/// The `cmd` that tells a failure of `cmd`: `<cmd>_failse` when it is a plain short word without
/// "success" in it, otherwise "unknown_failse".
std::string failure_cmd(std::string_view cmd);

}  // namespace drover::publish
