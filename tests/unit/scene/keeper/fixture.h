// A Keeper with a robot in a yard, in a test's hands.
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "drover/rotation.h"
#include "scene/keeper/keeper.h"
#include "scene/plane/sweep.h"

namespace drover::scene {

inline constexpr double kEndless = std::numeric_limits<double>::infinity();
inline constexpr GeodeticPoint kYard{48.0, 11.0, 500.0};

inline KeeperSettings keeper_settings() {
  KeeperSettings settings;
  settings.look.footprint = {{0.5, 0.35}, {-0.5, 0.35}, {-0.5, -0.35}, {0.5, -0.35}};
  settings.heights = {0.05, 0.6};
  settings.joints = {"left", "right", "arm"};
  return settings;
}

/// Its robot of 1.0 by 0.7 m stands at the map's origin and looks along x. Nothing is stored.
class AKeeper : public testing::Test {
 protected:
  explicit AKeeper(KeeperSettings settings = keeper_settings()) : keeper(std::move(settings)) {
    keeper.set_zones({}, "");
    keeper.set_scene_problem("");
    from.t = Time{std::chrono::seconds(100)};
    from.pose.position_sigma_m = 0;
    from.pose.yaw_sigma_rad = 0;
    from.origin_set = true;
    from.origin = kYard;
    keeper.see(from);
  }

  static CollisionObject box(const std::string& id, double x_m, double y_m, double side_m = 0.2,
                             const std::string& frame = "map") {
    CollisionObject message;
    message.id = id;
    message.header.frame_id = frame;
    message.primitives = {{SolidPrimitive::BOX, {side_m, side_m, 1}}};
    message.primitive_poses = {{{x_m, y_m, 0.5}, {}}};
    return message;
  }
  /// A rectangle of degrees about a place of the map.
  static Zone zone(const std::string& name, Zone::Kind kind, double x_m, double y_m,
                   double half_m) {
    const double east_deg = 1 / (111'320 * std::cos(kYard.latitude_deg * kPi / 180));
    const double north_deg = 1 / 111'200.0;
    const auto corner = [&](double dx_m, double dy_m) {
      return GeoPoint{kYard.latitude_deg + (y_m + dy_m) * north_deg,
                      kYard.longitude_deg + (x_m + dx_m) * east_deg};
    };
    Zone made;
    made.name = name;
    made.kind = kind;
    made.polygons = {{{corner(-half_m, -half_m), corner(half_m, -half_m), corner(half_m, half_m),
                       corner(-half_m, half_m)},
                      {}}};
    return made;
  }
  /// "done" with its notes, or the refusal.
  template <class Message>
  std::string apply(const Message& message) {
    return words(keeper.apply(message, {from.t, Duration{0}}));
  }
  static std::string words(const Result<Applied, Refusal>& result) {
    if (!result) return result.error().path + ": " + result.error().why;
    std::string text = "done";
    for (const std::string& note : result->notes) text += "; " + note;
    return text;
  }
  static std::string text(const Reason& reason) { return std::string(reason.view()); }
  /// Along x, a point each metre.
  static Path row(int metres) {
    Path path;
    path.number = 3;
    for (int i = 0; i <= metres; ++i) path.points.push_back({1.0 * i, 0});
    return path;
  }
  Clearance look(const Path* path = nullptr) {
    keeper.see(from);
    return keeper.look(path);
  }
  void on(const Path& path, std::uint32_t segment, double along_m, std::uint32_t target,
          bool forwards = true) {
    from.way = {path.number, forwards, target, segment, along_m};
  }
  std::optional<TrackOffence> check(const Path& path, std::uint32_t target) {
    keeper.see(from);
    const auto check = keeper.check(path, target);
    EXPECT_EQ(check->number(), keeper.number());
    int parts = 0;
    while (!check->advance(no_time)) {
      EXPECT_FALSE(check->offence().has_value());
      if (++parts > 100'000) {
        ADD_FAILURE() << "it does not end";
        break;
      }
    }
    return check->offence();
  }

  /// A part of a look and no more.
  static bool no_time() { return false; }

  Keeper keeper;
  Viewpoint from;
};

}  // namespace drover::scene
