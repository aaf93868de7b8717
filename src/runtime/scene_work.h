// The scene's thread without the thread: what it does of its jobs in a turn, a little at a time.
#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
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

  /// Reads what is stored, then does jobs in their order. Goes on while `time_left()` and there is
  /// something to do; each step is short.
  void work(const scene::TimeLeft& time_left);
  /// Goes on to look along tracks that are to be started, in their order, while there is time. Of
  /// what changed since the last call nothing is looked at before: a list of a thousand messages
  /// makes one of them begin anew once, not a thousand times.
  void check(const scene::TimeLeft& time_left);
  /// What was done is answered from here on: call it when the next look has told of it.
  void send_replies();
  /// Where the robot is now: what comes is placed by it.
  void see(const Viewpoint& from);
  /// What its scanners see now; of a robot without one it is never called.
  void set_sensors(const scene::sensor::FieldView& view) { keeper_.set_sensors(view); }
  /// The latest turn of one of them, by its number.
  void see_turn(std::uint8_t scanner, const scene::sensor::SeenTurn& turn) {
    keeper_.see_turn(scanner, turn);
  }
  /// From there, on the track that it drives.
  Clearance look() const;
  std::size_t objects() const { return keeper_.world().amount().objects; }
  std::size_t constraints() const { return keeper_.world().amount().constraints; }

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
  std::optional<scene::Refusal> restore_object(const store::NamedText& text);
  std::optional<scene::Refusal> restore_set(const std::string& text);
  void end_restoring();
  bool job_step();
  void take(publish::SceneJob job);
  void apply_next();
  Result<scene::Applied, scene::Refusal> apply(const scene::CollisionObject& message,
                                               const scene::Arrived& arrived);
  Result<scene::Applied, scene::Refusal> apply(const scene::Constraints& message,
                                               const scene::Arrived& arrived);
  void end_batch();
  bool check_first(const scene::TimeLeft& time_left);
  std::string_view not_now() const;
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
  std::deque<publish::SceneReply> unsent_;  ///< when these are many no new job is begun
  std::deque<std::shared_ptr<const Path>> paths_;
  std::uint64_t driven_ = 0;  ///< number of the path that is driven
  Owner owner_ = Owner::nobody;
  Time seen_ = kNever;     ///< the last viewpoint
  Time checked_ = kNever;  ///< then a track was found free, and is about to be driven
  /// Objects that are stored and cannot be read; nothing is added to what is not known.
  std::set<std::string, std::less<>> lost_objects_;
};

}  // namespace drover::runtime
