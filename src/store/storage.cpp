// The storage thread's work: one job in, one reply out, in order.
#include "store/storage.h"

#include <stdexcept>

namespace drover::store {
namespace {

/// Makes the folders before the stores that live in them; their names must be durable too.
std::string prepared(Files& files, const std::string& folder) {
  const auto need = [](int error, const std::string& path) {
    if (error != 0) throw std::runtime_error(failure_text("use folder", path, error));
  };
  need(files.make_folder(folder), folder);
  need(files.make_folder(folder + "/tracks"), folder + "/tracks");
  files.sync_folder(folder);  // on a read-only disk it fails, and everything else goes on
  return folder;
}

}  // namespace

Storage::Storage(Files& files, const std::string& folder)
    : tracks_(files, prepared(files, folder) + "/tracks"),
      origin_(files, folder),
      stop_(files, folder) {}

StoredState Storage::load() {
  StoredState state;
  state.tracks = tracks_.load(state.report);
  state.origin = origin_.load(state.report);
  state.origin_problem = origin_.problem();
  state.stop = stop_.load(state.report);
  return state;
}

StorageReply Storage::run(StorageJob job) {
  StorageReply reply;
  reply.id = job.id;
  std::optional<Failure> failure;
  if (auto* save = std::get_if<SaveTrack>(&job.what)) {
    failure = tracks_.save(save->track);
    reply.track = std::move(save->track);
  } else if (const auto* one = std::get_if<DeleteTrack>(&job.what)) {
    failure = tracks_.remove(one->name);
  } else if (const auto* origin = std::get_if<SaveOrigin>(&job.what)) {
    failure = origin_.save(origin->origin);
  } else {
    failure = tracks_.remove_all(reply.removed);
  }
  reply.ok = !failure;
  if (failure) reply.reason = failure->text;
  return reply;
}

}  // namespace drover::store
