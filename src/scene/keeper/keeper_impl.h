// What the Keeper keeps; the look along a whole track goes by the same.
#pragma once

#include <optional>
#include <set>
#include <string>
#include <vector>

#include "scene/constraint/setting.h"
#include "scene/constraint/verdict.h"
#include "scene/keeper/keeper.h"
#include "scene/world/pose_history.h"

namespace drover::scene {

struct Keeper::Impl {
  explicit Impl(KeeperSettings given)
      : settings(std::move(given)), near_things(near_settings(settings)) {}
  static sensor::NearSettings near_settings(const KeeperSettings& settings);

  // What happened; each counts the number up.
  void change();
  /// How well the object's place is known; 0: there is none.
  double place_sigma_m(std::string_view id) const;
  /// After the world took it; `sigma_before_m` is what that was before.
  void on_object(const CollisionObject& message, double sigma_before_m, Applied& applied);
  /// What of the plane is left to the object, wherever of all that its sigma allows it is.
  Area with_error(Area area, double place_sigma_m) const;
  void place_all();
  void place_zones();
  void find_problem();
  void move_map(const Viewpoint& viewpoint);

  // By the last viewpoint.
  Pose2 pose() const;
  double position_sigma_m() const;
  double yaw_sigma_rad() const;
  Steering steering() const;
  /// Which constraint does not hold there; nothing known of tilt and joints when they are not
  /// measured.
  std::optional<Verdict> broken() const;
  Terms terms() const;

  KeeperSettings settings;
  World world;
  std::vector<Zone> zones;
  PoseHistory poses;
  Surroundings around;
  std::optional<Viewpoint> viewpoint;
  std::optional<sensor::FieldView> sensors;
  sensor::OwnWay own_way;
  sensor::NearThings near_things;
  std::vector<Name> scanners;  ///< by number
  bool zones_told = false;
  bool scene_told = false;
  std::string zones_problem;
  std::string scene_problem;
  bool origin_is_bad = false;
  std::set<std::string, std::less<>> changed_objects;
  std::set<std::string, std::less<>> changed_sets;
};

/// "constraint yard.position_constraints[0] (base_link) does not hold: 0.200 m outside".
Reason in_words(const Verdict& broken);
/// Of where the robot is: what a person can do about it besides. It stays at its end when the words
/// before it are long.
Reason with_way_out(const Verdict& broken);

}  // namespace drover::scene
