// The scene's thread without the thread: what it does of its jobs in a turn, a little at a time.
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "runtime/scene_exchange.h"
#include "scene/keeper/keeper.h"
#include "store/storage.h"

namespace drover::runtime {

class SceneWork final {
 public:
  /// `stored`: what the keeper begins with.
  SceneWork(scene::KeeperSettings settings, SceneExchange& exchange,
            std::shared_ptr<const store::StoredScene> stored);

  /// Reads what is stored, then jobs in their order, and between them looks along tracks that are
  /// to be started. Goes on while `time_left()` and there is something to do; each step is short.
  void work(const std::function<bool()>& time_left);
  /// Where the robot is now: what comes is placed by it.
  void see(const Viewpoint& from);
  /// What its scanners see now; of a robot without one it is never called.
  void set_sensors(const scene::sensor::FieldView& view) { keeper_.set_sensors(view); }
  /// From there, on the track that it drives.
  Clearance look() const;

 private:
  /// Messages of one job, of which some are done.
  struct Batch {
    publish::SceneJob job;
    std::size_t next = 0;
    publish::MessagesApplied applied;
  };
  struct Check {
    std::uint64_t number = 0;
    publish::CheckTrack what;
    std::unique_ptr<scene::TrackCheck> track;  ///< nullptr: not begun
    int begun = 0;                             ///< how often
  };
  /// How many texts of each kind were read.
  struct Restoring {
    std::size_t zones = 0;
    std::size_t texts = 0;
    std::vector<scene::Zone> good_zones;
    publish::SceneRestored reply;
  };

  bool restore_step();
  void restore_zone(const store::NamedText& text);
  void restore_text(const store::NamedText& text);
  std::optional<scene::Refusal> restore_object(const std::string& text);
  std::optional<scene::Refusal> restore_set(const std::string& text);
  void end_restoring();
  bool job_step();
  void take(publish::SceneJob job);
  void apply_next();
  void end_batch();
  bool check_step();
  void reply(std::uint64_t number, decltype(publish::SceneReply::what) what);
  publish::SceneListed list() const;
  std::shared_ptr<const publish::SceneContent> object(const std::string& name) const;
  std::shared_ptr<const publish::SceneContent> constraints(const std::string& name) const;
  void keep_path(std::shared_ptr<const Path> path);
  const Path* path(std::uint64_t number) const;

  SceneExchange& exchange_;
  std::shared_ptr<const store::StoredScene> stored_;
  scene::Keeper keeper_;
  std::optional<Restoring> restoring_;  ///< nothing: it is over
  std::optional<Batch> batch_;
  std::deque<Check> checks_;
  std::deque<publish::SceneReply> unsent_;  ///< the ring is full: no new job is begun
  std::deque<std::shared_ptr<const Path>> paths_;
  std::uint64_t driven_ = 0;  ///< number of the path that is driven
};

}  // namespace drover::runtime
