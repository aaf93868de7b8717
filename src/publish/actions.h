// What outlets and the command service want done: the runtime does it, in their order.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "drover/command.h"
#include "drover/event.h"
#include "publish/scene_jobs.h"
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

/// A StorageJob goes to the storage thread, a Command to the engine, a SceneJob to the scene's
/// thread and a SceneTextJob to its parser.
using Action = std::variant<PublishText, Answer, Reply, LogLine, store::StorageJob, Command,
                            SceneJob, SceneTextJob>;
using Actions = std::vector<Action>;

/// Appends a job for the scene's thread, or its parser, in its place: compilers see ghosts in what
/// is moved there.
template <class Job, class What>
Job& append_job(Actions& out, std::uint64_t number, What what) {
  Job& job = std::get<Job>(out.emplace_back(std::in_place_type<Job>));
  job.number = number;
  job.what.template emplace<What>(std::move(what));
  return job;
}

}  // namespace drover::publish
