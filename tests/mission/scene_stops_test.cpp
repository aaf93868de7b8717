// What comes into the way while the robot drives: it stops before it, says what it is, and goes on
// when that is gone.

#include "drover/angle.h"
#include "mission/scene_support.h"

namespace drover::mission {
namespace {

/// It came while the robot drove, and it stands before it until it is taken away.
void expect_stop_and_going_on(const char* mission, const char* name) {
  const SceneLog& scene = scene_log(mission);
  const Time appeared = scene.at("put", name);
  const Time gone = scene.at("gone", name);
  ASSERT_TRUE(moved_until(*scene.record, appeared)) << "it did not drive";
  figure("appears at a distance of", scene.gap_at(appeared, name), "m");
  ASSERT_GT(gone - appeared, 6s);
  expect_stands_before(scene, name, gone - 2s, gone - 100ms);
  expect_goes_on(scene, gone);
  EXPECT_TRUE(scene.answer(name, appeared).done);
  EXPECT_TRUE(scene.answer(name, gone).done);
}

TEST(SceneBox, StopsBeforeItAndGoesOn) {
  expect_stop_and_going_on("scene_box", "crate");
}

TEST(SceneBackwards, StopsBeforeItAndGoesOn) {
  expect_stop_and_going_on("scene_backwards", "crate");
}

TEST(SceneBackwards, StandsWithItsBackToTheBox) {
  const SceneLog& scene = scene_log("scene_backwards");
  const Time gone = scene.at("gone", "crate");
  EXPECT_GT(std::cos(scene.pose_at(gone).yaw_rad - to_rad(120)), 0.9) << "it turned round";
  const Time appeared = scene.at("put", "crate");
  EXPECT_GT(scene.pose_at(gone).x_m, scene.pose_at(appeared).x_m) << "it did not back up";
}

TEST(ScenePole, IsNotMissedBetweenTwoPosesOfTheSweep) {
  expect_stop_and_going_on("scene_pole", "pole");
}

TEST(ScenePlanes, StopsBeforeTheOneAcrossItsWay) {
  expect_stop_and_going_on("scene_planes", "quay");
}

TEST(ScenePlanes, IsNotHeldByTheGroundAndByTwoBesideIt) {
  const SceneLog& scene = scene_log("scene_planes");
  EXPECT_EQ(scene.record->feedback_words(), kStarted);
  for (const char* id : {"ground", "banks"}) EXPECT_TRUE(scene.answer(id).done) << id;
  const Time appeared = scene.at("put", "quay");
  for (const auto& status : scene.record->statuses) {
    EXPECT_THAT(status.why, testing::Not(testing::HasSubstr("banks"))) << seconds(status.time);
    EXPECT_THAT(status.why, testing::Not(testing::HasSubstr("ground"))) << seconds(status.time);
    if (status.time < appeared) {
      EXPECT_FALSE(status.obstacle) << seconds(status.time);
    }
  }
}

TEST(SceneNear, IsToldZeroWithin100Milliseconds) {
  const SceneLog& scene = scene_log("scene_near");
  const Record& log = *scene.record;
  const Time appeared = scene.at("put", "crate");
  const double v_mps = scene.pose_at(appeared).vx_mps;
  const double gap_m = scene.gap_at(appeared, "crate");
  figure("appears at a distance of", gap_m, "m");
  ASSERT_GT(v_mps, 0.45);
  ASSERT_LT(gap_m, braking_way_m(v_mps) + kChain_s * v_mps + kMargin_m) << "it is not near";
  const Time gone = scene.at("gone", "crate");
  // No ramp would end before it.
  const auto moving = log.moving(appeared, gone);
  ASSERT_FALSE(moving.empty());
  figure("told to move for", moving.back().time - appeared);
  EXPECT_LE(moving.back().time - appeared, 100ms);
  tell_way_to_rest(log, appeared, gone);
  expect_stands_before(scene, "crate", gone - 2s, gone - 100ms);
  expect_goes_on(scene, gone);
}

TEST(ScenePerson, IsLetPassAndTheGoalReached) {
  const SceneLog& scene = scene_log("scene_person");
  const Record& log = *scene.record;
  const Verdict verdict = judge(scene.poses, scene.objects);
  EXPECT_GT(verdict.nearest_moving.gap_m, 0.05);
  const auto moves = scene.all("at");
  ASSERT_GT(moves.size(), 100U) << "nobody walked";
  double slowest_mps = 1;
  for (const auto& line : log.truth)
    if (line.time > moves.front().time && line.time < moves.back().time)
      slowest_mps = std::min(slowest_mps, line.vx_mps);
  figure("slowest while somebody crossed", slowest_mps, "m/s");
  EXPECT_LT(slowest_mps, 0.4) << "it did not mind";
  EXPECT_EQ(log.statuses.back().nav, "NAV_SUCCESS");
  for (const auto& answer : scene.answers) EXPECT_TRUE(answer.done) << answer.reason;
}

TEST(SceneReverse, StopsJointCommandsThatDriveBackIntoABox) {
  const SceneLog& scene = scene_log("scene_reverse");
  const Record& log = *scene.record;
  const Time drive = log.event("event drive#1");
  const Time over = log.event("event commands_end#2");
  EXPECT_LT(scene.pose_at(over).x_m, scene.pose_at(drive).x_m - 0.5) << "it did not drive back";
  const double gap_m = scene.gap_at(over, "crate");
  figure("stands before it", gap_m, "m");
  EXPECT_GT(gap_m, 0);
  EXPECT_LE(gap_m, kFarFrom_m);
  // The stream goes on asking.
  EXPECT_THAT(log.moving(over - 1s, Time::max()), testing::IsEmpty());
  const std::string journal = said(log, "droverd.log");
  EXPECT_THAT(journal, testing::HasSubstr("joint commands ended: "));
  EXPECT_THAT(journal, testing::HasSubstr("crate"));
}

TEST(SceneEdge, StopsJointCommandsBeforeItAndLetsThemLeave) {
  const SceneLog& scene = scene_log("scene_edge");
  const Record& log = *scene.record;
  constexpr double kEdgeX_m = -12;
  ASSERT_TRUE(scene.answer("yard").done) << scene.answer("yard").reason;
  const Time drive = log.event("event drive#1");
  const Time over = log.event("event commands_end#2");
  const double stands_m = scene.pose_at(over).x_m;
  EXPECT_LT(stands_m, scene.pose_at(drive).x_m - 0.5) << "it did not drive back";
  figure("stands before it", stands_m - kEdgeX_m, "m");
  EXPECT_GT(stands_m, kEdgeX_m);
  EXPECT_LE(stands_m, kEdgeX_m + kFarFrom_m);
  EXPECT_THAT(log.moving(over - 1s, over), testing::IsEmpty());
  const std::string journal = said(log, "droverd.log");
  EXPECT_THAT(journal, testing::HasSubstr("joint commands ended: the edge of constraint yard"));
  EXPECT_EQ(journal.find("outside of its region"), std::string::npos) << "it was broken";
  // Nobody had to push it or to take the constraint away.
  EXPECT_GT(scene.pose_at(log.event("event commands_end#4")).x_m, stands_m + 0.3);
}

TEST(SceneWorker, StopsWhenNobodyLooksAroundAnyMore) {
  const SceneLog& scene = scene_log("scene_worker");
  const Record& log = *scene.record;
  const Time held = log.event("freeze scene of droverd");
  const Time thawed = log.event("thaw droverd");
  ASSERT_TRUE(moved_until(log, held)) << "it did not drive";
  const double v_mps = scene.pose_at(held).vx_mps;
  const auto slower = std::find_if(log.sent.begin(), log.sent.end(), [&](const Sent& one) {
    return one.time > held && log.rim_mps(one) < v_mps - 0.03;
  });
  ASSERT_NE(slower, log.sent.end());
  figure("slows down after", slower->time - held);
  EXPECT_LE(slower->time - held, 200ms);
  const auto moving = log.moving(held, thawed);
  ASSERT_FALSE(moving.empty());
  figure("last motion after it was held", moving.back().time - held);
  // An answer may be 0.1 s old; then the ramp that every stop has.
  const auto above = first_above_ramp(log, held + 150ms, thawed);
  EXPECT_FALSE(above) << "it is told more than a ramp to zero at " << seconds(*above);
  EXPECT_LE(moving.back().time - held, 150ms + from_s(v_mps / (0.9 * kBrakes_mps2)) + 50ms);
  tell_way_to_rest(log, held, thawed);
  bool told = false;
  for (const auto& status : log.statuses)
    told = told || (status.time > held && status.time < thawed &&
                    status.why.find("around the robot") != std::string::npos);
  EXPECT_TRUE(told);
  EXPECT_FALSE(log.moving(thawed, Time::max()).empty()) << "it does not go on";
  EXPECT_EQ(log.statuses.back().nav, "NAV_SUCCESS") << log.statuses.back().why;
}

}  // namespace
}  // namespace drover::mission
