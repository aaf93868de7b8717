// A simulated scanner: what its rays meet, and what a driver makes of its bytes.
#include "sim/robot/scanner.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <vector>

#include "drover/angle.h"
#include "sim/robot/robot.h"
#include "support/temp_folder.h"

namespace drover::sim {
namespace {

using namespace std::chrono_literals;

/// A hall of 16 m by 12 m with a thing to be moved, and a base that has the scanner's place in the
/// middle of its own hull.
constexpr auto kHall = R"(<mujoco>
  <compiler angle="radian" inertiafromgeom="true"/>
  <option timestep="0.0025"/>
  <default><geom contype="0" conaffinity="0" group="1"/></default>
  <worldbody>
    <geom type="plane" size="50 50 1" contype="1" conaffinity="1" group="0"/>
    <geom type="box" size="0.1 6 1" pos="8 0 1"/>
    <geom type="box" size="0.1 6 1" pos="-8 0 1"/>
    <geom type="box" size="8 0.1 1" pos="0 6 1"/>
    <geom type="box" size="8 0.1 1" pos="0 -6 1"/>
    <body mocap="true" name="thing" pos="0 0 -20">
      <geom type="box" size="0.2 0.2 0.5" pos="0 0 0.5" contype="2" conaffinity="2"/>
    </body>
    <body name="base" pos="0 0 0.12">
      <freejoint name="base"/>
      <geom type="box" size="0.4 0.3 0.2" pos="0 0 0.2" mass="30"/>
      <body name="left" pos="0 0.32 0">
        <joint name="left" type="hinge" axis="0 1 0" armature="0.02" damping="1"/>
        <geom type="cylinder" size="0.12 0.02" euler="1.5707963267948966 0 0" mass="1.5"/>
        <geom type="sphere" size="0.12" contype="1" conaffinity="1" condim="1" mass="0.01"/>
      </body>
      <body name="right" pos="0 -0.32 0">
        <joint name="right" type="hinge" axis="0 1 0" armature="0.02" damping="1"/>
        <geom type="cylinder" size="0.12 0.02" euler="1.5707963267948966 0 0" mass="1.5"/>
        <geom type="sphere" size="0.12" contype="1" conaffinity="1" condim="1" mass="0.01"/>
      </body>
      <geom type="sphere" size="0.04" pos="-0.38 0 -0.08" contype="1" conaffinity="1" condim="1"
            mass="0.01"/>
      <geom type="sphere" size="0.04" pos="0.38 0 -0.08" contype="1" conaffinity="1" condim="1"
            mass="0.01"/>
    </body>
  </worldbody>
  <actuator><motor name="left" joint="left"/><motor name="right" joint="right"/></actuator>
</mujoco>)";

class AScannerInAHall : public testing::Test {
 protected:
  AScannerInAHall() {
    scenario_.world = folder_.path() + "/hall.xml";
    std::ofstream(scenario_.world) << kHall;
    scenario_.lidar.emplace();
    auto& lidar = *scenario_.lidar;
    lidar.driver = find_driver("ld06");
    lidar.options = Options(lidar.driver->options)
                        .set("mount_x_m", 0.0)
                        .set("mount_y_m", 0.0)
                        .set("mount_z_m", 0.2)
                        .set("mount_yaw_deg", 0.0);
    lidar.x_m = 0.3;
    lidar.z_m = 0.13;  // a quarter of a metre above the ground
  }

  /// Decodes what the scanner says in this time.
  void listen(Robot& robot, Duration time) {
    if (!made_.device) made_ = find_driver("ld06")->make(scenario_.lidar->options, {});
    for (const Time end = now_ + time; now_ < end; now_ += kTick) {
      robot.step(now_);
      const auto said = robot.lidar_bytes();
      bytes_ += said.size();
      ScanOut out;
      made_.scans->on_bytes({reinterpret_cast<const std::uint8_t*>(said.data()), said.size()}, now_,
                            out);
      for (const Scan& scan : out.scans) scan_ = scan;
    }
  }
  Robot make() { return {scenario_, make_twins(scenario_, 1)}; }
  double range_m(double bearing_deg) const {
    double best_rad = 1;
    double range_m = -1;
    for (const ScanPoint& point : scan_.points) {
      const double off_rad = std::abs(wrap_rad(point.bearing_rad - to_rad(bearing_deg)));
      if (off_rad >= best_rad) continue;
      best_rad = off_rad;
      range_m = point.range_m;
    }
    return range_m;
  }
  SourceHealth health() const { return made_.device->health(now_); }

