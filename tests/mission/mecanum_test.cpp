// Four mecanum wheels: a task, a way to the side, and what stops them.

#include "mission/scene_support.h"
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

/// How it came to rest while it went to the side: by its places, 50 ms apart.
struct AsideToRest {
  Duration time{};
  double left_m = 0;
  double ahead_m = 0;
  double turned_deg = 0;
};

AsideToRest aside_to_rest(const Record& log, Time begin, Time end) {
  const auto from = log.truth_at(begin);
  const auto to = log.truth_at(end);
  AsideToRest found;
  const double x_m = to.x_m - from.x_m;
  const double y_m = to.y_m - from.y_m;
  found.left_m = y_m * std::cos(from.yaw_rad) - x_m * std::sin(from.yaw_rad);
  found.ahead_m = x_m * std::cos(from.yaw_rad) + y_m * std::sin(from.yaw_rad);
  found.turned_deg = std::remainder(to.yaw_rad - from.yaw_rad, 2 * M_PI) * 180 / M_PI;
  for (std::size_t i = 1; i < log.truth.size(); ++i) {
    const auto& line = log.truth[i];
    const auto& before = log.truth[i - 1];
    const double way_m = std::hypot(line.x_m - before.x_m, line.y_m - before.y_m);
    const bool moves =
        way_m > 0.01 * std::chrono::duration<double>(line.time - before.time).count();
    if (moves && line.time > begin && line.time <= end) found.time = line.time - begin;
  }
  figure("time to rest", found.time);
  figure("to the left", found.left_m, "m");
  figure("ahead", found.ahead_m, "m");
  figure("turned", found.turned_deg, "degrees");
  return found;
}

TEST(MecanumSidewaysSilent, OfOneMotorStopsTheRobot) {
  const Record& log = record("mecanum_sideways_silent");
  const Time silenced = log.event("event silenced#1");
  ASSERT_TRUE(moved_until(log, silenced));
  const AsideToRest rest = aside_to_rest(log, silenced, log.truth.back().time - 10ms);
  // It is missed for 0.1 s; then three brake, from 0.27 m/s.
  EXPECT_LT(rest.time, 1s);
  EXPECT_LT(rest.left_m, 0.15);
  EXPECT_NEAR(rest.ahead_m, 0, 0.05);
  EXPECT_LT(std::abs(rest.turned_deg), 10);
}

// The stream goes on for seconds.
TEST(MecanumSidewaysSilent, IsToldInWordsAndTheStreamMovesItNoMore) {
  const Record& log = record("mecanum_sideways_silent");
  const Time silenced = log.event("event silenced#1");
  const auto told =
      std::find_if(log.statuses.begin(), log.statuses.end(), [silenced](const Status& status) {
        return status.time > silenced && status.why.find("is silent") != std::string::npos;
      });
  ASSERT_NE(told, log.statuses.end());
  figure("told after", told->time - silenced);
  EXPECT_LT(told->time - silenced, 400ms);
  EXPECT_THAT(told->why, testing::HasSubstr("wheel rear_left: motor 3 (203) is silent"));
  EXPECT_EQ(told->nav, "NAV_FREE") << "no task failed";
  EXPECT_GT(log.event("event commands_end#2") - silenced, 2s);
  const auto later = log.truth_at(silenced + 1s);
  const auto& last = log.truth.back();
  EXPECT_LT(std::hypot(last.x_m - later.x_m, last.y_m - later.y_m), 0.01);
}

TEST(MecanumSidewaysKill, LetsItCoastToTheSideWithoutATurn) {
  const Record& log = record("mecanum_sideways_kill");
  const Time killed = log.event("signal 9 to droverd");
  const AsideToRest rest = aside_to_rest(log, killed, log.event("start droverd", 2));
  // The rollers' bearings brake what goes aside: less far than ahead.
  EXPECT_LT(rest.time, 1s);
  EXPECT_LT(rest.left_m, 0.2);
  EXPECT_NEAR(rest.ahead_m, 0, 0.05);
  EXPECT_LT(std::abs(rest.turned_deg), 5);
}

