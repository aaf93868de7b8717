// A line to one of four motors is torn while mecanum wheels carry the robot any way but ahead: the
// three others drag its wheel along, so that hardly anything is seen of it.

#include "mission/support.h"

namespace drover::mission {
namespace {

/// One way on which it is torn; the stream of commands goes on until it is `over`.
struct Way {
  const Record& log;
  Time torn;
  Time over;
};

Way way(const char* mission, const char* torn, const char* over) {
  const Record& log = record(mission);
  return {log, log.event(std::string("event ") + torn + "#1"),
          log.event(std::string("event commands_end#") + over)};
}

void expect_told(const Way& way, const char* wheel) {
  ASSERT_TRUE(moved_until(way.log, way.torn));
  const auto& all = way.log.statuses;
  const auto told = std::find_if(all.begin(), all.end(), [&way](const Status& status) {
    return status.time > way.torn && status.why.find("has no current") != std::string::npos;
  });
  ASSERT_NE(told, all.end());
  figure("told after", told->time - way.torn);
  EXPECT_LT(told->time - way.torn, 600ms);
  EXPECT_THAT(
      told->why,
      testing::HasSubstr(std::string("wheel ") + wheel +
                         " has no current however much it is asked for: is a line to it torn?"));
  EXPECT_EQ(told->nav, "NAV_FREE") << "no task failed";
}

void expect_stopped(const Way& way, double most_m, double most_deg) {
  const auto from = way.log.truth_at(way.torn);
  const Time end = way.over + 1s;
  Time rest = way.torn;
  double way_m = 0;
  double turned_deg = 0;
  for (std::size_t i = 1; i < way.log.truth.size(); ++i) {
    const auto& line = way.log.truth[i];
    const auto& before = way.log.truth[i - 1];
    if (before.time < way.torn || line.time > end) continue;
    way_m = std::max(way_m, std::hypot(line.x_m - from.x_m, line.y_m - from.y_m));
    const double turned_rad = std::abs(std::remainder(line.yaw_rad - from.yaw_rad, 2 * M_PI));
    turned_deg = std::max(turned_deg, turned_rad * 180 / M_PI);
    const double moved_m = std::hypot(line.x_m - before.x_m, line.y_m - before.y_m);
    const double moved_rad = std::remainder(line.yaw_rad - before.yaw_rad, 2 * M_PI);
    if (std::max(moved_m, std::abs(moved_rad)) > 0.01 * to_s(line.time - before.time))
      rest = line.time;
  }
  figure("time to rest", rest - way.torn);
  figure("way to rest", way_m, "m");
  figure("turned", turned_deg, "degrees");
  EXPECT_LT(rest - way.torn, 1500ms);
  EXPECT_LT(way_m, most_m);
  EXPECT_LT(turned_deg, most_deg);
  EXPECT_GT(way.over - way.torn, 2s) << "the stream did not go on";
  EXPECT_TRUE(way.log.changes("enable_relay", way.torn, end).empty()) << "its power was cut";
}

TEST(MecanumSidewaysTorn, IsToldAndStopsTheRobotOnItsWayToTheLeft) {
  const Way left = way("mecanum_sideways_torn", "torn_left", "2");
  expect_told(left, "rear_left: motor 3 (203)");
  expect_stopped(left, 0.2, 5);
}

/// Repaired and reset, slowly.
TEST(MecanumSidewaysTorn, IsToldAndStopsTheRobotOnItsWayToTheRight) {
  const Way right = way("mecanum_sideways_torn", "torn_right", "4");
  expect_told(right, "front_right: motor 2 (202)");
  expect_stopped(right, 0.06, 5);
}

TEST(MecanumTurnsTorn, IsToldAndStopsTheRobotOnTheSpot) {
  const Way turn = way("mecanum_turns_torn", "torn_turning", "2");
  expect_told(turn, "rear_right: motor 4 (204)");
  expect_stopped(turn, 0.05, 15);
}

/// Aslant two wheels hardly turn: this is one of them.
TEST(MecanumTurnsTorn, IsToldAndStopsTheRobotAslant) {
  const Way aslant = way("mecanum_turns_torn", "torn_aslant", "4");
  expect_told(aslant, "front_left: motor 1 (201)");
  expect_stopped(aslant, 0.22, 5);
}

}  // namespace
}  // namespace drover::mission
