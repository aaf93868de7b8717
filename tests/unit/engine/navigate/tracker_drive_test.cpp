// Closed loop: how near to the track a base with lagging, skidding wheels is driven.
#include <gtest/gtest.h>

#include <cstdio>
#include <string>

#include "unit/engine/navigate/tracker_rig.h"

namespace drover::engine {
namespace {

std::uint32_t last(const Path& path) {
  return static_cast<std::uint32_t>(path.points.size() - 1);
}

/// Worst of three seeds, driven over a track recorded with 1 cm of noise.
struct Figures {
  bool arrived = true;
  double rms_m = 0;
  double p95_m = 0;
  double max_m = 0;
  double final_m = 0;
};
Figures worst(const char* name, const Points& drawn, double speed_mps) {
  Figures figures;
  for (unsigned seed = 1; seed <= 3; ++seed) {
    const Path path = record(drawn, 0.5, 0.01, seed);
    DriveSetup setup;
    setup.speed_mps = speed_mps;
    setup.limits.max_speed_mps = 1.0;
    setup.plant.seed = seed;
    const Drive d = drive(path, last(path), setup);
    figures.arrived = figures.arrived && d.arrived;
    figures.rms_m = std::max(figures.rms_m, d.rms_m);
    figures.p95_m = std::max(figures.p95_m, d.p95_m);
    figures.max_m = std::max(figures.max_m, d.max_m);
    figures.final_m = std::max(figures.final_m, d.final_m);
  }
  std::printf("%-12s %.1f m/s: cross-track rms %.1f, p95 %.1f, max %.1f cm; goal %.1f cm\n", name,
              speed_mps, 100 * figures.rms_m, 100 * figures.p95_m, 100 * figures.max_m,
              100 * figures.final_m);
  return figures;
}

test::PlantConfig exact() {
  test::PlantConfig plant;
  plant.position_noise_m = 0;
  plant.yaw_noise_rad = 0;
  return plant;
}

TEST(TrackerDrive, HoldsRowsWithTurnsWithinTwoCentimetres) {
  const Figures f = worst("rows", rows(), 0.5);
  EXPECT_TRUE(f.arrived);
  EXPECT_LT(f.rms_m, 0.02);
  EXPECT_LT(f.max_m, 0.06);
  EXPECT_LT(f.final_m, 0.05);
}
TEST(TrackerDrive, HoldsRowsAtOneMetreASecond) {
  const Figures f = worst("rows", rows(), 1.0);
  EXPECT_TRUE(f.arrived);
  EXPECT_LT(f.rms_m, 0.02);
  EXPECT_LT(f.max_m, 0.07);
  EXPECT_LT(f.final_m, 0.05);
}
TEST(TrackerDrive, HoldsAFigureEight) {
  for (const double speed_mps : {0.5, 1.0}) {
    const Figures f = worst("figure eight", figure_eight(), speed_mps);
    EXPECT_TRUE(f.arrived);
    EXPECT_LT(f.rms_m, 0.025);
    EXPECT_LT(f.max_m, 0.07);
    EXPECT_LT(f.final_m, 0.05);
  }
}
TEST(TrackerDrive, TurnsOnTheSpotAtTheCornersOfASquare) {
  for (const double speed_mps : {0.5, 1.0}) {
    const Figures f = worst("square", square(), speed_mps);
    EXPECT_TRUE(f.arrived);
    EXPECT_LT(f.rms_m, 0.02);
    EXPECT_LT(f.max_m, 0.05);
    EXPECT_LT(f.final_m, 0.05);
  }
}
TEST(TrackerDrive, MissesACornerByLessThanThreeCentimetresWhenThePoseIsExact) {
  const Path path = record(square());
  for (const double speed_mps : {0.25, 0.5, 1.0}) {
    DriveSetup setup;
    setup.speed_mps = speed_mps;
    setup.limits.max_speed_mps = 1.0;
    setup.plant = exact();
    const Drive d = drive(path, last(path), setup);
    EXPECT_TRUE(d.arrived);
    EXPECT_LT(d.max_m, 0.02) << speed_mps;
  }
}
TEST(TrackerDrive, StopsWithinThreeCentimetresOfTheGoalWhenThePoseIsExact) {
  Pen pen;
  const Path path = record(pen.line(6).points());
  for (const double speed_mps : {0.05, 0.1, 0.2, 0.35, 0.5, 0.65, 0.8}) {
    DriveSetup setup;
    setup.speed_mps = speed_mps;
    setup.plant = exact();
    const Drive d = drive(path, last(path), setup);
    EXPECT_TRUE(d.arrived) << speed_mps;
    EXPECT_LT(d.final_m, 0.03) << speed_mps;
    EXPECT_NEAR(d.end.vx_mps, 0, 1e-3) << speed_mps;
  }
}
TEST(TrackerDrive, DrivesStraightWithoutJitterWhenThePoseIsExact) {
  Pen pen;
  const Path path = record(pen.line(10).points(), 0.5, 0.01, 5);
  DriveSetup setup;
  setup.plant = exact();
  const Drive d = drive(path, last(path), setup);
  EXPECT_LT(d.rms_m, 0.015);
  EXPECT_LT(d.mean_yaw_acceleration_radps2, 0.1);
}
TEST(TrackerDrive, SlowsSoMuchThatABendIsNotTooFast) {
  DriveSetup setup;
  setup.speed_mps = 0.8;
  setup.plant = exact();
  const Path path = record(rows());
  const Drive d = drive(path, last(path), setup);
  EXPECT_NEAR(d.fastest_mps, 0.8, 0.01);
  EXPECT_LT(d.most_lateral_mps2, 0.36);  // 0.3 configured; feedback adds a little
}
TEST(TrackerDrive, KeepsTheAskedSpeedAndTheCap) {
  Pen pen;
  const Path path = record(pen.line(10).points());
  DriveSetup setup;
  setup.plant = exact();
  const Drive asked = drive(path, last(path), setup);
  EXPECT_NEAR(asked.fastest_mps, 0.5, 0.01);
  setup.cap_mps = 0.25;
  const Drive capped = drive(path, last(path), setup);
  EXPECT_NEAR(capped.fastest_mps, 0.25, 0.01);
  EXPECT_TRUE(capped.arrived);
}
TEST(TrackerDrive, JoinsALineTwoMetresAsideWithoutSwingingOver) {
  Pen pen;
  const Path path = record(pen.line(15).points());
  for (const double side_m : {2.0, -2.0}) {
    for (const double turned_rad : {-0.5, 0.0, 0.5}) {
      DriveSetup setup;
      setup.plant = exact();
      setup.y_m = side_m;
      setup.yaw_rad = turned_rad;
      const Drive d = drive(path, last(path), setup);
      EXPECT_TRUE(d.arrived);
      EXPECT_LT(d.final_m, 0.04);
      EXPECT_LT(d.driven_m, 18);
    }
  }
}
TEST(TrackerDrive, BeginsBehindTheFirstPoint) {
  Pen pen;
  const Path path = record(pen.line(6).points());
  DriveSetup setup;
  setup.plant = exact();
  setup.x_m = -1.2;
  setup.y_m = 0.8;
  setup.yaw_rad = 0.4;
  const Drive d = drive(path, last(path), setup);
  EXPECT_TRUE(d.arrived);
  EXPECT_LT(d.final_m, 0.03);
}
TEST(TrackerDrive, DrivesAheadAlongTheListBackwards) {
  const Points drawn = rows();
  const Path path = record(drawn);
  DriveSetup setup;
  setup.x_m = drawn.back().x_m;
  setup.y_m = drawn.back().y_m;
  const PathPoint& before = drawn[drawn.size() - 50];
  setup.yaw_rad = std::atan2(before.y_m - setup.y_m, before.x_m - setup.x_m);
  const Drive d = drive(path, 4, setup);
  EXPECT_TRUE(d.arrived);
  EXPECT_LT(d.rms_m, 0.02);
  EXPECT_LT(d.final_m, 0.08);
}
TEST(TrackerDrive, LeavesACornerOfExactlyEqualDistances) {
  Path path;
  path.points = {{0, 0}, {3, 0}, {3, 3}};
  DriveSetup setup;
  setup.plant = exact();
  setup.x_m = 2.8;
  const Drive d = drive(path, 2, setup);
  EXPECT_TRUE(d.arrived);
  EXPECT_LT(d.max_m, 0.03);
}
TEST(TrackerDrive, TurnsRoundWhereTheTrackGoesBackOnItself) {
  Path path;
  path.points = {{0, 0}, {3, 0}, {0, 0.0}};
  DriveSetup setup;
  setup.plant = exact();
  setup.x_m = 1;
  const Drive d = drive(path, 2, setup);
  EXPECT_TRUE(d.arrived);
  EXPECT_LT(d.final_m, 0.03);
  EXPECT_NEAR(d.driven_m, 5, 0.1);
}
/// Points each 10 cm with a step back of 25 cm among them: it turned round and round, a metre
/// beside.
TEST(TrackerDrive, DrivesOnWhereARecordingStepsBackALittle) {
  for (const double spacing_m : {0.1, 0.2, 0.5}) {
    for (const double back_m : {0.03, 0.1, 0.2, 0.25}) {
      Path path;
      const auto row = [&](double from_m) {
        for (double x_m = from_m; x_m < from_m + 4; x_m += spacing_m)
          path.points.push_back({x_m, 0.002 * static_cast<double>(path.points.size() % 3)});
      };
      row(0);
      const double turn_m = path.points.back().x_m;
      for (double x_m = turn_m - spacing_m; x_m > turn_m - back_m; x_m -= spacing_m)
        path.points.push_back({x_m, 0.003});
      row(turn_m - back_m);
      const Drive d = drive(path, last(path), {});
      EXPECT_TRUE(d.arrived) << spacing_m << " " << back_m;
      EXPECT_LT(d.time_s, 22) << "it turns round, " << spacing_m << " " << back_m;
      EXPECT_LT(d.max_m, 0.04) << spacing_m << " " << back_m;
    }
  }
}
TEST(TrackerDrive, DrivesARoundedCornerOfDensePoints) {
  Pen pen;
  const Path path = record(pen.line(4).arc(0.4, kPi / 2).line(4).points(), 0.02, 0.003, 2);
  const Drive d = drive(path, last(path), {});
  EXPECT_TRUE(d.arrived);
  EXPECT_LT(d.rms_m, 0.03);
  EXPECT_LT(d.max_m, 0.10);
}
TEST(TrackerDrive, FindsASharpCornerAmongDensePoints) {
  Pen pen;
  const Path path = record(pen.line(3).turn(kPi / 2).line(3).points(), 0.01);
  DriveSetup setup;
  setup.plant = exact();
  const Drive d = drive(path, last(path), setup);
  EXPECT_TRUE(d.arrived);
  EXPECT_LT(d.max_m, 0.03);
}
TEST(TrackerDrive, DrivesTheWholeLoop) {
  Pen pen;
  const Path path = record(pen.arc(2, 2 * kPi).points());
  const Drive d = drive(path, last(path), {});
  EXPECT_TRUE(d.arrived);
  EXPECT_NEAR(d.driven_m, 2 * kPi * 2, 0.4);
}
TEST(TrackerDrive, NeedsNoTurnOnTheSpotWhenItMayNotTurnSo) {
  const Path path = record(square());
  DriveSetup setup;
  setup.navigate.pivot_angle_deg = 180;
  setup.plant = exact();
  const Drive d = drive(path, last(path), setup);
  EXPECT_TRUE(d.arrived);
  EXPECT_LT(d.max_m, 0.25);
}

}  // namespace
}  // namespace drover::engine
