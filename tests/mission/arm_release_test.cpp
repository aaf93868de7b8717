// A person releases a robot with an arm, to push it: the base rolls, the arm is held, and nobody
// moves it.
#include "mission/arm_motion.h"
#include "mission/arm_wire.h"

namespace drover::mission {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

struct ArmRelease : testing::Test {
  const Record& log = record("arm_release");

  Time step(const std::string& name) const { return log.event("event " + name + "#1"); }
  double way_m(Time begin, Time end) const { return roll(log, begin, end).way_m; }
};

TEST_F(ArmRelease, IsRefusedWhileATaskDrives) {
  EXPECT_THAT(said(log, "drover.log"), HasSubstr("refused: the robot is being driven"));
  EXPECT_GT(speed_at(log, step("cancelled")), 0.3);
}

TEST_F(ArmRelease, LetsTheBaseRollUnderAPush) {
  const Time pushed = step("pushed");
  const double way = way_m(pushed, step("begins"));
  figure("way under 40 N for a second", way, "m");
  EXPECT_GT(way, 0.4);
  EXPECT_THAT(log.moving(step("released") + 100ms, step("again")), IsEmpty());
}

TEST_F(ArmRelease, HoldsTheArmThatMovedAndFollowsNobodyMeanwhile) {
  const Time released = step("released");
  const Time held = step("held");
  EXPECT_GT(strayed(log, kBaseYaw, released - 200ms, released), 0.02) << "it does not move";
  ASSERT_GT(log.event("event commands_end#2"), released + 2s) << "nobody commands any more";
  // Braked by the limit of acceleration, 5 rad/s2; then it stays, though somebody pushes the base.
  figure("moved on", strayed(log, kBaseYaw, released, released + 1s), "rad");
  EXPECT_LT(strayed(log, kBaseYaw, released, released + 1s), 0.3);
  for (std::size_t joint = 0; joint < damiao::kMotors; ++joint) {
    EXPECT_LT(strayed(log, joint, released + 1s, held), 0.03) << joint;
    expect_stiff(log, joint, released, held, 500);
  }
}

TEST_F(ArmRelease, SaysSo) {
  const auto status = asked_status(log);
  EXPECT_EQ(status.at("hold"), "released");
  const auto arm = status.at("groups").at(0);
  EXPECT_EQ(arm.at("reason"), "the robot is released, to be pushed by hand: drover hold");
  EXPECT_GT(arm.at("refused"), 0);
  EXPECT_THAT(said(log, "drover.log"),
              HasSubstr("its other joints follow nobody, what runs is held"));
}

TEST_F(ArmRelease, AfterHoldThePushDoesNotMoveIt) {
  const Time pushed = step("pushed_again");
  const double way = way_m(pushed, step("lifts"));
  figure("way under the same push, held", way, "m");
  EXPECT_LT(way, 0.03);
}

TEST_F(ArmRelease, AfterHoldTheArmFollowsAndTheBaseDrivesToItsGoal) {
  const Time lifted = step("lifts") + 3500ms;
  EXPECT_NEAR(arm_at(log, kBaseYaw, lifted), -0.4, 0.02);
  EXPECT_NEAR(arm_at(log, kShoulder, lifted), 0.8, 0.04);
  EXPECT_NEAR(arm_at(log, kElbow, lifted), 0.4, 0.02);
  const Time begin = log.answered("start_nav_success", 2);
  EXPECT_GT(begin, step("again"));
  EXPECT_EQ(log.statuses.back().nav, "NAV_SUCCESS");
}

/// It was thrown back by half a radian, at 4.2 rad/s.
TEST(ArmLed, IsBrakedAndHeldWhereItComesToRest) {
  const Record& log = record("arm_led");
  const auto check = [&](Time begin, Time end) {
    double fastest = 0;
    double farthest = -10;
    double back_radps = 0;
    for (std::size_t i = 1; i < log.truth.size(); ++i) {
      const TruthLine& line = log.truth[i];
      if (line.time < begin || line.time > end) continue;
      const double rad = line.arm_rad.at(kBaseYaw);
      const double before_rad = log.truth[i - 1].arm_rad.at(kBaseYaw);
      const double radps = (rad - before_rad) / to_s(line.time - log.truth[i - 1].time);
      fastest = std::max(fastest, radps);
      farthest = std::max(farthest, rad);
      back_radps = std::max(back_radps, -radps);
    }
    figure("fastest, by a hand", fastest, "rad/s");
    figure("came back by", farthest - arm_at(log, kBaseYaw, end), "rad");
    figure("fastest on its way back", back_radps, "rad/s");
    EXPECT_GT(fastest, 3) << "else nothing is shown";
    EXPECT_LT(farthest - arm_at(log, kBaseYaw, end), 0.1);
    EXPECT_LT(back_radps, 1);
    EXPECT_LT(strayed(log, kBaseYaw, end - 1s, end), 0.01);
  };
  const Time pressed = log.event("event pressed#1");
  check(pressed, pressed + 3900ms);
  const Time again = log.event("event push_again#1");
  check(again, again + 3900ms);
}

}  // namespace
}  // namespace drover::mission
