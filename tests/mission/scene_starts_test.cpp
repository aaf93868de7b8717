// Whole tracks are looked along before they are driven: what is refused, in which words, and what
// is not.
#include "mission/scene_support.h"

namespace drover::mission {
namespace {

/// Nothing moves before the start that is accepted.
void expect_rest_until_accepted(const Record& log, std::size_t n = 1) {
  EXPECT_THAT(log.moving(kNever, log.answered("start_task_success", n) - kEstop),
              testing::IsEmpty());
}

/// No status from the start to the success speaks of an obstacle, and it never stands.
void expect_undisturbed(const SceneLog& scene) {
  const Record& log = *scene.record;
  EXPECT_EQ(log.feedback_words(), kStarted);
  const Time start = log.answered("start_nav_success");
  const Time success = log.first_status("NAV_SUCCESS", start).time;
  for (const auto& status : log.statuses)
    if (status.time > start && status.time < success) {
      EXPECT_FALSE(status.obstacle) << seconds(status.time) << ": " << status.why;
    }
  for (const auto& line : log.truth)
    if (line.time > start + 3s && line.time < success - 5s) {
      ASSERT_GT(line.vx_mps, 0.2) << seconds(line.time);
    }
  expect_good_drive(log);
}

TEST(SceneRefused, NamesTheBoxItsDistanceAndThePoint) {
  const SceneLog& scene = scene_log("scene_refused");
  const Time placed = scene.at("put", "crate");
  const auto& crate = scene.all("put").front().solid;
  ASSERT_TRUE(scene.answer("crate", placed).done);
  expect_refused(scene, 1, "crate",
                 way_to_m(scene, scene.record->answered("start_task_failse"), crate.x_m - 0.25));
  expect_rest_until_accepted(*scene.record);
  EXPECT_EQ(scene.record->statuses.back().nav, "NAV_SUCCESS");
}

TEST(SceneKeepOut, IsRefusedAtTheStartAndStaysWhileATaskRuns) {
  const SceneLog& scene = scene_log("scene_keep_out");
  const Record& log = *scene.record;
  expect_refused(scene, 1, "pond", way_to_m(scene, log.answered("start_task_failse"), -6));
  expect_rest_until_accepted(log);
  const Time drawn = log.event("event drawn_anew#1");
  const Time filled = log.event("event filled#1");
  ASSERT_TRUE(moved_until(log, drawn));
  const Verdict verdict =
      judge(scene.poses, scene.objects, {fence("pit", -4, -5, -3, 1, drawn, filled)});
  EXPECT_FALSE(verdict.first) << "it is in the pit at " << seconds(verdict.first->time);
  figure("stands before it", verdict.nearest.gap_m, "m");
  EXPECT_LE(verdict.nearest.gap_m, kFarFrom_m);
  const Time given_up = log.event("event given_up#1");
  for (const auto& status : log.statuses) {
    if (status.time < given_up - 1s || status.time > given_up) continue;
    EXPECT_TRUE(status.obstacle) << seconds(status.time);
    EXPECT_THAT(status.why, testing::HasSubstr("pit")) << seconds(status.time);
  }
  EXPECT_EQ(log.statuses.back().nav, "NAV_SUCCESS") << log.statuses.back().why;
  EXPECT_EQ(log.all("end of drover with status 0").size(), 4U);
  EXPECT_EQ(log.all("end of drover with status 1").size(), 1U) << "a task ran";
}

TEST(SceneKeepIn, IsNotLeftByTheTrack) {
  const SceneLog& scene = scene_log("scene_keep_in");
  const Record& log = *scene.record;
  expect_refused(scene, 1, "yard", way_to_m(scene, log.answered("start_task_failse"), -5));
  expect_rest_until_accepted(log);
  const Verdict verdict =
      judge(scene.poses, scene.objects,
            {fence("north", -50, -0.8, 50, 10), fence("south", -50, -20, 50, -3.2)});
  EXPECT_FALSE(verdict.first) << verdict.first->what;
  expect_good_drive(log);
  EXPECT_EQ(log.all("end of drover with status 0").size(), 3U);
}

TEST(SceneBeside, IsNoReasonToStop) {
  const SceneLog& scene = scene_log("scene_beside");
  for (const char* id : {"left", "right"}) EXPECT_TRUE(scene.answer(id).done);
  expect_undisturbed(scene);
  const Verdict verdict = judge(scene.poses, scene.objects);
  figure("nearest", verdict.nearest.gap_m, "m");
  EXPECT_LT(verdict.nearest.gap_m, kMargin_m + 0.12) << "they are not where they should be";
}

TEST(SceneMouth, OfAConcaveMeshIsDrivenInto) {
  const SceneLog& scene = scene_log("scene_mouth");
  ASSERT_TRUE(scene.answer("bay").done) << scene.answer("bay").reason;
  expect_undisturbed(scene);
}

TEST(SceneWallBehind, TheGoalIsReachedBeforeIt) {
  const SceneLog& scene = scene_log("scene_wall_behind");
  expect_undisturbed(scene);
  EXPECT_NEAR(scene.gap_at(scene.poses.back().time, "wall"), 0.5, 0.1);
}

TEST(ScenePivot, IsRefusedOrStoppedBeforeTheWallIsTouched) {
  const SceneLog& scene = scene_log("scene_pivot");
  const Record& log = *scene.record;
  const Time refused = log.answered("start_task_failse");
  const auto& words = log.feedback;
  const auto reason = std::find_if(words.begin(), words.end(),
                                   [refused](const Feedback& one) { return one.time == refused; });
  EXPECT_THAT(reason->reason, testing::HasSubstr("wall"));
  expect_rest_until_accepted(log);
  const Time back = scene.at("put", "wall", 2);
  const Time gone = scene.at("gone", "wall", 2);
  ASSERT_TRUE(moved_until(log, back));
  EXPECT_THAT(log.moving(gone - 2s, gone), testing::IsEmpty()) << "it does not mind";
  EXPECT_LT(std::abs(scene.pose_at(gone).yaw_rad), 0.8) << "it turned";
  for (const auto& status : log.statuses) {
    if (status.time < gone - 1s || status.time > gone) continue;
    EXPECT_TRUE(status.obstacle) << seconds(status.time);
    EXPECT_THAT(status.why, testing::HasSubstr("wall")) << seconds(status.time);
  }
  expect_goes_on(scene, gone);
}

TEST(SceneStamps, WhatIsOldOrNowhereIsRefusedAndWhatIsNewIsTakenWhereTheRobotIs) {
  const SceneLog& scene = scene_log("scene_stamps");
  const Record& log = *scene.record;
  EXPECT_FALSE(scene.answer("stale").done);
  EXPECT_THAT(scene.answer("stale").path, testing::HasSubstr("stamp"));
  EXPECT_FALSE(scene.answer("nowhere").done);
  EXPECT_THAT(scene.answer("nowhere").path, testing::HasSubstr("frame_id"));
  EXPECT_TRUE(scene.answer("fresh").done) << scene.answer("fresh").reason;
  const Time nameless = log.event("event nameless#1");
  const auto& unnamed = scene.answer("", nameless);
  EXPECT_FALSE(unnamed.done) << "a message without an id clears the scene";
  EXPECT_EQ(unnamed.path, "id");
  EXPECT_FALSE(scene.answer("ghost").done);
  expect_refused(scene, 1, "fresh", way_to_m(scene, log.answered("start_task_failse"), -6.25));
  expect_rest_until_accepted(log);
  EXPECT_EQ(log.statuses.back().nav, "NAV_SUCCESS") << log.statuses.back().why;
}

}  // namespace
}  // namespace drover::mission
