// Words that the tests of missions with a planning scene share.
#pragma once

#include <regex>

#include "mission/robot.h"
#include "mission/scene_log.h"
#include "mission/support.h"

namespace drover::mission {

/// What a drive is beside its track at the most.
inline constexpr double kOffTrack_m = 0.05;

/// From `begin` to `end` it stands still because of `name`, which it is told, at most so far from
/// it.
inline void expect_stands_before(const SceneLog& scene, const std::string& name, Time begin,
                                 Time end) {
  const Record& log = *scene.record;
  const double gap_m = scene.gap_at(end, name);
  figure("stands before it", gap_m, "m");
  EXPECT_GT(gap_m, 0) << name;
  EXPECT_LE(gap_m, kFarFrom_m) << name;
  EXPECT_THAT(log.moving(begin, end), testing::IsEmpty());
  std::size_t looked = 0;
  for (const auto& status : log.statuses) {
    if (status.time < begin || status.time > end) continue;
    ++looked;
    EXPECT_TRUE(status.obstacle) << seconds(status.time);
    EXPECT_EQ(status.nav, "NAV_RUN") << seconds(status.time);
    EXPECT_THAT(status.why, testing::HasSubstr(name)) << seconds(status.time);
  }
  EXPECT_GT(looked, 5U) << "no status from " << seconds(begin) << " to " << seconds(end);
}

/// After `freed` it goes on by itself, not before a second of freedom, and reaches its goal.
inline void expect_goes_on(const SceneLog& scene, Time freed) {
  const Record& log = *scene.record;
  const auto moving = log.moving(freed, Time::max());
  ASSERT_FALSE(moving.empty()) << "it never goes on";
  figure("goes on after", moving.front().time - freed);
  EXPECT_GT(moving.front().time - freed, 900ms);
  EXPECT_LT(moving.front().time - freed, 3s);
  EXPECT_EQ(log.statuses.back().nav, "NAV_SUCCESS") << log.statuses.back().why;
}

/// The n-th refused start: its words name what is in the way, how far it is and after which point.
inline void expect_refused(const SceneLog& scene, std::size_t n, const std::string& name,
                           double true_way_m) {
  const Record& log = *scene.record;
  const Time answered = log.answered("start_task_failse", n);
  const auto refused =
      std::find_if(log.feedback.begin(), log.feedback.end(),
                   [answered](const Feedback& one) { return one.time == answered; });
  const std::string& reason = refused->reason;
  std::printf("  refused: %s\n", reason.c_str());
  EXPECT_THAT(reason, testing::HasSubstr(name));
  EXPECT_TRUE(std::regex_search(reason, std::regex("point [0-9]+"))) << reason;
  std::smatch found;
  ASSERT_TRUE(std::regex_search(reason, found, std::regex("([0-9]+\\.[0-9]+) m ahead"))) << reason;
  const double told_m = std::stod(found[1]);
  EXPECT_LE(told_m, true_way_m + 0.05);
  EXPECT_GE(told_m, true_way_m - kMargin_m - kBlur_m - kOffTrack_m);
}

/// From the robot's front at `time`, which looks east, to the nearest of what lies at x.
inline double way_to_m(const SceneLog& scene, Time time, double x_m) {
  return x_m - scene.pose_at(time).x_m - RobotShape{}.front_m;
}

/// A rectangle that nothing of the robot may be in.
inline Fence fence(const std::string& name, double west_m, double south_m, double east_m,
                   double north_m, Time begin = kNever, Time end = Time::max()) {
  return {name,
          {{{west_m, south_m}, {east_m, south_m}, {east_m, north_m}, {west_m, north_m}}, 0},
          begin,
          end};
}

}  // namespace drover::mission
