// An arm that pressed against something when its commands ceased, and two of them on one bus.
#include "mission/arm_motion.h"
#include "mission/arm_wire.h"

namespace drover::mission {
namespace {

using testing::HasSubstr;

struct ArmPresses : testing::Test {
  const Record& log = record("arm_presses");
  const Time ceased = log.event("event commands_end#1");

  /// What its motor gives then, toward its upper stop.
  double presses_Nm(Time time) const {
    for (const TruthLine& line : log.truth)
      if (line.time >= time) return line.arm_Nm.at(kShoulder);
    throw std::runtime_error("no true motion then");
  }
};

TEST_F(ArmPresses, LetsGoOfItWhileItIsHeld) {
  figure("pressed as its commands ceased", presses_Nm(ceased - 10ms), "Nm");
  ASSERT_GT(presses_Nm(ceased - 10ms), 8);
  for (const auto& [after, word] :
       {std::pair{1s, "1 s"}, std::pair{3s, "3 s"}, std::pair{5s, "5 s"}, std::pair{10s, "10 s"}})
    figure((std::string("presses after ") + word).c_str(), presses_Nm(ceased + after), "Nm");
  EXPECT_LT(presses_Nm(ceased + 10s), 1);
  expect_stiff(log, kShoulder, ceased + 200ms, ceased + 13s, 500);
  EXPECT_LT(strayed(log, kShoulder, ceased, ceased + 13s), 0.02);
}

TEST_F(ArmPresses, CarriesTheWeightOfItsElbowOn) {
  figure("the elbow strayed", strayed(log, kElbow, ceased, ceased + 13s), "rad");
  figure("at the end", arm_at(log, kElbow, ceased + 13s) - arm_at(log, kElbow, ceased), "rad");
  EXPECT_LT(strayed(log, kElbow, ceased, ceased + 13s), 0.01);
}

TEST_F(ArmPresses, DoesNotConcernTheBase) {
  expect_good_drive(log, 1);
}

struct TwoArms : testing::Test {
  const Record& log = record("two_arms");

  Time step(const std::string& name) const { return log.event("event " + name + "#1"); }
};

TEST_F(TwoArms, TheFaultOfOneLeavesTheOtherFollowing) {
  EXPECT_NEAR(arm_at(log, kBaseYaw, step("turn") + 2900ms), -0.3, 0.02);
  EXPECT_NEAR(arm_at(log, kShoulder, step("turn") + 2900ms), 0.5, 0.04);
  const auto groups = asked_status(log).at("groups");
  EXPECT_EQ(groups.at(0).at("state"), "following");
  EXPECT_EQ(groups.at(0).at("reason"), "");
  EXPECT_THAT(groups.at(1).at("reason").get<std::string>(), HasSubstr("over"));
}

TEST_F(TwoArms, TheFaultOfTheOtherLeavesTheFirstFollowing) {
  EXPECT_NEAR(arm_at(log, kElbow, step("bend") + 2900ms), 1.0, 0.04);
  const auto groups = asked_status(log, 2).at("groups");
  EXPECT_THAT(groups.at(0).at("reason").get<std::string>(), HasSubstr("over"));
  EXPECT_EQ(groups.at(1).at("state"), "following");
}

TEST_F(TwoArms, NeitherConcernsTheBase) {
  expect_good_drive(log, 1);
}

}  // namespace
}  // namespace drover::mission
