// The straight way for a heading, to its success: the heading, the position, and a task.
#include "../engine_fixture.h"

namespace drover::engine {
namespace {

using ::testing::HasSubstr;

class AHeadingFound : public AnEngine {
 protected:
  AHeadingFound() { askew.no_heading = true; }
  std::string refused() const {
    const auto all = askew.said<CommandRefused>();
    return all.empty() ? "" : std::string(all.back().reason.view());
  }
  /// Until it is over, at most as long as the way may take.
  void creep() {
    askew.command(FindHeading{});
    for (int i = 0; i < 200 * 40; ++i) {
      askew.tick();
      fastest_mps = std::max(fastest_mps, askew.plant.truth().vx_mps);
      if (askew.snapshot().nav.owner != Owner::manual && i > 20) return;
    }
    FAIL() << "it creeps for ever";
  }
  EngineRig askew{rig_config(), 0, 0, 0.7};
  double fastest_mps = 0;
};

TEST_F(AHeadingFound, IsTheSearchsOwnDoingToItsLastCentimetre) {
  askew.settle();
  askew.command(FindHeading{});
  bool moved = false;
  for (int i = 0; i < 200 * 40; ++i) {
    askew.tick();
    const bool moves = askew.fastest_command_radps() > 0;
    moved = moved || moves;
    if (moves) {
      ASSERT_EQ(askew.snapshot().nav.owner, Owner::manual) << i;
    }
  }
  EXPECT_TRUE(moved);
  EXPECT_EQ(askew.snapshot().nav.owner, Owner::nobody);
}

/// The reason is told for as long as there is no heading: else "no heading yet" asks to do the same
/// again.
TEST_F(AHeadingFound, IsTheEndOfTheReasonWhyThereWasNone) {
  const auto has = [this](const char* text) { return askew.why().find(text) != std::string::npos; };
  askew.settle();
  askew.command(FindHeading{});
  askew.run_s(2);
  askew.lines[static_cast<std::size_t>(Line::zone_near)] = true;
  askew.run_s(3);
  ASSERT_EQ(askew.snapshot().nav.owner, Owner::nobody);
  EXPECT_TRUE(has("no heading: obstacle")) << askew.why();
  askew.lines[static_cast<std::size_t>(Line::zone_near)] = false;
  askew.run_s(10);
  EXPECT_EQ(askew.why().find("no heading: "), 0U) << askew.why();
  creep();
  askew.run_s(1);
  EXPECT_FALSE(has("no heading")) << askew.why();
}

TEST_F(AHeadingFound, IsWhatAStartWaitsFor) {
  askew.settle();
  askew.start(path, 40, 0.5);
  askew.run_s(1);
  EXPECT_EQ(askew.fastest_command_radps(), 0);
  EXPECT_THAT(refused(), HasSubstr("heading"));
  EXPECT_EQ(askew.snapshot().nav.locate, LocateState::uninit);
}

TEST_F(AHeadingFound, EndsTheCreepAndLetsATaskReachItsGoal) {
  askew.settle();
  creep();
  std::string told;
  for (const auto& notice : askew.said<Notice>()) told += std::string(notice.text.view()) + "\n";
  EXPECT_THAT(told, HasSubstr("heading found after 1."));
  EXPECT_LE(fastest_mps, askew.config.navigate.find_heading_speed_mps + 0.01);
  askew.run_s(3);
  EXPECT_EQ(askew.fastest_command_radps(), 0) << "it stands again";
  EXPECT_EQ(askew.snapshot().nav.owner, Owner::nobody);
  EXPECT_EQ(askew.snapshot().nav.locate, LocateState::good);
  EXPECT_NEAR(askew.snapshot().pose.yaw_rad, 0.7, 0.07);  // bound_yaw_deg

  // Half a metre between points, from where it stands now straight ahead.
  Path ahead;
  ahead.name = "ahead";
  const Pose from = askew.plant.truth();
  for (int i = 0; i <= 16; ++i) {
    ahead.points.push_back(
        {from.x_m + 0.5 * i * std::cos(0.7), from.y_m + 0.5 * i * std::sin(0.7)});
  }
  askew.start(ahead, 16, 0.5);
  askew.run_s(30);
  ASSERT_EQ(askew.said<NavigationStarted>().size(), 1U) << refused();
  EXPECT_EQ(askew.snapshot().nav.status, NavStatus::success) << askew.why();
  const Pose to = askew.plant.truth();
  EXPECT_LT(std::hypot(to.x_m - ahead.points[16].x_m, to.y_m - ahead.points[16].y_m), 0.10);
}

}  // namespace
}  // namespace drover::engine
