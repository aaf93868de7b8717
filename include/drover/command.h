// What people and programs ask of the engine.
#pragma once

#include <cstdint>
#include <variant>

#include "drover/path.h"
#include "drover/time.h"

namespace drover {

/// Who asked, and under which number the answer is expected.
struct RequestId {
  enum class Source : std::uint8_t { mqtt, cli, internal } source = Source::internal;
  std::uint64_t number = 0;
};

/// Drive along `path` from where the robot is to point `target` (index from 0) and stop there.
/// The engine takes the path, and gives it back in a PathReleased event whatever becomes of the
/// task.
struct StartTask {
  const Path* path = nullptr;
  std::uint32_t target = 0;
  double speed_mps = 0;
};
/// Always stops; success also when nothing runs.
struct CancelTask {};
/// Clears a latched software stop; refused while its cause persists. Never starts motion.
struct ResetStop {};
/// Asks for the present position as a new origin; answered by OriginProposed or a refusal.
struct ProposeOrigin {};
/// The origin is stored; take it. Also given at start-up.
struct SetOrigin {
  GeodeticPoint origin;
};

struct Command {
  RequestId id;
  Time received = kNever;
  std::variant<std::monostate, StartTask, CancelTask, ResetStop, ProposeOrigin, SetOrigin> body;
};

}  // namespace drover
