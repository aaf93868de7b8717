// What outlets and the command service want done: the runtime does it, in their order.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "drover/command.h"
#include "drover/event.h"
#include "store/storage.h"

namespace drover::publish {

/// Publish on the broker, not retained.
struct PublishText {
  std::string_view topic;
  std::string text;
};
/// What became of a request that is not the broker's, for the outlet that gave it to the service;
/// `text` is the reason of a failure or the note of a success.
struct Answer {
  RequestId id;
  bool ok = false;
  std::string text;
};
/// One who is connected to a socket of the daemon's own.
using ClientId = std::uint64_t;
/// A line to such a client, who may be gone meanwhile.
struct Reply {
  ClientId client = 0;
  std::string line;
};
struct LogLine {
  Notice::Level level = Notice::Level::info;
  std::string text;
};

/// A StorageJob goes to the storage thread, a Command to the engine.
using Action = std::variant<PublishText, Answer, Reply, LogLine, store::StorageJob, Command>;
using Actions = std::vector<Action>;

}  // namespace drover::publish
