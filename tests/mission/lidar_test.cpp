// Missions in which nobody tells of what is in the way: the lidar alone sees it, or does not see.
#include "drover/angle.h"
#include "mission/flat.h"
#include "mission/robot.h"
#include "mission/support.h"

namespace drover::mission {
namespace {

/// Of the world's box.
constexpr double kHalfBox_m = 0.25;

bool laser(const Status& status) {
  return status.document.at("sensor").at("laser").get<bool>();
}
bool obstacle(const Status& status) {
  return status.document.at("nav").at("obstacle").get<bool>();
}

template <typename Is>
const Status* first(const Record& log, Time begin, const Is& is) {
  for (const auto& status : log.statuses)
    if (status.time >= begin && is(status)) return &status;
  return nullptr;
}

void expect_success_without_another_start(const Record& log) {
  EXPECT_EQ(log.feedback_words(), kStarted);
  EXPECT_EQ(log.statuses.back().nav, "NAV_SUCCESS");
}

void expect_well_all_the_time(const Record& log) {
  const Time begin = log.answered("start_nav_success");
  EXPECT_EQ(first(log, begin, [](const Status& s) { return !laser(s); }), nullptr);
}

TEST(LidarBox, IsWellInAHall) {
  expect_well_all_the_time(record("lidar_box"));
}

TEST(LidarRamp, IsWellInAHall) {
  expect_well_all_the_time(record("lidar_ramp"));
}

TEST(LidarBox, IsStoppedForThoughNobodyTellsOfItAndDrivenOnWhenItIsGone) {
  const Record& log = record("lidar_box");
  const Time comes = log.event("sim obstacle obstacle 1 1");
  const Time goes = log.event("sim obstacle obstacle remove");
  const auto* told = first(log, comes, obstacle);
  ASSERT_NE(told, nullptr);
  ASSERT_LT(told->time, goes);
  EXPECT_NE(told->why.find("lidar"), std::string::npos) << told->why;
  EXPECT_EQ(told->nav, "NAV_RUN");
  tell_way_to_rest(log, comes, goes);
  EXPECT_LT(roll(log, comes, goes).rest, goes - 3s);
  const double left_m = 1 - kHalfBox_m - RobotShape{}.front_m - log.truth_at(goes).x_m;
  figure("left before the box", left_m, "m");
  EXPECT_GT(left_m, 0.05);
  EXPECT_LT(left_m, kFarFrom_m);
  EXPECT_FALSE(log.moving(goes + 1s, goes + 4s).empty()) << "it did not go on by itself";
  expect_success_without_another_start(log);
}

/// The least that was between the robot and the box of the world, by its true poses.
double least_gap_m(const Record& log, double x_m, double y_m, Time begin, Time end) {
  const Flat box{{{x_m - kHalfBox_m, y_m - kHalfBox_m},
                  {x_m + kHalfBox_m, y_m - kHalfBox_m},
                  {x_m + kHalfBox_m, y_m + kHalfBox_m},
                  {x_m - kHalfBox_m, y_m + kHalfBox_m}},
                 0};
  double least_m = std::numeric_limits<double>::infinity();
  for (const auto& line : log.truth)
    if (line.time >= begin && line.time <= end)
      least_m = std::min(least_m, gap_m(outline(line.x_m, line.y_m, line.yaw_rad), box));
  return least_m;
}

/// From when it is told to when it is over it stands, says what hinders its turn, and waits.
void expect_waits_in_its_turn(const Record& log, Time begin, Time over, const char* who) {
  const auto* told = first(log, begin, obstacle);
  ASSERT_NE(told, nullptr) << "it was never told";
  ASSERT_LT(told->time, over - 4s);
  std::printf("  %s\n", told->why.c_str());
  EXPECT_NE(told->why.find(who), std::string::npos) << told->why;
  const auto at = log.truth_at(over);
  figure("before the corner", -2 - at.x_m, "m");
  EXPECT_NEAR(at.x_m, -2, 0.1) << "it did not get to its corner";
  figure("turned", to_deg(at.yaw_rad), "deg");
  EXPECT_LT(at.yaw_rad, to_rad(45));
  EXPECT_THAT(log.moving(told->time + 2s, over), testing::IsEmpty());
  for (const auto& status : log.statuses) {
    if (status.time < told->time + 1s || status.time > over) continue;
    EXPECT_TRUE(obstacle(status)) << seconds(status.time);
    EXPECT_EQ(status.nav, "NAV_RUN") << seconds(status.time);
    EXPECT_NE(status.why.find("turn to the left"), std::string::npos) << status.why;
  }
}

TEST(LidarPivot, TurnsNotIntoABoxThatItSees) {
  const Record& log = record("lidar_pivot");
  const Time begin = log.answered("start_nav_success");
  const Time goes = log.event("sim obstacle obstacle remove");
  const double least_m = least_gap_m(log, -2, -1.75, begin, goes);
  figure("nearest", least_m, "m");
  EXPECT_GT(least_m, 0.05);
  expect_waits_in_its_turn(log, begin, goes, "lidar sees something");
  EXPECT_FALSE(log.moving(goes + 1s, goes + 4s).empty()) << "it did not go on by itself";
  expect_success_without_another_start(log);
}

TEST(LidarPivotHidden, TurnsNotIntoABoxThatItSawWhenItCame) {
  const Record& log = record("lidar_pivot_hidden");
  const Time begin = log.answered("start_nav_success");
  const Time over = log.truth.back().time - 500ms;
  const double least_m = least_gap_m(log, -2.2, -1.75, begin, over);
  figure("nearest", least_m, "m");
  EXPECT_GT(least_m, 0.05);
  expect_waits_in_its_turn(log, begin, over, "lidar saw something");
}

struct Fault {
  const char* mission;
  const char* command;
  const char* why;
  Duration noticed;  ///< by the driver, at most
};

class ALidarThatDoesNotSee : public testing::TestWithParam<Fault> {};

TEST_P(ALidarThatDoesNotSee, StopsTheRobotWhichSaysWhyAndDrivesOnWhenItSeesAgain) {
  const Fault& fault = GetParam();
  const Record& log = record(fault.mission);
  const Time begin = log.event(fault.command);
  const Time over = log.event("sim lidar normal");
  ASSERT_TRUE(moved_until(log, begin));
  tell_way_to_rest(log, begin, over);
  // The age of the last good turn, and a ramp from 0.5 m/s at 0.8 m/s^2 with its jerk.
  EXPECT_LT(roll(log, begin, over).rest - begin, fault.noticed + 300ms + 1200ms);
  const auto* told = first(log, begin, [](const Status& s) { return !laser(s); });
  ASSERT_NE(told, nullptr);
  EXPECT_LT(told->time - begin, fault.noticed + 600ms);
  for (const auto& status : log.statuses) {
    if (status.time < begin || status.time > over) continue;
    const bool only_a_part = status.why.find("one at") != std::string::npos;
    if (status.why.find(fault.why) != std::string::npos && !only_a_part) {
      EXPECT_FALSE(laser(status)) << seconds(status.time) << " " << status.why;
    }
  }
  const auto* late = first(log, over - 1s, [](const Status&) { return true; });
  ASSERT_NE(late, nullptr);
  EXPECT_NE(late->why.find("lidar: "), std::string::npos) << late->why;
  EXPECT_NE(late->why.find(fault.why), std::string::npos) << late->why;
  EXPECT_EQ(late->nav, "NAV_RUN");
  EXPECT_FALSE(laser(*late));
  // What was not known has to be for a second, and a line is tried again after two.
  EXPECT_FALSE(log.moving(over, over + 6s).empty()) << "it did not go on by itself";
  EXPECT_TRUE(laser(log.statuses.back()));
  expect_success_without_another_start(log);
}

INSTANTIATE_TEST_SUITE_P(
    Each, ALidarThatDoesNotSee,
    testing::Values(Fault{"lidar_covered", "sim lidar covered", "its lens is covered", 200ms},
                    Fault{"lidar_sun", "sim lidar sun", "is blind in", 500ms},
                    Fault{"lidar_frozen", "sim lidar frozen", "the same turn over and over", 800ms},
                    Fault{"lidar_unplugged", "sim lidar unplugged", "/lidar", 100ms}),
    [](const auto& each) { return std::string(each.param.mission); });

/// With its beams at 0.35 m the ramp is met 2.33 m beyond its foot, or farther while it climbs.
TEST(LidarRamp, Of15PercentIsDrivenUpWithoutANeedlessStop) {
  const Record& log = record("lidar_ramp");
  const Time begin = log.answered("start_nav_success");
  const auto& success = log.first_status("NAV_SUCCESS", begin);
  EXPECT_EQ(first(log, begin, obstacle), nullptr);
  EXPECT_GT(log.truth_at(success.time).z_m, 0.4);
  expect_success_without_another_start(log);
}

}  // namespace
}  // namespace drover::mission
