// What is kept: constraints while they hold, fences when the origin moves, all of it over a
// restart; and the search for the heading beside a fence.

#include "mission/scene_support.h"

namespace drover::mission {
namespace {

TEST(SceneOrigin, TheFenceAndTheBoxStayWhereTheyAre) {
  const SceneLog& scene = scene_log("scene_origin");
  const Record& log = *scene.record;
  const Time moved = log.event("event moved#1");
  const auto before = std::find_if(log.statuses.rbegin(), log.statuses.rend(),
                                   [moved](const Status& one) { return one.time < moved; });
  const auto after = std::find_if(log.statuses.begin(), log.statuses.end(),
                                  [moved](const Status& one) { return one.time > moved + 4s; });
  ASSERT_NE(before, log.statuses.rend());
  ASSERT_NE(after, log.statuses.end());
  const double shift_m = distance_m(before->map, after->map);
  figure("the map moved by", shift_m, "m");
  EXPECT_GT(shift_m, 3) << "the origin did not move";
  expect_refused(scene, 1, "pond", way_to_m(scene, log.answered("start_task_failse"), -2));
  expect_refused(scene, 2, "crate", way_to_m(scene, log.answered("start_task_failse", 2), 0.25));
  EXPECT_THAT(log.moving(moved, log.answered("start_task_success", 2) - kEstop),
              testing::IsEmpty());
  EXPECT_EQ(log.statuses.back().nav, "NAV_SUCCESS") << log.statuses.back().why;
}

TEST(SceneConstraint, StopsWhereTheYardEndsAndSaysSo) {
  const SceneLog& scene = scene_log("scene_constraint");
  const Record& log = *scene.record;
  const Time told = log.event("event told#1");
  const Time cleared = log.event("event cleared#1");
  ASSERT_TRUE(moved_until(log, told));
  ASSERT_TRUE(scene.answer("yard", told).done) << scene.answer("yard", told).reason;
  const double x_m = scene.pose_at(cleared).x_m;
  figure("stands past the yard's edge", x_m + 5, "m");
  EXPECT_LT(x_m, -5 + 0.35);
  EXPECT_GT(x_m, -5 - kFarFrom_m);
  EXPECT_THAT(log.moving(cleared - 2s, cleared), testing::IsEmpty());
  std::size_t looked = 0;
  for (const auto& status : log.statuses) {
    if (status.time < cleared - 1s || status.time > cleared) continue;
    ++looked;
    EXPECT_THAT(status.why, testing::HasSubstr("yard")) << seconds(status.time);
  }
  EXPECT_GT(looked, 5U);
  expect_goes_on(scene, cleared);
}

TEST(SceneHeading, IsNotLookedForIntoAFence) {
  const SceneLog& scene = scene_log("scene_heading");
  const Record& log = *scene.record;
  const Time asked = log.event("event asked#1");
  const Time gone = log.event("event pulled_down#1");
  EXPECT_LT(log.first_status("LOCATE_TRUE").time, Time::max());
  EXPECT_GT(log.first_status("LOCATE_TRUE").time, gone) << "there was room enough";
  EXPECT_THAT(log.moving(gone - 2s, gone), testing::IsEmpty());
  bool told = said(log, "drover.log").find("shed") != std::string::npos ||
              said(log, "droverd.log").find("shed") != std::string::npos;
  for (const auto& status : log.statuses)
    told = told || (status.time > asked && status.time < gone &&
                    status.why.find("shed") != std::string::npos);
  EXPECT_TRUE(told) << "nobody was told of the shed";
  EXPECT_EQ(log.statuses.back().nav, "NAV_SUCCESS") << log.statuses.back().why;
}

TEST(SceneRestart, KnowsBoxAndFenceAndConstraints) {
  const SceneLog& scene = scene_log("scene_restart");
  const Record& log = *scene.record;
  ASSERT_TRUE(scene.answer("crate").done);
  ASSERT_TRUE(scene.answer("far yard").done) << scene.answer("far yard").reason;
  const auto told = said(log, "drover.log");
  for (const char* name : {"crate", "far yard"})
    EXPECT_THAT(told, testing::HasSubstr(name)) << "drover scene list";
  expect_refused(scene, 1, "crate", way_to_m(scene, log.answered("start_task_failse"), -5.25));
  expect_refused(scene, 2, "pond", way_to_m(scene, log.answered("start_task_failse", 2), -2));
  EXPECT_THAT(log.moving(kNever, log.answered("start_task_success") - kEstop), testing::IsEmpty());
  EXPECT_EQ(log.statuses.back().nav, "NAV_SUCCESS") << log.statuses.back().why;
}

}  // namespace
}  // namespace drover::mission
