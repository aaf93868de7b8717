// The storage thread's work: one job in, one reply out, in order.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "drover/command.h"
#include "store/files.h"
#include "store/origin_store.h"
#include "store/stop_store.h"
#include "store/track.h"
#include "store/track_store.h"

namespace drover::store {

struct SaveTrack {
  Track track;
};
struct DeleteTrack {
  std::string name;
};
struct DeleteAllTracks {};
struct SaveOrigin {
  GeodeticPoint origin;
};

struct StorageJob {
  RequestId id;
  std::variant<SaveTrack, DeleteTrack, DeleteAllTracks, SaveOrigin> what;
};

struct StorageReply {
  RequestId id;
  bool ok = false;                   ///< durable
  std::string reason;                ///< why not
  std::vector<std::string> removed;  ///< DeleteAllTracks: names that are gone, also when not ok
  std::optional<Track> track{};      ///< SaveTrack: given back
};

/// What was found at start.
struct StoredState {
  std::vector<Track> tracks;
  std::optional<GeodeticPoint> origin;
  Remembered stop;                  ///< what outlives a boot
  std::vector<std::string> report;  ///< for the log, a sentence each
  std::string origin_problem{};     ///< why the stored origin is lost; empty: it is not
};

/// Owns the state folder's content: `tracks/`, `origin.json`, `stop.json` and `stop.room`.
class Storage final {
 public:
  /// Makes `folder` and its `tracks` when they are missing.
  /// @throws std::runtime_error with folder and reason; start-up only
  Storage(Files& files, const std::string& folder);

  StoredState load();
  StorageReply run(StorageJob job);
  /// Returns nothing when it is durable.
  void keep_room_for_stop() { stop_.keep_room(); }
  std::optional<Failure> save_stop(const Remembered& remembered) { return stop_.save(remembered); }

 private:
  TrackStore tracks_;
  OriginStore origin_;
  StopStore stop_;
};

}  // namespace drover::store
