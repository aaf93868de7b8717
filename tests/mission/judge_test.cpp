// The judge is judged on poses and things made by hand.
#include "mission/judge.h"

#include <gtest/gtest.h>

namespace drover::mission {
namespace {

using namespace std::chrono_literals;

TEST(TheJudge, SaysTheFirstContactAndWhetherTheRobotMoved) {
  const std::vector<ObjectLine> objects{
      parse_object_line("(1.000000000) watching 36"),
      parse_object_line("(2.000000000) put wall box 3.0 0.0 0.5 0.0 0.2 4.0 1.0"),
      parse_object_line("(3.000000000) at wall 1.5 0.0"),
      parse_object_line("(9.000000000) gone wall")};
  std::vector<TruePose> poses;
  for (int i = 0; i < 100; ++i) {
    const Time time{i * 100ms};
    const bool moves = i < 50;
    poses.push_back({time, moves ? 0.02 * i : 1, 0, 0, moves ? 0.2 : 0, 0});
  }
  const Verdict verdict = judge(poses, objects);
  EXPECT_EQ(verdict.poses, 100U);
  EXPECT_EQ(verdict.things, 1U);
  ASSERT_TRUE(verdict.first_moving);
  // Its face is at 1.4 m, the robot's front reaches it from 0.95 m on.
  EXPECT_EQ(verdict.first_moving->time, Time{4800ms});
  EXPECT_EQ(verdict.first_moving->what, "wall");
  EXPECT_NEAR(verdict.nearest.gap_m, -0.05, 1e-9);
  EXPECT_FALSE(judge(poses, objects, {}, Time{5500ms}).first_moving) << "it stands";
  EXPECT_TRUE(judge(poses, objects, {}, Time{5500ms}).first);
  EXPECT_FALSE(judge(poses, objects, {}, Time{9s}).first) << "it is gone";
  EXPECT_FALSE(judge(poses, {}).first);
}

TEST(TheJudge, KnowsFences) {
  Fence fence;
  fence.name = "pond";
  fence.flat = {{{1, -1}, {2, -1}, {2, 1}, {1, 1}}, 0};
  fence.begin = Time{2s};
  const std::vector<TruePose> poses{{Time{1s}, 1, 0, 0, 0.5, 0}, {Time{3s}, 0.5, 0, 0, 0.5, 0}};
  const Verdict verdict = judge(poses, {}, {fence});
  EXPECT_FALSE(verdict.first) << "it was not there when the robot was";
  EXPECT_NEAR(verdict.nearest.gap_m, 0.05, 1e-12);
}

}  // namespace
}  // namespace drover::mission
