// How tasks fail, and what a person does afterwards.
#include "navigator_fixture.h"

namespace drover::engine {
namespace {

using ::testing::HasSubstr;
using How = TaskEnded::How;
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

// --- failures ---------------------------------------------------------------------------------

TEST_F(ANavigator, StopsAtOnceForWhateverStops) {
  start_and_run();
  health.stop = "e-stop pressed";
  EXPECT_EQ(step().stop, Stop::immediate);
  expect_failed("e-stop pressed");
  health.stop.clear();
  run_s(5);
  EXPECT_EQ(status(), NavStatus::error);
}
TEST_F(ANavigator, StopsAtOnceAlsoWhileItArms) {
  health.drives_running = false;
  start();
  health.stop = "bumper touched";
  EXPECT_EQ(step().stop, Stop::immediate);
  EXPECT_EQ(said<NavigationNotStarted>().size(), 1U);
}
TEST_F(ANavigator, StopsAtOnceWhenADriveLeavesClosedLoop) {
  start_and_run();
  health.drives_running = false;
  health.not_running = "wheel a: the drive is not in closed loop";
  EXPECT_EQ(step().stop, Stop::immediate);
  expect_failed("wheel a");
}
TEST_F(ANavigator, FailsWhenADriveIsLostDuringAPause) {
  start_and_run();
  health.near_zone = true;
  step();
  health.drives_running = false;
  health.not_running = "wheel a: fault";
  step();
  expect_failed("wheel a: fault");
}
TEST_F(ANavigator, FailsWhenTheWheelsAreBlocked) {
  start_and_run();
  wheels = WheelFault::blocked;
  wheel_reason = "blocked: the wheels do not move";
  EXPECT_EQ(step().stop, Stop::immediate);
  wheels = WheelFault::none;
  wheel_reason.clear();
  expect_failed("blocked");
}
TEST_F(ANavigator, FailsWhenItLeavesTheCorridor) {
  start_and_run();
  estimate.pose.y_m = 0.49;
  step();
  EXPECT_EQ(status(), NavStatus::run);
  estimate.pose.y_m = 0.52;
  step();
  expect_failed("corridor");
}
TEST_F(ANavigator, DoesNotMindTheCorridorBeforeItJoinedTheTrack) {
  estimate.pose.y_m = 1.5;
  start();
  run_s(1);
  EXPECT_EQ(status(), NavStatus::run);
}
TEST_F(ANavigator, FailsWhenPositionAndOdometryDisagree) {
  start_and_run();
  estimate.disagrees = true;
  health.locate = LocateState::lost;
  step();
  expect_failed("disagrees");
}
TEST_F(ANavigator, FailsWhenTheEstimateIsNotANumber) {
  start_and_run();
  estimate.pose.x_m = kNan;
  health.locate = LocateState::lost;
  step();
  expect_failed("not a number");
}
TEST_F(ANavigator, FailsWhenTheTargetGateSawNoNumber) {
  start_and_run();
  refusal = TargetRefusal::not_finite;
  step();
  expect_failed("not a number");
}
TEST_F(ANavigator, FailsWhenItPassesTheGoalBesideIt) {
  start_and_run();
  estimate.pose.y_m = 0.3;
  for (double x_m = 2; x_m < 10.2; x_m += 0.02) {
    estimate.pose.x_m = x_m;
    step();
  }
  expect_failed("passed point 11");
}
TEST_F(ANavigator, FailsWhenItDoesNotArrive) {
  start_and_run();
  for (double x_m = 2; x_m < 9.6; x_m += 0.02) {
    estimate.pose.x_m = x_m;
    step();
  }
  run_s(21);
  expect_failed("did not arrive");
}
TEST_F(ANavigator, DoesNotCountAPauseAsCreeping) {
  start_and_run();
  for (double x_m = 2; x_m < 9.6; x_m += 0.02) {
    estimate.pose.x_m = x_m;
    step();
  }
  health.near_zone = true;
  run_s(30);
  EXPECT_EQ(status(), NavStatus::run);
}

// --- what a person does afterwards ------------------------------------------------------------

TEST_F(ANavigator, TakesANewStartOnceTheCauseIsGone) {
  start_and_run();
  health.stop = "bumper touched";
  step();
  start();
  EXPECT_EQ(refusal_text(), "bumper touched");
  health.stop.clear();
  start();
  EXPECT_EQ(status(), NavStatus::run);
  EXPECT_TRUE(latch.why().empty());
  EXPECT_EQ(step().target.vx_mps, 0) << "the drives have yet to hear of it";
  EXPECT_GT(step().target.vx_mps, 0);
}
TEST_F(ANavigator, IsFreeAfterACancelThatFollowsAnError) {
  start_and_run();
  health.stop = "bumper touched";
  step();
  cancel();
  EXPECT_EQ(status(), NavStatus::free);
  EXPECT_EQ(said<TaskEnded>().size(), 1U);
}
TEST_F(ANavigator, LatchesASoftwareStopThatOnlyAResetClears) {
  wheels = WheelFault::runaway;
  wheel_reason = "wheel a runs away";
  EXPECT_EQ(step().stop, Stop::immediate);
  wheels = WheelFault::none;
  wheel_reason.clear();
  start();
  EXPECT_EQ(refusal_text(), "reset the stop first: wheel a runs away");
  cancel();
  latch.reset(Act::cancel);
  EXPECT_FALSE(latch.why().empty());
  ASSERT_EQ(latch.refuses({.task_active = navigator.active(), .health = health}), "");
  latch.reset(Act::reset);
  EXPECT_TRUE(latch.why().empty());
  EXPECT_FALSE(step().drives) << "a reset never starts motion";
  start();
  EXPECT_EQ(status(), NavStatus::run);
}
}  // namespace
}  // namespace drover::engine