TEST(SceneAside, StopsJointCommandsBeforeABoxAndLetsThemLeave) {
  const SceneLog& scene = scene_log("scene_aside");
  const Record& log = *scene.record;
  const Time left = log.event("event left#1");
  const Time over = log.event("event commands_end#2");
  const double stands_m = scene.pose_at(over).y_m;
  EXPECT_GT(stands_m, scene.pose_at(left).y_m + 0.5) << "it did not go aside";
  const double gap_m = scene.gap_at(over, "crate");
  figure("stands before it", gap_m, "m");
  EXPECT_GT(gap_m, 0);
  EXPECT_LE(gap_m, kFarFrom_m);
  EXPECT_THAT(log.moving(over - 1s, over), testing::IsEmpty());
  const std::string journal = said(log, "droverd.log");
  EXPECT_THAT(journal, testing::HasSubstr("joint commands ended: crate is in the way"));
  EXPECT_THAT(journal, testing::HasSubstr("to the left"));
  const double away_m = scene.pose_at(log.event("event commands_end#4")).y_m;
  figure("leaves it by", stands_m - away_m, "m");
  EXPECT_LT(away_m, stands_m - 0.5);
}

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
  EXPECT_THAT(error.why, testing::HasSubstr("wheel rear_left: motor 3 (203) is silent"));
}

/// What brakes are the two others, on one diagonal: their rollers let it roll along the other.
TEST(MecanumTornStuck, StopsAndSaysWhatIsStuck) {
  const Record& log = record("mecanum_torn_stuck");
  const Time broken = log.event("event broken#1");
  ASSERT_TRUE(moved_until(log, broken));
  const auto& error = log.first_status("NAV_ERROR", broken);
  figure("told after", error.time - broken);
  EXPECT_LT(error.time - broken, 600ms);
  EXPECT_THAT(
      error.why,
      testing::HasSubstr("wheel front_right: motor 2 (202) tells the same angle however hard it"));
  const Time again = log.event("event again#1");
  tell_way_to_rest(log, broken, again);
  const Roll rolled = roll(log, broken, again);
  EXPECT_LT(rolled.way_m, 0.9);
  EXPECT_LT(rolled.rest - broken, 2600ms);
  EXPECT_LT(rolled.fastest_mps, 0.88) << "of 0.6";
}

/// It did not stop as it should.
TEST(MecanumTornStuck, IsNotMovedBeforeAPersonResetsTheStop) {
  const Record& log = record("mecanum_torn_stuck");
  const Time again = log.event("event again#1");
  const Time once_more = log.event("event once_more#1");
  EXPECT_LT(roll(log, again, once_more).way_m, 0.005);
  EXPECT_THAT(log.moving(again, once_more), testing::IsEmpty());
  EXPECT_GT(log.answered("start_task_failse"), again);
}

/// Both are still broken.
TEST(MecanumTornStuck, EndsTheNextStartWhereItBegan) {
  const Record& log = record("mecanum_torn_stuck");
  const Time once_more = log.event("event once_more#1");
  EXPECT_GT(log.answered("start_task_success", 2), once_more);
  const Roll rolled = roll(log, once_more, log.truth.back().time - 10ms);
  figure("way of the new start", rolled.way_m, "m");
  EXPECT_LT(rolled.way_m, 0.2);
  EXPECT_LT(rolled.rest - once_more, 1500ms);
  EXPECT_EQ(log.statuses.back().nav, "NAV_ERROR");
}

/// The first correction aside goes away from the track.
TEST(MecanumRows, ThatAreSwappedEndTheTaskInWordsThatNameThem) {
  const Record& log = record("mecanum_rows");
  const Time begin = log.answered("start_nav_success");
  const auto& error = log.first_status("NAV_ERROR", begin);
  const auto figures = drive_figures(log, begin, error.time);
  figure("ended after", error.time - begin);
  figure("way", figures.distance_m, "m");
  figure("farthest beside the track", figures.max_m, "m");
  EXPECT_THAT(error.why, testing::ContainsRegex(
                             "it goes to the (left|right) where its wheels say (left|right): is "
                             "the front wheel first in groups.base.left/right"));
  EXPECT_LT(figures.max_m, 0.2);
  EXPECT_EQ(log.statuses.back().nav, "NAV_ERROR");
  EXPECT_THAT(log.moving(error.time + 3s, log.truth.back().time - 10ms), testing::IsEmpty());
}

}  // namespace
}  // namespace drover::mission
