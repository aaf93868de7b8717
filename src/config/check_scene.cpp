// The scene: a footprint that can be swept, heights, frames with names of their own, and whether it
// is looked far enough for the speeds that are permitted.
#include <algorithm>
#include <array>
#include <cmath>

#include "config/check_subjects.h"
#include "engine/clearance/stop_chain.h"
#include "text/frame_name.h"
#include "text/number.h"

namespace drover::config {
namespace {

constexpr auto kFootprint = "scene.footprint";
constexpr double kLeastArea_m2 = 0.01;
constexpr double kSamePlace_m = 1e-6;
/// What messages mean by these names is no frame of the robot's own.
constexpr std::array<std::string_view, 4> kNamesOfTheScene{"map", "base_link", "0", "1"};

std::string corner_path(std::size_t i) {
  return std::string(kFootprint) + "[" + std::to_string(i) + "]";
}

/// Twice the area of the triangle; positive when `c` is left of the way from `a` to `b`.
double turn_m2(const CornerConfig& a, const CornerConfig& b, const CornerConfig& c) {
  return (b.x_m - a.x_m) * (c.y_m - a.y_m) - (b.y_m - a.y_m) * (c.x_m - a.x_m);
}

double area_m2(const std::vector<CornerConfig>& corners) {
  double twice = 0;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const auto& b = corners[(i + 1) % corners.size()];
    twice += corners[i].x_m * b.y_m - corners[i].y_m * b.x_m;
  }
  return twice / 2;
}

bool find_same_place(const std::vector<CornerConfig>& corners, Findings& found) {
  for (std::size_t i = 1; i < corners.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if (std::hypot(corners[i].x_m - corners[j].x_m, corners[i].y_m - corners[j].y_m) >
          kSamePlace_m)
        continue;
      found.add(corner_path(i), "is the same place as corner " + std::to_string(j) + " (from 0)",
                "the last side closes by itself");
      return true;
    }
  }
  return false;
}

/// Of corners in order, counter-clockwise: each lies left of each side, or on it.
bool is_left_of_all_sides(const std::vector<CornerConfig>& corners) {
  for (std::size_t i = 0; i < corners.size(); ++i)
    for (const auto& corner : corners)
      if (turn_m2(corners[i], corners[(i + 1) % corners.size()], corner) < -1e-9) return false;
  return true;
}

void find_not_convex(const std::vector<CornerConfig>& corners, Findings& found) {
  if (is_left_of_all_sides(corners)) return;
  const std::size_t n = corners.size();
  for (std::size_t i = 0; i < n; ++i) {
    if (turn_m2(corners[(i + n - 1) % n], corners[i], corners[(i + 1) % n]) >= 0) continue;
    found.add(corner_path(i), "points inwards: the footprint has to be convex",
              "leave this corner out, or write the corners in the order in which a walk around the "
              "robot meets them");
    return;
  }
  found.add(kFootprint, "its sides cross each other",
            "write the corners in the order in which a walk around the robot meets them");
}

/// What is not in it would not be looked for: the place that it turns about, and its wheels.
void find_left_out(const DroverConfig& config, Findings& found) {
  const auto& corners = config.scene.footprint;
  const CornerConfig base_link;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    if (turn_m2(corners[i], corners[(i + 1) % corners.size()], base_link) >= 0) continue;
    found.add(kFootprint, "base_link (0, 0) is outside of it",
              "corners are seen from base_link, the place that the robot turns about");
    return;
  }
  for (const char* const of : {"groups", "groups.base", "groups.base.track_m"})
    if (found.is_wrong(of)) return;
  const double wheel_m = config.engine.base.track_m / 2;
  const auto [right, left] = std::minmax_element(
      corners.begin(), corners.end(), [](const auto& a, const auto& b) { return a.y_m < b.y_m; });
  if (left->y_m < wheel_m || right->y_m > -wheel_m)
    found.add(kFootprint,
              "does not reach the wheels, " + text::formed("%.3g", wheel_m) +
                  " m to each side of base_link by groups.base.track_m",
              "it is all that the robot covers");
}

