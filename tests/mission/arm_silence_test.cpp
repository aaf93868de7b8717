// What the joints of an arm do when their commands cease, each as its on_silence says.
#include "mission/arm_motion.h"
#include "mission/arm_wire.h"

namespace drover::mission {
namespace {

struct ArmSilence : testing::Test {
  const Record& log = record("arm_silence");
  const Time ceased = log.event("event commands_end#1");
  const Time again = log.event("event raise_again#1");
  // Their time-out is over, and what moves them is on the wire.
  const Time silent = ceased + 150ms;

  /// Told to a motor in words of its own, that it shall turn on (FC) or off (FD).
  std::size_t told(std::uint8_t word, std::uint32_t id, Time begin, Time end) const {
    return static_cast<std::size_t>(
        std::count_if(log.can.begin(), log.can.end(), [&](const CanLine& line) {
          return line.bus == "can1" && line.time >= begin && line.time <= end &&
                 line.frame.id == id && line.frame.data[0] == 0xFF && line.frame.data[7] == word;
        }));
  }
};

TEST_F(ArmSilence, BeginsWithTheArmHeldUpWhileTheBaseDrives) {
  EXPECT_NEAR(arm_at(log, kBaseYaw, ceased), 0.3, 0.02);
  EXPECT_NEAR(arm_at(log, kShoulder, ceased), 1.0, 0.03);
  EXPECT_NEAR(arm_at(log, kElbow, ceased), 0.4, 0.03);
  EXPECT_GT(speed_at(log, ceased), 0.3);
  EXPECT_GT(speed_at(log, again), 0.3) << "the end of a stream is no stop of the base";
}

TEST_F(ArmSilence, HoldsTheJointThatHolds) {
  expect_stiff(log, kBaseYaw, silent, again, 200);
  EXPECT_LT(strayed(log, kBaseYaw, ceased, again), 0.02);
}

TEST_F(ArmSilence, DampsTheJointThatDamps) {
  // What its stiffness and effort were comes down within rise_s.
  const auto told = arm_set_points(log, kShoulder, silent + 600ms, again);
  EXPECT_GT(told.size(), 100U);
  for (const ArmSetPoint& one : told)
    ASSERT_TRUE(one.told.only_damps()) << "at " << seconds(one.time);
  const double sank = arm_at(log, kShoulder, silent) - arm_at(log, kShoulder, silent + 1s);
  figure("shoulder, damped: sank in 1 s", sank, "rad");
  // 1.9 Nm over 4.9 Nms/rad are 0.4 rad/s; without damping it would be on its stop.
  EXPECT_GT(sank, 0.1);
  EXPECT_LT(sank, 0.6);
}

TEST_F(ArmSilence, LetsGoOfTheJointThatReleases) {
  EXPECT_GE(told(0xFD, 3, ceased, silent), 1U) << "nobody turned it off";
  EXPECT_EQ(arm_set_points(log, kElbow, silent, again).size(), 0U) << "it is still told something";
  EXPECT_EQ(told(0xFC, 3, silent, again), 0U);
  // Off it gives no torque at all, as its own motor truly knows.
  for (const TruthLine& line : log.truth) {
    if (line.time <= silent || line.time >= again) continue;
    ASSERT_NEAR(line.arm_Nm.at(kElbow), 0, 1e-6) << "at " << seconds(line.time);
  }
  const double fell = arm_at(log, kElbow, silent) - arm_at(log, kElbow, silent + 1s);
  figure("elbow, let go: fell in 1 s", fell, "rad");
  EXPECT_NEAR(arm_at(log, kElbow, silent + 1s), -0.6, 0.03) << "it does not lie on its stop";
}

/// Of a group it is what the joint that does the most does.
TEST_F(ArmSilence, TellsThatNobodyHasItAndThatItHolds) {
  const auto arm = asked_status(log).at("groups").at(0);
  EXPECT_EQ(arm.at("owner"), "nobody");
  EXPECT_EQ(arm.at("state"), "holding");
}

TEST_F(ArmSilence, FollowsTheNextStreamWithAllOfThem) {
  const Time there = log.event("event commands_end#2");
  EXPECT_NEAR(arm_at(log, kBaseYaw, there), 0.3, 0.02);
  EXPECT_NEAR(arm_at(log, kShoulder, there), 1.0, 0.03);
  EXPECT_NEAR(arm_at(log, kElbow, there), 0.4, 0.03);
  EXPECT_GE(told(0xFC, 3, again, there), 1U);
}

TEST_F(ArmSilence, TheTaskEndsAtItsGoal) {
  expect_good_drive(log);
}

}  // namespace
}  // namespace drover::mission
