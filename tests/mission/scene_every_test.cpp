// What holds in every mission with a planning scene: nothing is touched. Two judges say so, and
// they agree: exact geometry on the true poses, and the mechanics with a hull of full height.
#include "mission/scene_support.h"

namespace drover::mission {
namespace {

class EveryScene : public testing::TestWithParam<const char*> {
 protected:
  const SceneLog& scene() const { return scene_log(GetParam()); }
};

TEST_P(EveryScene, IsWatchedAtEachTick) {
  ASSERT_GT(scene().poses.size(), 1000U);
  const auto lasted = scene().poses.back().time - scene().poses.front().time;
  EXPECT_NEAR(static_cast<double>(scene().poses.size()) / to_s(lasted), 200, 2);
  EXPECT_LE(scene().objects.front().time, scene().poses.front().time + 10ms);
}

TEST_P(EveryScene, TouchesNothingByTheExactJudge) {
  const Verdict verdict = judge(scene().poses, scene().objects);
  std::printf("  %zu poses, at most %zu things at once\n", verdict.poses, verdict.things);
  figure("nearest while moving", std::min(verdict.nearest_moving.gap_m, 99.0), "m");
  EXPECT_EQ(verdict.poses, scene().poses.size());
  EXPECT_FALSE(verdict.first) << verdict.first->what << " at " << seconds(verdict.first->time)
                              << ", " << verdict.first->gap_m << " m, "
                              << (verdict.first->moving ? "moving" : "at rest");
}

TEST_P(EveryScene, TouchesNothingByTheMechanics) {
  for (const auto& touch : scene().all("touch"))
    ADD_FAILURE() << "it touched " << touch.name << " at " << seconds(touch.time) << ", "
                  << touch.numbers[3] << " m/s";
  for (const auto& status : scene().record->statuses)
    EXPECT_EQ(status.why.find("bumper"), std::string::npos) << status.why;
}

INSTANTIATE_TEST_SUITE_P(Each, EveryScene,
                         testing::Values("scene_backwards", "scene_box", "scene_near", "scene_pole",
                                         "scene_person", "scene_refused", "scene_keep_out",
                                         "scene_keep_in", "scene_beside", "scene_pivot",
                                         "scene_planes", "scene_mouth", "scene_wall_behind",
                                         "scene_stamps", "scene_origin", "scene_constraint",
                                         "scene_reverse", "scene_edge", "scene_heading",
                                         "scene_worker", "scene_restart", "scene_aside"),
                         [](const auto& one) { return std::string(one.param); });

}  // namespace
}  // namespace drover::mission
