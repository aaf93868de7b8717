// A person's word that what was learned of the robot is no longer so.
#include "engine_fixture.h"

namespace drover::engine {
namespace {

using ::testing::HasSubstr;

class APersonWhoChangedAWheel : public AnEngine {
 protected:
  APersonWhoChangedAWheel() { rig.imu = true; }
  void expect_refused(const std::string& reason) {
    const std::size_t before = rig.said<CommandRefused>().size();
    rig.command(ForgetLearned{});
    rig.tick();
    ASSERT_EQ(rig.said<CommandRefused>().size(), before + 1);
    EXPECT_THAT(refusal(), HasSubstr(reason));
    EXPECT_EQ(rig.snapshot().learned.forgotten, 0U);
  }
};

TEST_F(APersonWhoChangedAWheel, IsHeardAtRestAndTheRobotDrivesOn) {
  path = straight_path(20);
  rig.settle();
  const std::size_t before = rig.said<CommandAccepted>().size();
  rig.command(ForgetLearned{});
  rig.run_s(3);
  EXPECT_EQ(rig.said<CommandAccepted>().size(), before + 1) << refusal();
  EXPECT_EQ(rig.snapshot().learned.forgotten, 1U);
  expect_no_motion_for_s(1);
  rig.start(path, 39, 0.5);
  rig.run_s(3);
  EXPECT_GT(rig.fastest_command_radps(), 1) << rig.why() << refusal();
}

TEST_F(APersonWhoChangedAWheel, IsNotHeardWhileATaskRuns) {
  path = straight_path(20);
  rig.settle();
  rig.start(path, 39, 0.5);
  rig.run_s(3);
  expect_refused("a task runs: cancel it first");
}

TEST_F(APersonWhoChangedAWheel, IsNotHeardWhileItRollsOut) {
  path = straight_path(20);
  rig.settle();
  rig.start(path, 39, 0.5);
  rig.run_s(5);
  rig.command(CancelTask{});
  rig.tick();
  expect_refused("the robot moves");
}

TEST_F(APersonWhoChangedAWheel, IsNotHeardWhileThePlaceIsDoubted) {
  path = straight_path(60);
  rig.settle();
  rig.start(path, 119, 0.5);
  rig.run_s(10);
  rig.jump_m += 0.6;  // beyond the corridor
  rig.run_s(65);
  ASSERT_THAT(rig.why(), HasSubstr("position disagrees with odometry"));
  expect_refused("position disagrees with odometry");
}

}  // namespace
}  // namespace drover::engine
