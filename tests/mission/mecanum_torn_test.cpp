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

void expect_told_and_stopped(const Way& way, const char* wheel, double most_m, double most_deg) {
  expect_told(way, wheel);
  expect_stopped(way, most_m, most_deg);
}

TEST(MecanumSidewaysTorn, IsToldAndStopsTheRobotOnItsWayToTheLeft) {
  expect_told_and_stopped(way("mecanum_sideways_torn", "torn_left", "2"),
                          "rear_left: motor 3 (203)", 0.2, 5);
}

/// Repaired and reset, slowly.
TEST(MecanumSidewaysTorn, IsToldAndStopsTheRobotOnItsWayToTheRight) {
  expect_told_and_stopped(way("mecanum_sideways_torn", "torn_right", "4"),
                          "front_right: motor 2 (202)", 0.06, 5);
}

TEST(MecanumTurnsTorn, IsToldAndStopsTheRobotOnTheSpot) {
  expect_told_and_stopped(way("mecanum_turns_torn", "torn_turning", "2"),
                          "rear_right: motor 4 (204)", 0.05, 15);
}

/// Aslant two wheels hardly turn: this is one of them.
TEST(MecanumTurnsTorn, IsToldAndStopsTheRobotAslant) {
  expect_told_and_stopped(way("mecanum_turns_torn", "torn_aslant", "4"),
                          "front_left: motor 1 (201)", 0.22, 5);
}

TEST(MecanumLoose, IsToldAndStopsTheRobot) {
  const Record& log = record("mecanum_loose");
  const Time loose = log.event("event loose#1");
  const auto& error = log.first_status("NAV_ERROR", loose);
  figure("told after", error.time - loose);
  const auto from = log.truth_at(loose);
  const auto to = log.truth_at(error.time);
  const double way_m = std::hypot(to.x_m - from.x_m, to.y_m - from.y_m);
  figure("way", way_m, "m");
  EXPECT_LT(way_m, 2.5);
  EXPECT_LT(error.time - loose, 15s);
  EXPECT_THAT(error.why, testing::HasSubstr("wheel front_right: motor 2 (202) turns as if nothing "
                                            "hung on it, whatever the others carry"));
  EXPECT_THAT(log.moving(error.time + 1s, Time::max()), testing::IsEmpty());
}

/// How long a motor was asked for a current and told that it has none, at the longest.
Duration longest_without(const Record& log, std::uint32_t motor) {
  // 16384 are 20 A: half as much again as running friction, 0.35 A, and half of it.
  constexpr int kAsked = 430;
  constexpr int kNone = 143;
  const auto word = [](const CanFrame& frame, std::size_t at) {
    return static_cast<std::int16_t>(frame.data[at] * 256 + frame.data[at + 1]);
  };
  int asked = 0;
  Time since = kNever;
  Duration longest{};
  std::size_t had = 0;
  for (const CanLine& line : log.can) {
    if (line.frame.id == 0x200) asked = word(line.frame, 2 * (motor - 1));
    if (line.frame.id != 0x200 + motor) continue;
    const bool is_asked = std::abs(asked) >= kAsked;
    const bool has = std::abs(word(line.frame, 4)) > kNone;
    had += is_asked && has ? 1 : 0;
    if (!is_asked || has) since = kNever;
    if (is_asked && !has && since == kNever) since = line.time;
    if (since != kNever) longest = std::max(longest, line.time - since);
  }
  EXPECT_GT(had, 1000U) << "motor " << motor << " was hardly asked for anything";
  return longest;
}

/// 0.08 to 0.6 m/s to both sides, aslant, in bends and on the spot, from one way into the other.
TEST(MecanumEveryWay, IsAccusedOfNothing) {
  const Record& log = record("mecanum_every_way");
  const std::string journal = said(log, "droverd.log");
  EXPECT_THAT(journal, testing::Not(testing::HasSubstr("has no current")));
  const auto ended = journal.find("joint commands ended: ");
  ASSERT_NE(ended, std::string::npos);
  EXPECT_EQ(journal.rfind("joint commands ended: "), ended);
  EXPECT_EQ(journal.find("joint commands ended: the stream of joint commands fell silent"), ended);
  EXPECT_GE(log.event("event commands_end#19"), log.event("event back#1") + 2s) << "of all ways";
}

/// 0.3 s would be a fault.
TEST(MecanumEveryWay, IsFarFromBeingAccused) {
  const Record& log = record("mecanum_every_way");
  for (std::uint32_t motor = 1; motor <= 4; ++motor) {
    const Duration longest = longest_without(log, motor);
    figure("asked for a current and without it, at the longest", longest);
    EXPECT_LT(longest, 50ms) << "motor " << motor;
  }
}

}  // namespace
}  // namespace drover::mission
