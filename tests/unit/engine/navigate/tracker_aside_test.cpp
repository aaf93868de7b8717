// A base that goes sideways, in closed loop with gate, wheels and lagging drives: a small offset is
// gone out sideways, the heading stays along the line.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

#include "drover/angle.h"
#include "engine/base/kinematics.h"
#include "engine/gate/target_gate.h"
#include "unit/engine/navigate/tracker_rig.h"

namespace drover::engine {
namespace {

constexpr Duration kTick = std::chrono::milliseconds(5);
constexpr double kTick_s = 0.005;

BaseConfig rollers() {
  BaseConfig base;
  base.kind = BaseKind::mecanum;
  base.wheel_radius_m = 0.076;
  base.track_m = 0.44;
  base.wheelbase_m = 0.3;
  for (AxisId id = 0; id < 4; ++id) (void)(id % 2 == 0 ? base.left : base.right).push_back(id);
  return base;
}

/// How a base on rollers went.
struct Aside {
  bool arrived = false;
  double rms_m = 0;
  double max_m = 0;         ///< off the line
  double turned_rad = 0;    ///< away from a straight line along x, at the most
  double back_after_m = 0;  ///< of way: from there on it stays within 1.5 cm of it
  double final_m = 0;
  double fastest_mps = 0;
  double fastest_aside_mps = 0;
  double fastest_rim_mps = 0;
  std::vector<Twist> told;  ///< by the tracker
};

class ATrackerOnRollers : public ::testing::Test {
 protected:
  Aside go(const Path& path, bool may_go_aside) const {
    const Kinematics base = kinematics_of(rollers());
    const double max_rim = max_rim_mps(base, setup.limits, {});
    test::Plant2d plant(rollers(), setup.plant, setup.x_m, setup.y_m, setup.yaw_rad);
    TargetGate gate(setup.limits, std::chrono::milliseconds(100), limits(base));
    Tracker tracker(setup.navigate, setup.limits, limits(base));
    const auto target = static_cast<std::uint32_t>(path.points.size() - 1);
    tracker.begin(path, target, setup.speed_mps, plant.estimate());
    Aside found;
    double square_m2 = 0;
    double way_m = 0;
    Time now{std::chrono::seconds(100)};
    int ticks = 0;
    for (int rest = 200; rest > 0 && ticks < 60000; ++ticks) {
      const Pose pose = plant.estimate();
      const TrackProgress progress = tracker.locate(pose);
      found.arrived = found.arrived || progress.arrived;
      if (found.arrived) --rest;
      const Twist wanted = found.arrived
                               ? Twist{}
                               : tracker.follow(pose, progress, setup.cap_mps, kTick, may_go_aside);
      found.told.push_back(wanted);
      now += kTick;
      const Offer offer{Owner::task, wanted, now};
      const JointVelocities radps =
          setpoints(base, gate.step(now, kTick, {&offer, 1}, Stop::none), {}, max_rim);
      for (const double one : radps)
        found.fastest_rim_mps = std::max(found.fastest_rim_mps, std::abs(rim_mps(base, one)));
      const Twist twist = twist_of(base, radps, {});
      const TwoSides& sides = std::get<Mecanum>(base).sides;
      plant.step(wheels_from_twist(sides, 1.0, twist, 10), kTick_s, twist.vy_mps);
      const Pose& truth = plant.truth();
      const double off_m = test::distance_m(path.points, truth.x_m, truth.y_m);
      way_m += std::abs(truth.vx_mps) * kTick_s;
      if (off_m > 0.015) found.back_after_m = way_m;
      found.max_m = std::max(found.max_m, off_m);
      square_m2 += off_m * off_m;
      const double looks_rad = tracker_looks_back ? wrap_rad(truth.yaw_rad - kPi) : truth.yaw_rad;
      found.turned_rad = std::max(found.turned_rad, std::abs(looks_rad));
      found.fastest_mps = std::max(found.fastest_mps, std::hypot(truth.vx_mps, truth.vy_mps));
      found.fastest_aside_mps = std::max(found.fastest_aside_mps, std::abs(truth.vy_mps));
    }
    found.rms_m = std::sqrt(square_m2 / ticks);
    const PathPoint& goal = path.points.back();
    found.final_m = std::hypot(plant.truth().x_m - goal.x_m, plant.truth().y_m - goal.y_m);
    std::printf(
        "%-12s cross-track rms %.1f, max %.1f cm, turned %.1f degrees, within 1.5 cm after %.2f m; "
        "goal %.1f cm\n",
        may_go_aside ? "sideways:" : "by turning:", 100 * found.rms_m, 100 * found.max_m,
        to_deg(found.turned_rad), found.back_after_m, 100 * found.final_m);
    return found;
  }
  void be_exact() { setup.plant.position_noise_m = setup.plant.yaw_noise_rad = 0; }

