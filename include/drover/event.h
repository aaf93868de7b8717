// What the engine tells the publishers, once each and in order.
#pragma once

#include <variant>

#include "drover/command.h"
#include "drover/fixed_text.h"

namespace drover {

struct CommandAccepted {
  RequestId id;
  Reason note;  ///< for example that the speed was clamped; empty otherwise
};
struct CommandRefused {
  RequestId id;
  Reason reason;
};
/// The robot begins to move for the task (start_nav_success).
struct NavigationStarted {
  RequestId id;
};
/// The task was accepted but could not begin to move (start_nav_failse).
struct NavigationNotStarted {
  RequestId id;
  Reason reason;
};
struct TaskEnded {
  RequestId id;
  enum class How : std::uint8_t { success, cancelled, failed } how = How::failed;
  Reason reason;
};
struct OriginProposed {
  RequestId id;
  GeodeticPoint origin;
};
/// The engine does not use this path any more; the receiver deletes it.
struct PathReleased {
  const Path* path = nullptr;
};
/// Something an operator or the journal should know: a source lost, a pause, a stop, a resume.
struct Notice {
  enum class Level : std::uint8_t { info, warning, error } level = Level::info;
  Reason text;
};

struct Event {
  Time time = kNever;
  std::variant<std::monostate, CommandAccepted, CommandRefused, NavigationStarted,
               NavigationNotStarted, TaskEnded, OriginProposed, PathReleased, Notice>
      body;
};

}  // namespace drover
