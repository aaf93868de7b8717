// The sweep along a track covers what the engine's tracker drives.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <string>
#include <vector>

#include "drover/angle.h"
#include "scene/plane/overlap.h"
#include "scene/plane/sweep.h"
#include "scene/plane/track_line.h"
#include "tests/unit/engine/navigate/tracker_rig.h"
#include "tests/unit/scene/plane/shapes.h"

namespace drover::scene {
namespace {

using engine::Pen;
using engine::record;

/// Where the base was, and what the tracker steered by: one in ten cycles.
struct Driven {
  std::vector<Pose2> poses;
  std::vector<double> speeds_mps;
  bool arrived = false;
};

Driven drive(const Path& path, const Pose2& from, double speed_mps) {
  constexpr double kTick_s = 0.005;
  const engine::BaseConfig base;
  const engine::LimitsConfig limits;
  test::PlantConfig quiet;
  quiet.position_noise_m = quiet.yaw_noise_rad = 0;
  test::Plant2d plant(base, quiet, from.x_m, from.y_m, from.yaw_rad);
  test::TwistRamp gate(limits);
  engine::Tracker tracker(engine::NavigateConfig{}, limits);
  const auto target = static_cast<std::uint32_t>(path.points.size() - 1);
  tracker.begin(path, target, speed_mps, plant.estimate());
  Driven driven;
  for (int tick = 0; tick < 200 * 120 && !driven.arrived; ++tick) {
    const drover::Pose pose = plant.estimate();
    const engine::TrackProgress progress = tracker.locate(pose);
    driven.arrived = progress.arrived;
    const Twist twist = gate.step(tracker.follow(pose, progress, 10, from_s(kTick_s)), kTick_s);
    plant.step(wheels_from_twist(sides_of(base), 1.0, twist, 1.5), kTick_s);
    const drover::Pose& truth = plant.truth();
    if (tick % 10 != 0) continue;
    driven.poses.push_back({truth.x_m, truth.y_m, truth.yaw_rad});
    driven.speeds_mps.push_back(twist.vx_mps);
  }
  return driven;
}

std::vector<Point2> points_of(const Path& path) {
  std::vector<Point2> points;
  for (const PathPoint& point : path.points) points.push_back({point.x_m, point.y_m});
  return points;
}

/// What the sweep takes of the plane, pieces of a footprint with a margin.
std::vector<Piece> swept_along(const Path& path, const Pose2& from, double near_m, double speed_mps,
                               double margin_m) {
  const std::vector<Point2> line = points_of(path);
  const Piece body = footprint(margin_m);
  const Steering steering{to_rad(60.0), std::max(speed_mps, 0.35)};
  const auto steps = track_steps(from, TrackPart{line, near_m, INFINITY, path.backwards}, steering,
                                 stride_m(body));
  std::vector<Piece> pieces;
  for (std::size_t i = 0; i + 1 < steps.size(); ++i)
    pieces.push_back(swept(body, steps[i].pose, steps[i + 1].pose));
  return pieces;
}

/// Corners of the true footprint that the sweep missed, and where the first one was.
struct Missed {
  int corners = 0;
  std::string first;
};
Missed missed(std::span<const Pose2> poses, const std::vector<Piece>& pieces) {
  Missed found;
  for (const Pose2& pose : poses)
    for (const Point2 corner : placed(footprint(), pose).corners) {
      const Piece point = disc(corner, 0);
      if (std::any_of(pieces.begin(), pieces.end(),
                      [&](const Piece& piece) { return overlaps(point, piece); }))
        continue;
      if (found.corners++ == 0)
        found.first = "a corner at " + std::to_string(corner.x_m) + ", " +
                      std::to_string(corner.y_m) + " of the base at " + std::to_string(pose.x_m) +
                      ", " + std::to_string(pose.y_m);
    }
  return found;
}

/// Half of the margin that the robot has about itself is enough for what steering is off.
constexpr double kMargin_m = 0.05;

void expect_covered(const Path& path, const char* what, Pose2 from = {}) {
  for (const double speed_mps : {0.3, 0.8}) {
    const Driven driven = drive(path, from, speed_mps);
    ASSERT_TRUE(driven.arrived) << what;
    const Missed found = missed(driven.poses, swept_along(path, from, 0, speed_mps, kMargin_m));
    EXPECT_EQ(found.corners, 0) << what << " at " << speed_mps << " m/s: " << found.first;
  }
}

TEST(SweptTracks, CoverCornersThatAreTurnedOnTheSpot) {
  Pen left;
  left.line(4).turn(kPi / 2).line(4);
  expect_covered(record(left.points()), "to the left");
  Pen right;
  right.line(4).turn(-to_rad(80.0)).line(3).turn(to_rad(120.0)).line(3);
  expect_covered(record(right.points()), "right and left");
}

TEST(SweptTracks, CoverWhatIsDrivenBackwards) {
  const Path turn = test::with_gears(record(test::three_point_turn()));
  expect_covered(turn, "from one cusp to the next");
  Pen pen;
  pen.line(4).turn(kPi / 2).line(3).arc(1, kPi).line(3);
  const Path all = test::with_gears(record(pen.points()), true);
  expect_covered(all, "all of it", {0, 0, kPi});
}

/// The same line, driven ahead and backwards, is not swept by the same corners: this footprint has
/// its longer half ahead.
TEST(SweptTracks, LieTheOtherWayRoundWhereTheyAreDrivenBackwards) {
  Pen pen;
  pen.line(4);
  const Path path = test::with_gears(record(pen.points()), true);
  const std::vector<Point2> line = points_of(path);
  const auto steps =
      track_steps({0, 0, kPi}, TrackPart{line, 0, INFINITY, path.backwards}, {}, 0.1);
  for (const Step& step : steps) EXPECT_NEAR(std::abs(wrap_rad(step.pose.yaw_rad)), kPi, 1e-6);
  EXPECT_NEAR(steps.back().pose.x_m, 4, 1e-6);
  EXPECT_NEAR(steps.back().driven_m, 4, 1e-6);
}

TEST(SweptTracks, CoverCornersThatAreDrivenThrough) {
  Pen pen;
  pen.line(4).turn(to_rad(50.0)).line(4).turn(-to_rad(40.0)).line(3);
  expect_covered(record(pen.points()), "a point each 0.5 m");
  expect_covered(record(pen.points(), 3), "sparse points");
}

TEST(SweptTracks, CoverArcsOfAMetre) {
  Pen pen;
  pen.line(3).arc(1, kPi).line(3).arc(1, -kPi).line(3);
  expect_covered(record(pen.points()), "a point each 0.5 m");
}

TEST(SweptTracks, CoverSparsePoints) {
  Path path;
  path.points = {{0, 0}, {6, 0}, {9, 3}, {9, 8}, {4, 11}};
  expect_covered(path, "five points");
}

/// Looked anew four times a second, by the speed that there is: what is driven in the second after
/// each look, in which the robot could stop. The track goes along x.
void expect_looks_cover(const Path& path, const char* what, Pose2 from) {
  for (const double speed_mps : {0.3, 0.8}) {
    const Driven driven = drive(path, from, speed_mps);
    ASSERT_TRUE(driven.arrived) << what;
    for (std::size_t i = 0; i < driven.poses.size(); i += 5) {
      const Pose2& pose = driven.poses[i];
      const std::size_t count = std::min<std::size_t>(20, driven.poses.size() - i);
      const auto pieces =
          swept_along(path, pose, std::max(pose.x_m, 0.0), driven.speeds_mps[i], kMargin_m);
      const Missed found = missed(std::span(driven.poses).subspan(i, count), pieces);
      EXPECT_EQ(found.corners, 0) << what << " at " << speed_mps << " m/s, looked at " << i * 0.05
                                  << " s: " << found.first;
    }
  }
}

TEST(SweptTracks, CoverTheWayOntoTheTrack) {
  Path path;
  path.points = {{0, 0}, {6, 0}, {12, 0}};
  expect_looks_cover(path, "0.3 m beside", {0, 0.3, 0});
  expect_looks_cover(path, "0.8 m beside", {1, -0.8, 0.2});
  expect_looks_cover(path, "turned", {1, 0, to_rad(30.0)});
  expect_looks_cover(path, "before its beginning", {-1, 0.2, 0});
}

/// Where it turns though it does not move, each place once.
std::vector<Point2> pivots_of(std::span<const Pose2> poses) {
  constexpr double kAtOnePlace_m = 0.1;
  std::vector<Point2> places;
  double turned_rad = 0;
  for (std::size_t i = 1; i < poses.size(); ++i) {
    const Point2 at = place_of(poses[i]);
    const bool stands = length_m(at - place_of(poses[i - 1])) < 1e-3;
    turned_rad = stands ? turned_rad + wrap_rad(poses[i].yaw_rad - poses[i - 1].yaw_rad) : 0;
    if (std::abs(turned_rad) < to_rad(20.0)) continue;
    if (places.empty() || length_m(places.back() - at) > kAtOnePlace_m) places.push_back(at);
  }
  return places;
}

void expect_same_pivots(const Path& path, const char* what) {
  const Driven driven = drive(path, {}, 0.5);
  ASSERT_TRUE(driven.arrived) << what;
  std::vector<Pose2> looked;
  for (const Step& step : track_steps({}, points_of(path), 0.1)) looked.push_back(step.pose);
  const auto theirs = pivots_of(driven.poses);
  const auto ours = pivots_of(looked);
  ASSERT_EQ(ours.size(), theirs.size()) << what;
  for (std::size_t i = 0; i < ours.size(); ++i)
    EXPECT_LT(length_m(ours[i] - theirs[i]), 0.08) << what;
}

TEST(SweptTracks, TurnOnTheSpotWhereTheTrackerDoes) {
  Pen close;
  close.line(3).turn(to_rad(65.0)).line(0.2).turn(to_rad(70.0)).line(0.35).turn(to_rad(80.0));
  close.line(3);
  expect_same_pivots(record(close.points(), 0.05), "close together");
  Pen apart;
  apart.line(3).turn(to_rad(65.0)).line(1).turn(-to_rad(120.0)).line(2).turn(to_rad(90.0)).line(2);
  expect_same_pivots(record(apart.points(), 0.05), "a metre and two apart");
  expect_same_pivots(record(apart.points()), "a point each 0.5 m");
  Path sharper;
  sharper.points = {{0, 0}, {4, 0}, {4.85, 1.81}, {1.95, 2.59}};
  expect_same_pivots(sharper, "the next point is a sharper corner");
}

/// Found at once, not by walking along the line.
TEST(SweptTracks, FollowTheTrackersSmoothLineToAMillimetre) {
  Pen pen;
  pen.line(3).arc(1, kPi / 2);
  Path path = record(pen.points());
  // Half a right angle is driven through, a whole one is turned on the spot.
  for (const PathPoint& point : {PathPoint{4, 2}, PathPoint{4, 3}, PathPoint{3.3, 3.7},
                                 PathPoint{2.6, 4.4}, PathPoint{1.9, 3.7}, PathPoint{1.2, 3}})
    path.points.push_back(point);
  const TrackLine line(points_of(path), to_rad(60.0));
  ASSERT_EQ(line.legs().size(), 2U);
  const track::Route route(path.points, path.points.size() - 1, true);
  for (const TrackLine::Leg& leg : line.legs()) {
    for (double s_m = leg.first_m - 0.3; s_m < leg.last_m + 0.3; s_m += 0.037) {
      const auto on = line.place(leg, s_m);
      const track::Reference there = smooth(route, leg, {leg.first, leg.first_m}, s_m);
      EXPECT_NEAR(on.point.x_m, there.point.x, 1e-9) << s_m;
      EXPECT_NEAR(on.point.y_m, there.point.y, 1e-9) << s_m;
      EXPECT_NEAR(on.yaw_rad, std::atan2(there.ahead.y, there.ahead.x), 1e-9) << s_m;
    }
  }
}

}  // namespace
}  // namespace drover::scene
