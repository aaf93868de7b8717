// The scene at work: takes messages, zones, poses and turns of scanners, and answers what is free.
//
// One thread's. No clock, no descriptor: time is an argument. Whoever runs it hands over what came
// and carries what is to be stored to the disk.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "drover/clearance.h"
#include "drover/path.h"
#include "drover/result.h"
#include "drover/viewpoint.h"
#include "scene/constraint/at_start.h"
#include "scene/look/look.h"
#include "scene/plane/section.h"
#include "scene/sensor/near_things.h"
#include "scene/sensor/seen.h"
#include "scene/world/world.h"
#include "scene/zone/zone.h"

namespace drover::scene {

struct KeeperSettings {
  LookSettings look;                ///< its steering follows from the three below
  Heights heights;                  ///< infinite on both sides: height is not looked at
  RobotModel robot;                 ///< frames and bodies
  std::vector<std::string> joints;  ///< names, by AxisId
  // As the tracker has them.
  double pivot_rad = to_rad(60.0);  ///< where a track turns by so much it is turned on the spot
  double lookahead_s = 1.0;
  double min_lookahead_m = 0.35;
  /// What a scanner saw close to the robot and does not see any more is there so long: longer than
  /// a task waits for it to leave, so that nobody turns into it because nobody looked.
  Duration seen_kept = std::chrono::seconds(130);
};

/// When a message came, as Placement has it.
struct Arrived {
  Time at = kNever;
  Duration wall_ahead{0};
  /// Why it may have been sent long before: who brought it held messages back. Empty: at once.
  std::string late{};
};

/// Why a track is not started: the first thing on it that something is in the way of.
struct TrackOffence {
  std::size_t point = 0;  ///< of the path, counted from 0: the last one before it
  double way_m = 0;       ///< along the track from the robot on; 0: where it is
  std::string what;       ///< the object, the zone or the constraint, and what of it; a sentence
};

/// What the store has to have of an object: one text, a list of these messages, with the origin.
struct StoredObject {
  std::vector<CollisionObject> messages;  ///< an ADD, then APPENDs of what is too much for it
  GeodeticPoint origin;                   ///< of the map that they are in
  double place_sigma_m = 0;               ///< how well its place in that is known
};
/// And of a set of constraints.
struct StoredSet {
  Constraints message;
  GeodeticPoint origin;
};

/// A look along a whole track before it is started. It may be long, so it is done in parts.
class TrackCheck;

class Keeper final {
 public:
  struct Impl;
  explicit Keeper(KeeperSettings settings);
  ~Keeper();
  Keeper(Keeper&&) noexcept;
  Keeper& operator=(Keeper&&) noexcept;

  // What is stored. Until each of both was told, nothing is free.
  /// Replaces all zones; `problem`: why the stored ones are not known (nothing is free then), empty
  /// when they are.
  void set_zones(std::vector<Zone> zones, const std::string& problem);
  /// `problem`: why stored objects or constraints are lost; empty: they are not.
  void set_scene_problem(const std::string& problem);

  // Messages, of any wire; each was found valid by itself (message/validate.h). Applied::notes
  // belong to the answer.
  Result<Applied, Refusal> apply(const CollisionObject& message, const Arrived& arrived);
  Result<Applied, Refusal> apply(const Constraints& message, const Arrived& arrived);
  /// What was stored under another origin, message by message: at its place on earth. The origin
  /// that is in force need not be known yet.
  Result<Applied, Refusal> restore(const CollisionObject& message, const GeodeticPoint& origin,
                                   double place_sigma_m = 0);
  Result<Applied, Refusal> restore(const Constraints& message, const GeodeticPoint& origin);
  /// What was restored of an object of which the rest cannot be: nothing of it is there, and
  /// nothing to be stored.
  void forget(std::string_view id);
  /// Objects and constraints; zones stay.
  void clear();

  const World& world() const;
  const std::vector<Zone>& zones() const;
  /// Another one with each change of what is around.
  std::uint64_t number() const;

  // For the store: what `apply` and `clear` changed since they were asked last, each name once;
  // what is not there any more is to be deleted.
  std::vector<std::string> take_changed_objects();
  std::vector<std::string> take_changed_sets();
  /// Nothing: there is none of that name.
  std::optional<StoredObject> stored_object(std::string_view id) const;
  std::optional<StoredSet> stored_set(std::string_view name) const;

  /// Each turn, before look(): where the robot is; moves the map when its origin moved.
  void see(const Viewpoint& from);
  /// What the scanners see now, as long as that is true; nothing: there are none.
  void set_sensors(const std::optional<sensor::FieldView>& view);
  /// The latest turn of a scanner, by its number from 0; after see(). The same one again changes
  /// nothing. It bounds turns as long as set_sensors() has something.
  void see_turn(std::uint8_t scanner, const sensor::SeenTurn& turn);
  /// By the last viewpoint. `path` is the one that its way is on; nullptr or another one: none, or
  /// it is not here yet. Then Clearance::path is 0.
  Clearance look(const Path* path) const;

  /// For people: the point of the object, as far as the robot's height reaches and with the
  /// uncertainty of its place, that is nearest to base_link. Nothing: the robot does not know where
  /// it is, or none of the object is as high or as low as the robot.
  std::optional<Point2> nearest_of(std::string_view object) const;

  /// From the robot to `target`, an index of the path's points, or on a closed loop to its other
  /// end, as a task does. `path` is the caller's, and stays as it is until the check ends; so does
  /// the Keeper.
  std::unique_ptr<TrackCheck> check(const Path& path, std::uint32_t target) const;

 private:
  std::unique_ptr<Impl> impl_;
};

class TrackCheck final {
 public:
  struct Impl;
  explicit TrackCheck(std::unique_ptr<Impl> impl);
  ~TrackCheck();

  /// Looks at 20 m more, or a part of what is to be judged there, and goes on while there is time;
  /// true when it is done. A step between two questions for the time takes a millisecond or a few,
  /// however many constraints there are. When the scene changes meanwhile it ends with an offence
  /// that says so.
  bool advance(const TimeLeft& time_left);
  /// Once done: nothing stands on the track, or what does.
  const std::optional<TrackOffence>& offence() const;
  /// Of the scene that it looked at: when Keeper::number() is another one, it has to begin anew.
  std::uint64_t number() const;

 private:
  std::unique_ptr<Impl> impl_;
};

}  // namespace drover::scene