void check_footprint(Findings& found) {
  auto& corners = found.config().scene.footprint;
  if (found.has_problem(kFootprint) || find_same_place(corners, found)) return;
  const double area = area_m2(corners);
  if (area < 0) {
    // Told by their places in the file.
    std::vector<CornerConfig> ccw(corners.rbegin(), corners.rend());
    if (!is_left_of_all_sides(ccw)) {
      for (auto& corner : corners) corner.y_m = -corner.y_m;
      find_not_convex(corners, found);
      return;
    }
    corners = std::move(ccw);
  } else {
    find_not_convex(corners, found);
  }
  if (found.has_problem(kFootprint)) return;
  if (std::abs(area) < kLeastArea_m2)
    found.add(kFootprint, "covers less than 0.01 m2", "its corners are in m");
  else
    find_left_out(found.config(), found);
}

/// What follows from the footprint and the margin.
void fill_clearance(DroverConfig& config) {
  SceneConfig& scene = config.scene;
  // Half of the margin is for curves that change between two looks; what a scanner sees beside them
  // is looked at with half of it, and a half of that is. Without any nothing could move.
  const double part = first(config, SlotKind::scanner) == nullptr ? 0.5 : 0.25;
  constexpr double kLeast_m = 0.01;
  constexpr double kMost_m = engine::ClearanceConfig{}.beside_m;
  scene.clearance.beside_m = std::clamp(part * scene.margin_m, kLeast_m, kMost_m);
  double reach_m = 0;
  for (const auto& corner : scene.footprint)
    reach_m = std::max(reach_m, std::hypot(corner.x_m, corner.y_m));
  scene.clearance.reach_m = reach_m;
}

void check_heights(Findings& found) {
  const auto& scene = found.config().scene;
  if (found.has_problem("scene.height_m") || found.has_problem("scene.ground_clearance_m")) return;
  if (scene.ground_clearance_m >= scene.height_m)
    found.add("scene.ground_clearance_m", "is not below scene.height_m",
              "nothing would be in the way of a robot that is all clearance");
}

void check_frames(Findings& found) {
  for (const auto& frame : found.config().scene.frames) {
    const auto path = "scene.frames." + frame.name;
    const std::string_view name = text::without_slash(frame.name);
    if (std::find(kNamesOfTheScene.begin(), kNamesOfTheScene.end(), name) !=
        kNamesOfTheScene.end()) {
      found.add(path, "\"" + frame.name + "\" means something else in messages",
                "map and 1 are the map, 0 is no frame, base_link is the base itself: choose "
                "another name");
    } else if (name.size() != frame.name.size()) {
      found.add(path, "begins with a slash, which messages leave out",
                "write \"" + std::string(name) + "\"");
    }
  }
}

/// Towards the end of what was looked at a base comes as gently as towards a wall.
engine::StopChain chain_of(const engine::EngineConfig& engine) {
  return {engine.clearance.reaction_s, engine::kGentle * engine.limits.deceleration_mps2};
}

}  // namespace

void check_scene(Findings& found) {
  if (!found.config().scene.configured) return;
  check_footprint(found);
  fill_clearance(found.config());
  check_heights(found);
  check_frames(found);
}

void warn_of_short_look(Findings& found) {
  const auto& config = found.config();
  if (!config.scene.configured || found.has_problem("scene") || found.has_problem("limits")) return;
  const auto chain = chain_of(config.engine);
  const double wanted_mps = fastest_mps(config);
  // Round up: who writes the number that is told shall not be warned again.
  const double needed_m = std::ceil(100 * engine::stop_way(wanted_mps, chain)) / 100;
  const auto judge = [&](const std::string& path, double look_m, const char* whom) {
    const double possible_mps = engine::permitted_speed(look_m, chain);
    if (possible_mps >= wanted_mps) return;
    found.warn(path,
               "reaches for " + text::formed("%.2f m/s", possible_mps) + ": " + whom +
                   " no faster, though " +
                   (wanted_mps < config.engine.limits.max_speed_mps ? "the chassis' own is "
                                                                    : "limits.max_speed_mps is ") +
                   text::formed("%.2f", wanted_mps) +
                   ", because what was not looked at is not free",
               "short_look", text::formed("%.2f m or more", needed_m));
  };
  judge("scene.ahead_m", config.scene.ahead_m, "without a track the robot is");
  judge("scene.along_m", config.scene.along_m, "a task is");
}

}  // namespace drover::config
