// The storage thread's work: one job in, one reply out, in order.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "drover/command.h"
#include "store/files.h"
#include "store/learned_store.h"
#include "store/origin_store.h"
#include "store/report_store.h"
#include "store/scene_store.h"
#include "store/scene_text.h"
#include "store/stop_store.h"
#include "store/track.h"
#include "store/track_store.h"
#include "store/zone_store.h"

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

/// All of the scene: what is not in it is gone.
struct SaveScene {
  std::vector<SceneText> texts;
};
/// A person gives up what was stored and cannot be read; the scene is `texts`.
struct AcceptLoss {
  std::vector<SceneText> texts;
};
struct SaveZone {
  std::string name;
  std::string text;
  double wall_s = 0;  ///< since the epoch, of its import
};
struct DeleteZone {
  std::string name;
};
struct ForgetUnreadableZones {};

struct SaveReport {
  ReportTexts texts;
};
struct ListReports {};
struct ReadReport {
  std::uint64_t number = 0;  ///< 0: the newest
};

struct SaveLearned {
  KeptLearned kept;
};

struct StorageJob {
  RequestId id;
  std::variant<SaveTrack, DeleteTrack, DeleteAllTracks, SaveOrigin, SaveScene, AcceptLoss, SaveZone,
               DeleteZone, ForgetUnreadableZones, SaveReport, ListReports, ReadReport, SaveLearned>
      what;
};

/// Whose answer it is: numbers of requests are each one's own.
enum class StoredFor : std::uint8_t { tracks, scene, reports, learned };
StoredFor stored_for(const StorageJob& job);

struct StorageReply {
  RequestId id;
  bool ok = false;                   ///< durable
  std::string reason;                ///< why not
  std::vector<std::string> removed;  ///< DeleteAllTracks: names that are gone, also when not ok
  std::optional<Track> track{};      ///< SaveTrack: given back
  StoredFor whose = StoredFor::tracks;
  std::vector<StoredReport> reports{};  ///< ListReports: all, the newest first; ReadReport: it
};

/// The scene is wanted, too; by it objects grow old.
struct SceneAge {
  double wall_s = 0;                  ///< now, since the epoch
  std::optional<double> max_age_s{};  ///< of objects; nothing: none is too old
};

/// Texts that the store does not understand.
struct StoredScene {
  std::vector<NamedText> texts;  ///< objects and constraints
  std::string problem;           ///< what of it is lost; empty: nothing is
  std::vector<NamedText> zones;
  std::string zones_problem;  ///< why they are not known; empty: these are all
  bool is_unsaved = false;    ///< the disk had not taken `texts`: save them
};

/// What was found at start.
struct StoredState {
  std::vector<Track> tracks;
  std::optional<GeodeticPoint> origin;
  Remembered stop;                             ///< what outlives a boot
  std::vector<std::string> report;             ///< for the log, a sentence each
  std::string origin_problem{};                ///< why the stored origin is lost; empty: it is not
  std::shared_ptr<const StoredScene> scene{};  ///< nullptr: it was not asked for
  std::optional<KeptLearned> learned{};        ///< of whatever configuration
};

/// Owns the state folder's content: `tracks/`, `reports/`, `origin.json`, `stop.json`, `stop.room`,
/// `learned.json`, `scene.texts`, `zones.texts` and the marks of these in `kept/`.
class Storage final {
 public:
  /// Makes `folder`, its `tracks` and its `reports` when they are missing. `run_folder` exists; see
  /// SceneStore.
  /// @throws std::runtime_error with folder and reason; start-up only
  Storage(Files& files, const std::string& folder, const std::string& run_folder = {});

  /// `scene`: nothing leaves the scene's files as they are.
  StoredState load(const std::optional<SceneAge>& scene = {});
  StorageReply run(StorageJob job);
  /// Returns nothing when it is durable.
  void keep_room_for_stop() { stop_.keep_room(); }
  std::optional<Failure> save_stop(const Remembered& remembered) { return stop_.save(remembered); }

 private:
  TrackStore tracks_;
  OriginStore origin_;
  StopStore stop_;
  SceneStore scene_;
  ZoneStore zones_;
  ReportStore reports_;
  LearnedStore learned_;
};

}  // namespace drover::store
