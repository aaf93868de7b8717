// The scene begins a track where the engine does.
#include "scene/keeper/track_start.h"

#include <gtest/gtest.h>

#include <random>

#include "drover/angle.h"
#include "track/flaw.h"
#include "track/path_search.h"

namespace drover::scene {
namespace {

bool is_track(const Path& path, std::uint32_t target) {
  return track::check_path(path, target).empty();
}

/// A walk that turns and crosses itself, at times a loop.
Path any_track(std::mt19937& random) {
  std::uniform_real_distribution<> turn_rad(-1, 1);
  std::uniform_real_distribution<> step_m(0, 1);
  Path path;
  double yaw_rad = turn_rad(random);
  PathPoint at;
  const int points = 3 + static_cast<int>(random() % 60);
  for (int i = 0; i < points; ++i) {
    path.points.push_back(at);
    yaw_rad += turn_rad(random);
    const double way_m = random() % 9 == 0 ? 0 : step_m(random);
    at.x_m += way_m * std::cos(yaw_rad);
    at.y_m += way_m * std::sin(yaw_rad);
  }
  if (random() % 2 == 0) path.points.push_back(path.points.front());
  return path;
}

TEST(TrackStart, IsWhereTheEngineBegins) {
  std::mt19937 random(7);
  std::uniform_real_distribution<> at_m(-6, 6);
  for (int round = 0; round < 3000; ++round) {
    const Path path = any_track(random);
    const std::size_t target = random() % 3 == 0 ? 0 : random() % path.points.size();
    if (!is_track(path, target)) continue;
    const Pose2 pose{at_m(random), at_m(random), 0.5 * at_m(random)};
    const WayLeft way = way_of_start(path, target, pose);
    const track::Vector at{pose.x_m, pose.y_m};
    const std::size_t goal = track::target_ahead(path.points, target, at, pose.yaw_rad);
    const track::PathStart start = track::find_start(path.points, goal, at, pose.yaw_rad);
    ASSERT_EQ(way.target, goal) << round;
    ASSERT_EQ(way.forwards, start.forwards) << round;
    ASSERT_EQ(way.segment, start.forwards ? start.segment : start.segment + 1) << round;
    const PathPoint& a = path.points[start.segment];
    const PathPoint& b = path.points[start.segment + 1];
    const double side_m = std::hypot(b.x_m - a.x_m, b.y_m - a.y_m);
    ASSERT_NEAR(way.along_m, start.forwards ? start.along_m : side_m - start.along_m, 1e-12);
  }
}

TEST(TrackStart, IsOnNoTrackThatIsNone) {
  Path path;
  EXPECT_FALSE(is_track(path, 0));
  path.points = {{0, 0}, {0, 0}};
  EXPECT_FALSE(is_track(path, 0));
  path.points = {{0, 0}, {1, 0}};
  EXPECT_TRUE(is_track(path, 1));
  EXPECT_FALSE(is_track(path, 2));
  path.points[1].x_m = 1000;
  EXPECT_FALSE(is_track(path, 1));
  path.points[1].y_m = NAN;
  EXPECT_FALSE(is_track(path, 0));
  path.points.assign(200, {1, 0});
  path.points[0].x_m = 0;
  EXPECT_FALSE(is_track(path, 199)) << "the engine would refuse it";
}

}  // namespace
}  // namespace drover::scene
