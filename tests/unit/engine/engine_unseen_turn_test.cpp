// One antenna and no gyro: on the first way nothing but the receiver's places can show a turn.
#include <random>

#include "engine_fixture.h"

namespace drover::engine {
namespace {

using ::testing::HasSubstr;

EngineConfig unproved_config() {
  EngineConfig config = rig_config();
  config.navigate.first_way_m = 0.3;
  return config;
}

class ARobotWhoseTurnsNobodyTells : public AnEngine {
 protected:
  ARobotWhoseTurnsNobodyTells() { build(0.2); }
  void build(double antenna_x_m) {
    EngineConfig config = unproved_config();
    config.estimate.antenna_x_m = antenna_x_m;
    rig = EngineRig(config);
    rig.no_heading = true;
  }
  /// One cycle; the receiver's places scatter as those of an RTK fix do.
  void tick() {
    if (scatter) {
      rig.jump_m = noise(random);
      rig.aside_m = noise(random);
    }
    rig.tick();
  }
  void run_s(double seconds) {
    for (int i = 0; i < static_cast<int>(seconds * 200); ++i) tick();
  }
  void find_its_heading(double and_rests_s = 2) {
    rig.settle();
    run_s(2);
    rig.command(FindHeading{});
    run_s(1);
    while (rig.snapshot().nav.owner == Owner::manual) tick();
    run_s(and_rests_s);
    ASSERT_EQ(rig.snapshot().nav.locate, LocateState::good) << rig.why();
    EXPECT_FALSE(rig.out.remembered.mechanics_proved) << "by a way straight on";
  }
  /// The true way of a task until it failed, or was proved to be right.
  double goes_until_judged_m() {
    const double before_m = rig.driven_m;
    rig.start(path, 40, 0.5);
    const auto judged = [this] {
      return rig.out.remembered.mechanics_proved || rig.snapshot().nav.status == NavStatus::error;
    };
    for (int i = 0; i < 200 * 60 && !judged(); ++i) {
      tick();
      fastest_mps = std::max(fastest_mps, rig.fastest_command_radps() * 0.165);
    }
    return rig.driven_m - before_m;
  }
  std::string ended() const {
    const auto ends = rig.said<TaskEnded>();
    return ends.empty() ? "" : std::string(ends[0].reason.view());
  }
  double fastest_mps = 0;
  bool scatter = false;
  std::mt19937 random{1};
  std::normal_distribution<double> noise{0, 0.005};
};

TEST_F(ARobotWhoseTurnsNobodyTells, FindsSwappedSidesByWhereItsReceiverGoes) {
  rig.mechanics.swapped = true;
  find_its_heading();
  EXPECT_LT(goes_until_judged_m(), 0.2);
  EXPECT_THAT(ended(), HasSubstr("by where the receiver went -"));
  EXPECT_THAT(ended(), HasSubstr("sides swapped"));
  EXPECT_LT(fastest_mps, 0.17) << "the rim of a slow turn";
  EXPECT_LT(std::abs(to_deg(rig.plant.truth().yaw_rad)), 15);
}

/// The places of the moment before it are where that way begins.
TEST_F(ARobotWhoseTurnsNobodyTells, FindsThemOnATaskThatBeginsAsSoonAsTheHeadingIsFound) {
  rig.mechanics.swapped = true;
  for (const double after_s : {0.0, 0.3, 0.6, 0.95, 1.0, 1.05, 1.2}) {
    build(0.2);
    rig.mechanics.swapped = true;
    find_its_heading(after_s);
    for (int i = 0; i < 200 && rig.plant.truth().vx_mps > 0.001; ++i) tick();
    EXPECT_LT(goes_until_judged_m(), 0.2) << after_s;
    EXPECT_THAT(ended(), HasSubstr("sides swapped")) << after_s;
    EXPECT_LT(fastest_mps, 0.21) << after_s;
  }
}

/// A turn alone does not move it.
TEST_F(ARobotWhoseTurnsNobodyTells, FindsThemWithAnAntennaOverItsMiddle) {
  build(0);
  rig.mechanics.swapped = true;
  find_its_heading();
  EXPECT_LT(goes_until_judged_m(), 0.4);
  EXPECT_THAT(ended(), HasSubstr("sides swapped"));
  EXPECT_LT(fastest_mps, 0.17);
}

TEST_F(ARobotWhoseTurnsNobodyTells, FindsWheelsOfOneAxleThatAreSwapped) {
  rig.mechanics.crossed = true;
  find_its_heading();
  EXPECT_LT(goes_until_judged_m(), 0.7);
  EXPECT_THAT(ended(), HasSubstr("are the sides swapped on one axle (front_left/"));
  EXPECT_LT(fastest_mps, 0.17);
}

TEST_F(ARobotWhoseTurnsNobodyTells, IsProvedByThem) {
  find_its_heading();
  EXPECT_LT(goes_until_judged_m(), 0.8);
  EXPECT_TRUE(rig.out.remembered.mechanics_proved) << rig.why() << ended();
  EXPECT_LT(fastest_mps, 0.17);
  EXPECT_LT(std::abs(rig.plant.truth().y_m), 0.06);
  rig.run_s(5);
  EXPECT_GT(rig.fastest_command_radps() * 0.165, 0.45) << rig.why();
}

TEST_F(ARobotWhoseTurnsNobodyTells, IsProvedThoughItTurnsHalfAsMuchAsItsWheelsSay) {
  rig.plant = test::Plant2d(rig.config.base, {.yaw_scrub = 0.5}, 0, 0, 0);
  find_its_heading();
  EXPECT_LT(goes_until_judged_m(), 1.0);
  EXPECT_TRUE(rig.out.remembered.mechanics_proved) << rig.why() << ended();
}

/// Its drives do not make a turn of what they are asked for: nobody knows which way it would go.
TEST_F(ARobotWhoseTurnsNobodyTells, GoesOnSlowlyWhereItWasNotSeenToTurn) {
  rig.mechanics.differs = 0;
  find_its_heading();
  rig.start(path, 40, 0.5);
  run_s(15);
  EXPECT_EQ(rig.why(), "slowly: it was not seen to turn to both sides yet");
  run_s(35);
  EXPECT_EQ(rig.snapshot().nav.status, NavStatus::run) << ended();
  EXPECT_EQ(rig.why(),
            "slowly: its turn was not seen; let it rest for two seconds, and it turns again");
  EXPECT_LT(std::abs(rig.plant.truth().vx_mps), 0.06);
  EXPECT_FALSE(rig.out.remembered.mechanics_proved);
}

TEST_F(ARobotWhoseTurnsNobodyTells, IsJudgedRightHoweverItsPlacesScatter) {
  for (unsigned seed = 1; seed <= 40; ++seed) {
    const bool swapped = seed % 2 == 0;
    build(seed % 4 < 2 ? 0.2 : 0.0);
    rig.mechanics.swapped = swapped;
    random.seed(seed);
    scatter = true;
    find_its_heading();
    const double way_m = goes_until_judged_m();
    EXPECT_LT(way_m, swapped ? 0.5 : 1.2) << seed;
    EXPECT_EQ(rig.out.remembered.mechanics_proved, !swapped) << seed << ": " << ended();
    if (swapped) EXPECT_THAT(ended(), HasSubstr("sides swapped")) << seed;
  }
}

}  // namespace
}  // namespace drover::engine