  test::TempFolder folder_;
  Scenario scenario_;
  Made made_;
  Scan scan_;
  Time now_{100s};
  std::size_t bytes_ = 0;
};

TEST_F(AScannerInAHall, SeesTheWallsAtItsPaceAndNotTheRobotAroundIt) {
  Robot robot = make();
  listen(robot, 2s);
  EXPECT_NEAR(static_cast<double>(bytes_), 2 * 375 * 47, 100);
  EXPECT_EQ(health().state, SourceState::fresh) << health().reason.view();
  EXPECT_EQ(health().reason, "");
  ASSERT_EQ(scan_.points.size(), 450U);
  EXPECT_NEAR(range_m(0), 7.6, 0.05);
  EXPECT_NEAR(range_m(90), 5.9, 0.05);
  EXPECT_NEAR(range_m(-90), 5.9, 0.05);
  EXPECT_NEAR(range_m(179.9), 8.2, 0.05);
}

TEST_F(AScannerInAHall, SeesAThingThatIsPutBeforeItAndTakenAway) {
  Robot robot = make();
  listen(robot, 300ms);
  ASSERT_EQ(robot.command("obstacle thing 2 0.5"), "ok");
  listen(robot, 300ms);
  const double bearing_deg = to_deg(std::atan2(0.5, 1.7));
  EXPECT_NEAR(range_m(bearing_deg), std::hypot(0.5, 1.7) - 0.2 * std::hypot(0.5, 1.7) / 1.7, 0.06);
  ASSERT_EQ(robot.command("obstacle thing remove"), "ok");
  listen(robot, 300ms);
  EXPECT_GT(range_m(bearing_deg), 6);
}

TEST_F(AScannerInAHall, HasItsPlaceAndItsYaw) {
  scenario_.lidar->yaw_deg = 90;
  scenario_.lidar->y_m = -0.5;
  Robot robot = make();
  listen(robot, 500ms);
  EXPECT_NEAR(range_m(0), 6.4, 0.05);
  EXPECT_NEAR(range_m(-90), 7.6, 0.05);
}

TEST_F(AScannerInAHall, ReachesSoFarAndNoFarther) {
  scenario_.lidar->reach_m = 7;
  Robot robot = make();
  listen(robot, 500ms);
  EXPECT_EQ(range_m(0), 0);
  EXPECT_NEAR(range_m(90), 5.9, 0.05);
}

TEST_F(AScannerInAHall, HasTheStatesOfItsTwin) {
  Robot robot = make();
  listen(robot, 2s);
  for (const auto& [state, why] : {std::pair{"covered", "lens is covered"},
                                   {"sun", "blind in"},
                                   {"frozen", "same turn over and over"},
                                   {"silent", "silent"}}) {
    ASSERT_EQ(robot.command(std::string("lidar ") + state), "ok");
    listen(robot, 2s);
    EXPECT_EQ(health().state, SourceState::stale) << state;
    EXPECT_THAT(std::string(health().reason.view()), testing::HasSubstr(why));
    ASSERT_EQ(robot.command("lidar normal"), "ok");
    listen(robot, 2s);
    EXPECT_EQ(health().state, SourceState::fresh) << state << ": " << health().reason.view();
  }
  ASSERT_EQ(robot.command("lidar dirty"), "ok");
  listen(robot, 2s);
  EXPECT_THAT(std::string(health().reason.view()), testing::HasSubstr("dirt on its lens"));
  EXPECT_EQ(robot.command("lidar muddy"), "error: no state 'muddy' of a lidar");
  EXPECT_EQ(robot.command("lidar"), "error: no state '' of a lidar");
}

TEST_F(AScannerInAHall, SaysTheSameFromTheSameSeed) {
  std::string said[2];
  for (auto& text : said) {
    Robot robot = make();
    for (Time now{100s}; now < Time{101s}; now += kTick) {
      robot.step(now);
      text += robot.lidar_bytes();
    }
  }
  EXPECT_FALSE(said[0].empty());
  EXPECT_EQ(said[0], said[1]);
}

TEST(Rays, MeetAThingBehindTheRobotsOwnWheel) {
  test::TempFolder folder;
  std::ofstream(folder.path() + "/hall.xml") << kHall;
  Plant plant(folder.path() + "/hall.xml");
  plant.step();
  // From the middle through the left wheel to the wall.
  const auto left_m = plant.ray_m({0, 0, 0}, {0, 1, 0}, 12);
  ASSERT_TRUE(left_m.has_value());
  EXPECT_NEAR(*left_m, 5.9, 0.02);
  EXPECT_NEAR(plant.ray_m({0, 0, 0.1}, {1, 0, -0.1}, 12).value_or(0), std::hypot(2.2, 0.22), 0.05)
      << "the ground";
  EXPECT_FALSE(plant.ray_m({0, 0, 0}, {0, 1, 0}, 5).has_value());
  EXPECT_FALSE(plant.ray_m({0, 0, 0.1}, {0, 0, 0}, 12).has_value()) << "no direction";
}

}  // namespace
}  // namespace drover::sim
