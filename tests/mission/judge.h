// Whether the robot touched anything, by geometry of its own: the outline of the robot at each true
// pose against the true shapes, in the plane at the robot's heights. Knows nothing of src/scene.
#pragma once

#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "drover/time.h"
#include "mission/track.h"

namespace drover::mission {

/// A convex polygon, counter-clockwise, grown by a radius: one corner alone makes a disc.
struct Flat {
  std::vector<Place> corners;
  double radius_m = 0;
};

/// Between two of them; negative: they overlap, by about so much. Exact while they do not.
double gap_m(const Flat& a, const Flat& b);

/// Of field_scene.xml's robot.
struct RobotShape {
  double front_m = 0.45;
  double rear_m = 0.415;
  double side_m = 0.35;
  double low_m = 0.05;  ///< over the ground
  double top_m = 1.0;
};
Flat outline(double x_m, double y_m, double yaw_rad, const RobotShape& robot = {});

/// As the simulator put it there: upright, on flat ground.
struct TrueSolid {
  std::string name;
  std::string kind;  ///< box, cylinder, sphere, cone, prism
  double x_m = 0;
  double y_m = 0;
  double z_m = 0;  ///< of the middle of its height
  double yaw_rad = 0;
  std::vector<double> sizes;  ///< as objects.log has them
};
/// What of it is at the robot's heights; nothing: it is above or below them.
std::optional<Flat> flat(const TrueSolid& solid, const RobotShape& robot = {});

/// A line of objects.log.
struct ObjectLine {
  Time time = kNever;
  std::string verb;  ///< watching, put, at, gone, touch, leave
  std::string name;
  TrueSolid solid;              ///< of put
  std::vector<double> numbers;  ///< of at, touch, leave
};
/// Throws std::runtime_error.
ObjectLine parse_object_line(std::string_view line);

struct TruePose {
  Time time = kNever;
  double x_m = 0;
  double y_m = 0;
  double yaw_rad = 0;
  double vx_mps = 0;
  double wz_radps = 0;
  bool moves() const { return std::abs(vx_mps) > 0.01 || std::abs(wz_radps) > 0.01; }
};

/// What stands where it may not: a fence, say, that is no thing.
struct Fence {
  std::string name;
  Flat flat;
  Time begin = kNever;
  Time end = Time::max();
};

struct Near {
  Time time = kNever;
  std::string what;
  double gap_m = std::numeric_limits<double>::infinity();
  bool moving = false;
};
struct Verdict {
  std::size_t poses = 0;             ///< looked at
  std::size_t things = 0;            ///< that stood at the robot's heights
  Near nearest;                      ///< of all
  Near nearest_moving;               ///< of all while it moved
  std::optional<Near> first;         ///< overlap
  std::optional<Near> first_moving;  ///< overlap while it moved
};
/// Over all poses from `begin` to `end`, each against what was there then.
Verdict judge(const std::vector<TruePose>& poses, const std::vector<ObjectLine>& objects,
              const std::vector<Fence>& fences = {}, Time begin = kNever, Time end = Time::max());

/// How far from the robot each thing was at `time`, nearest first.
std::vector<Near> gaps_at(const TruePose& pose, const std::vector<ObjectLine>& objects,
                          const std::vector<Fence>& fences = {});

}  // namespace drover::mission