  DriveSetup setup;
  bool tracker_looks_back = false;  ///< it drives backwards along x
};

Path straight(double length_m) {
  Pen pen;
  return record(pen.line(length_m).points());
}

void expect_equal(const std::vector<Twist>& a, const std::vector<Twist>& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    ASSERT_EQ(a[i].vx_mps, b[i].vx_mps) << i;
    ASSERT_EQ(a[i].wz_radps, b[i].wz_radps) << i;
    ASSERT_EQ(a[i].vy_mps, b[i].vy_mps) << i;
  }
}

TEST_F(ATrackerOnRollers, GoesOutASmallOffsetAndKeepsItsHeading) {
  be_exact();
  const Path path = straight(8);
  for (const double side_m : {0.05, -0.05}) {
    setup.y_m = side_m;
    const Aside turning = go(path, false);
    const Aside aside = go(path, true);
    EXPECT_TRUE(aside.arrived);
    EXPECT_LT(aside.turned_rad, to_rad(2)) << side_m;
    EXPECT_GT(turning.turned_rad, to_rad(3)) << "this says something";
    EXPECT_LT(aside.back_after_m, turning.back_after_m);
    EXPECT_LT(aside.rms_m, turning.rms_m);
    EXPECT_LT(aside.max_m, 0.051) << "it does not swing over";
    EXPECT_LT(aside.final_m, 0.03);
  }
}

TEST_F(ATrackerOnRollers, GoesBackSoWhileItDrivesBackwards) {
  be_exact();
  const Path path = test::with_gears(straight(6), true);
  tracker_looks_back = true;
  setup.yaw_rad = kPi;
  for (const double side_m : {0.05, -0.05}) {
    setup.y_m = side_m;
    const Aside aside = go(path, true);
    EXPECT_TRUE(aside.arrived);
    EXPECT_LT(aside.turned_rad, to_rad(2)) << side_m;
    EXPECT_LT(aside.max_m, 0.051);
    EXPECT_LT(aside.back_after_m, 1);
    EXPECT_GT(aside.fastest_aside_mps, 0.03);
  }
}

TEST_F(ATrackerOnRollers, GoesAsideByNoMoreThanAShareOfItsSpeed) {
  be_exact();
  const Path path = straight(8);
  setup.y_m = 0.12;
  for (const double speed_mps : {0.2, 0.8}) {
    setup.speed_mps = speed_mps;
    const Aside aside = go(path, true);
    EXPECT_TRUE(aside.arrived);
    EXPECT_LT(aside.fastest_aside_mps, 0.3 * speed_mps + 0.005);
    EXPECT_LT(aside.fastest_aside_mps, 0.151);
    EXPECT_LT(aside.fastest_mps, speed_mps + 0.005) << "aslant as fast as ahead";
    EXPECT_LT(aside.fastest_rim_mps, std::sqrt(2) * speed_mps + 0.37 * 0.8);
  }
}

TEST_F(ATrackerOnRollers, TurnsOutAnOffsetThatIsLarge) {
  be_exact();
  const Path path = straight(15);
  for (const double side_m : {2.0, -2.0}) {
    setup.y_m = side_m;
    const Aside turning = go(path, false);
    const Aside aside = go(path, true);
    EXPECT_TRUE(aside.arrived);
    EXPECT_LT(aside.back_after_m, turning.back_after_m + 0.2);
    EXPECT_LT(aside.final_m, 0.04);
  }
}

TEST_F(ATrackerOnRollers, HoldsBendsAsWellAsByTurning) {
  for (unsigned seed = 1; seed <= 3; ++seed) {
    for (const double speed_mps : {0.5, 0.8}) {
      setup.plant.seed = seed;
      setup.speed_mps = speed_mps;
      const Path path = record(rows(), 0.5, 0.01, seed);
      const Aside turning = go(path, false);
      const Aside aside = go(path, true);
      EXPECT_TRUE(aside.arrived);
      EXPECT_LT(aside.rms_m, turning.rms_m + 0.001);
      EXPECT_LT(aside.max_m, turning.max_m + 0.005);
      EXPECT_LT(aside.final_m, 0.05);
    }
  }
}

TEST_F(ATrackerOnRollers, DrivesAsOthersDoWhereItMayNot) {
  setup.y_m = 0.05;
  const Aside may_not = go(straight(8), false);
  for (const Twist& twist : may_not.told) ASSERT_EQ(twist.vy_mps, 0);
}

TEST(TrackerOfABaseWithoutRollers, DoesNotAskWhetherItMayGoAside) {
  const Path path = straight(8);
  std::vector<Twist> told[2];
  for (const bool may : {false, true}) {
    test::Plant2d plant({}, {}, 0, 0.05, 0);
    Tracker tracker(NavigateConfig{}, LimitsConfig{});
    tracker.begin(path, static_cast<std::uint32_t>(path.points.size() - 1), 0.5, plant.estimate());
    const engine::BaseConfig base;
    for (int i = 0; i < 2000; ++i) {
      const Pose pose = plant.estimate();
      const TrackProgress progress = tracker.locate(pose);
      const Twist twist = tracker.follow(pose, progress, 10, kTick, may);
      told[may ? 1 : 0].push_back(twist);
      plant.step(wheels_from_twist(sides_of(base), 1.0, twist, 1.5), kTick_s);
    }
  }
  expect_equal(told[0], told[1]);
}

}  // namespace
}  // namespace drover::engine
