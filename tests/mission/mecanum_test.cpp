// Four mecanum wheels: a task, a way to the side, and what stops them.
#include "mission/support.h"
#include "mission/wire_robomaster.h"

namespace drover::mission {
namespace {

TEST(Mecanum, IsDrivenToSuccessCloseToTheTrack) {
  const Record& log = record("mecanum");
  EXPECT_EQ(log.feedback_words(), kStarted);
  expect_nav_stays(log, "NAV_RUN", log.answered("start_nav_success"),
                   log.first_status("NAV_SUCCESS").time - 1ms);
  expect_good_drive(log);
}

/// How it went while a stream of joint commands moved it, along its own axes at the beginning.
struct Aside {
  double ahead_m = 0;
  double left_m = 0;
  double turned_deg = 0;  ///< at the most
  double told_mps = 0;    ///< robot.vy, the median of the middle
  double true_mps = 0;    ///< of the same time
};

Aside aside(const Record& log, const char* step) {
  const Time begin = log.event(std::string("event ") + step + "#1");
  const Time end = begin + 6s;
  const auto from = log.truth_at(begin);
  const auto to = log.truth_at(end);
  const double c = std::cos(from.yaw_rad);
  const double s = std::sin(from.yaw_rad);
  Aside found;
  found.ahead_m = (to.x_m - from.x_m) * c + (to.y_m - from.y_m) * s;
  found.left_m = (to.y_m - from.y_m) * c - (to.x_m - from.x_m) * s;
  for (const auto& line : log.truth)
    if (line.time > begin && line.time < end)
      found.turned_deg =
          std::max(found.turned_deg,
                   std::abs(std::remainder(line.yaw_rad - from.yaw_rad, 2 * M_PI)) * 180 / M_PI);
  std::vector<double> told;
  for (const Status& status : log.statuses)
    if (status.time > begin + 2s && status.time < begin + 4s)
      told.push_back(status.document.at("robot").at("vy").get<double>());
  std::sort(told.begin(), told.end());
  if (!told.empty()) found.told_mps = told[told.size() / 2];
  const auto early = log.truth_at(begin + 2s);
  const auto late = log.truth_at(begin + 4s);
  found.true_mps = ((late.y_m - early.y_m) * c - (late.x_m - early.x_m) * s) / 2;
  figure("to the left", found.left_m, "m");
  figure("ahead", found.ahead_m, "m");
  figure("turned", found.turned_deg, "degrees");
  figure("robot.vy", found.told_mps, "m/s");
  return found;
}

// 4.4 s at 3.5 rad/s (0.27 m/s), less the ramps.
TEST(MecanumSideways, GoesToTheLeftAndToTheRight) {
  const Record& log = record("mecanum_sideways");
  const Aside left = aside(log, "left");
  const Aside right = aside(log, "right");
  EXPECT_NEAR(left.left_m, 1.15, 0.115);
  EXPECT_NEAR(right.left_m, -1.15, 0.115);
  for (const Aside& way : {left, right}) {
    EXPECT_NEAR(way.ahead_m, 0, 0.05);
    EXPECT_LT(way.turned_deg, 3);
    EXPECT_NEAR(way.told_mps, way.true_mps, 0.1 * std::abs(way.true_mps));
  }
}

TEST(MecanumSideways, GoesAslant) {
  const Aside way = aside(record("mecanum_sideways"), "aslant");
  EXPECT_GT(way.left_m, 0.4);
  EXPECT_NEAR(way.ahead_m / way.left_m, 3.25 / 1.75, 0.2);
  EXPECT_LT(way.turned_deg, 3);
}

// Not among those of which nothing may be told to move after a task: the wheels rest one by one,
// and each is pulled back to where it did by more than these wheels' friction, by a millimetre or
// two.
TEST(MecanumSilent, OfOneMotorStopsTheRobot) {
  const Record& log = record("mecanum_silent");
  const Time silenced = log.event("event silenced#1");
  ASSERT_TRUE(moved_until(log, silenced));
  tell_way_to_rest(log, silenced, log.truth.back().time - 10ms);
  const Roll rolled = roll(log, silenced, log.truth.back().time - 10ms);
  EXPECT_LT(rolled.way_m, 0.6);
  EXPECT_LT(rolled.rest - silenced, 2000ms);
  const auto& error = log.first_status("NAV_ERROR", silenced);
  EXPECT_LT(error.time - silenced, 400ms);
  EXPECT_THAT(error.why, testing::HasSubstr("motor 3 (203) is silent"));
}

}  // namespace
}  // namespace drover::mission
