#include "navigator_fixture.h"

namespace drover::engine {
namespace {

using ::testing::HasSubstr;
using How = TaskEnded::How;
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

// --- refusals ---------------------------------------------------------------------------------

TEST_F(ANavigator, RefusesAMissingTrackAndReturnsNothing) {
  start_on(nullptr, 0, 0.5);
  EXPECT_EQ(refusal_text(), "there is no such track");
  EXPECT_TRUE(said<PathReleased>().empty());
}
TEST_F(ANavigator, RefusesATrackThatCannotBeDrivenAndReturnsIt) {
  Path bad = path;
  bad.points[3].x_m = kNan;
  start_on(&bad, 10, 0.5);
  EXPECT_THAT(refusal_text(), HasSubstr("point 4"));
  ASSERT_EQ(said<PathReleased>().size(), 1U);
  EXPECT_EQ(said<PathReleased>()[0].path, &bad);
}
TEST_F(ANavigator, RefusesATargetOutOfRange) {
  start(0.5, 11);
  EXPECT_THAT(refusal_text(), HasSubstr("no point 12"));
  start(0.5, 0xFFFFFFFFU);
  EXPECT_THAT(refusal_text(), HasSubstr("no point 4294967296"));
}
TEST_F(ANavigator, RefusesASpeedThatIsNone) {
  for (const double bad : {0.0, -1.0, 0.01, kNan}) start(bad);
  EXPECT_EQ(said<CommandRefused>().size(), 4U);
  EXPECT_EQ(said<PathReleased>().size(), 4U);
  EXPECT_EQ(status(), NavStatus::free);
}
TEST_F(ANavigator, RefusesASecondTaskAndLeavesTheFirstAlone) {
  start_and_run();
  const Path second = path;
  start_on(&second, 5, 0.3);
  EXPECT_EQ(refusal_text(), "a task runs already");
  ASSERT_EQ(said<PathReleased>().size(), 1U);
  EXPECT_EQ(said<PathReleased>()[0].path, &second);
  EXPECT_EQ(status(), NavStatus::run);
  EXPECT_EQ(navigator.snapshot(health).target_id, 11U);
}
TEST_F(ANavigator, RefusesWhenTheRobotIsNotFit) {
  health.stop = "wheel a: never heard";
  start();
  EXPECT_EQ(refusal_text(), "wheel a: never heard");
  health.stop.clear();
  has_origin = false;
  start();
  EXPECT_EQ(refusal_text(), "no origin is set");
  has_origin = true;
  health.locate = LocateState::lost;
  start();
  EXPECT_FALSE(refusal_text().empty());
  EXPECT_EQ(said<CommandRefused>().size(), 3U);
  EXPECT_EQ(said<PathReleased>().size(), 3U);
}
TEST_F(ANavigator, RefusesFarFromTheTrackOrBadlyTurned) {
  estimate.pose.y_m = 3;
  start();
  EXPECT_THAT(refusal_text(), HasSubstr("away from the track"));
  estimate.pose.y_m = 0;
  estimate.pose.yaw_rad = 2;
  start();
  EXPECT_THAT(refusal_text(), HasSubstr("turned"));
  EXPECT_FALSE(step().drives);
}
TEST_F(ANavigator, KeepsTheStatusOfTheLastTaskWhenItRefuses) {
  start_and_run();
  health.stop = "bumper touched";
  step();
  start();
  EXPECT_EQ(status(), NavStatus::error);
}

// --- the way to success -----------------------------------------------------------------------

TEST_F(ANavigator, NeverWantsMotionBeforeAStart) {
  for (int i = 0; i < 1000; ++i) {
    const NavOutput out = step();
    ASSERT_FALSE(out.drives);
    ASSERT_EQ(out.target.vx_mps, 0);
  }
  EXPECT_TRUE(log.empty());
}
TEST_F(ANavigator, SaysThatAFastSpeedWasClamped) {
  start(2.0);
  ASSERT_EQ(said<CommandAccepted>().size(), 1U);
  EXPECT_THAT(std::string(said<CommandAccepted>()[0].note.view()), HasSubstr("limited"));
  EXPECT_DOUBLE_EQ(navigator.snapshot(health).asked_speed_mps, 0.8);
}
TEST_F(ANavigator, ArmsFirstAndWantsNoMotionUntilAllDrivesRun) {
  health.drives_running = false;
  start();
  for (int i = 0; i < 100; ++i) {
    const NavOutput out = step();
    ASSERT_TRUE(out.drives);
    ASSERT_EQ(out.target.vx_mps, 0);
  }
  EXPECT_EQ(status(), NavStatus::run);
  EXPECT_TRUE(said<NavigationStarted>().empty());
  health.drives_running = true;
  EXPECT_GT(step().target.vx_mps, 0);
  ASSERT_EQ(said<NavigationStarted>().size(), 1U);
  EXPECT_EQ(said<NavigationStarted>()[0].id.number, said<CommandAccepted>()[0].id.number);
}
TEST_F(ANavigator, EndsInErrorWhenTheDrivesDoNotArmInTime) {
  health.drives_running = false;
  health.not_running = "wheel a: over temperature";
  start();
  run_s(2.9);
  EXPECT_EQ(status(), NavStatus::run);
  run_s(0.2);
  EXPECT_EQ(status(), NavStatus::error);
  ASSERT_EQ(said<NavigationNotStarted>().size(), 1U);
  EXPECT_EQ(said<NavigationNotStarted>()[0].reason, "wheel a: over temperature");
  EXPECT_TRUE(said<TaskEnded>().empty());
  EXPECT_EQ(said<PathReleased>().size(), 1U);
}
TEST_F(ANavigator, SucceedsAtOnceWhereTheGoalIsReachedAlready) {
  health.drives_running = false;
  estimate.pose.x_m = 10;
  start();
  EXPECT_EQ(said<CommandAccepted>().size(), 1U);
  EXPECT_EQ(said<NavigationStarted>().size(), 1U);
  ASSERT_EQ(said<TaskEnded>().size(), 1U);
  EXPECT_EQ(said<TaskEnded>()[0].how, How::success);
  EXPECT_EQ(said<PathReleased>().size(), 1U);
  EXPECT_EQ(status(), NavStatus::success);
  EXPECT_FALSE(step().drives);
}
TEST_F(ANavigator, SucceedsOnlyWhenItRestsAtTheGoal) {
  start_and_run();
  estimate.pose.vx_mps = 0.1;
  at_rest = false;
  for (double x_m = 2; x_m < 9.99; x_m += 0.02) {
    estimate.pose.x_m = x_m;
    step();
  }
  EXPECT_TRUE(said<TaskEnded>().empty());
  EXPECT_EQ(step().target.vx_mps, 0);
  estimate.pose.vx_mps = 0;
  at_rest = true;
  step();
  ASSERT_EQ(said<TaskEnded>().size(), 1U);
  EXPECT_EQ(said<TaskEnded>()[0].how, How::success);
  EXPECT_EQ(status(), NavStatus::success);
  EXPECT_TRUE(latch.why().empty());
  run_s(5);
  EXPECT_EQ(status(), NavStatus::success) << "stays until the next command";
}

TEST_F(ANavigator, GoesOnWhenItCameToRestShortOfTheGoal) {
  start_and_run();
  estimate.pose.vx_mps = 0.1;
  at_rest = false;
  for (double x_m = 2; x_m < 9.99; x_m += 0.02) {
    estimate.pose.x_m = x_m;
    step();
  }
  ASSERT_EQ(step().target.vx_mps, 0);
  estimate.pose.x_m = 9.8;  // rolled back
  estimate.pose.vx_mps = 0;
  at_rest = true;
  step();
  EXPECT_TRUE(said<TaskEnded>().empty());
  EXPECT_GT(step().target.vx_mps, 0);
}

// --- cancel -----------------------------------------------------------------------------------

TEST_F(ANavigator, TakesACancelWhenNothingRunsAsOftenAsItComes) {
  cancel();
  cancel();
  EXPECT_EQ(said<CommandAccepted>().size(), 2U);
  EXPECT_TRUE(said<TaskEnded>().empty());
  EXPECT_EQ(status(), NavStatus::free);
}
TEST_F(ANavigator, StopsForACancelWithARampAndIsFree) {
  start_and_run();
  cancel();
  ASSERT_EQ(said<TaskEnded>().size(), 1U);
  EXPECT_EQ(said<TaskEnded>()[0].how, How::cancelled);
  EXPECT_EQ(status(), NavStatus::free);
  EXPECT_EQ(said<PathReleased>().size(), 1U);
  const NavOutput out = step();
  EXPECT_EQ(out.stop, Stop::controlled);
  EXPECT_FALSE(out.drives);
}
TEST_F(ANavigator, SaysThatACancelledTaskDidNotBegin) {
  health.drives_running = false;
  start();
  cancel();
  EXPECT_EQ(said<NavigationNotStarted>().size(), 1U);
  EXPECT_TRUE(said<TaskEnded>().empty());
  EXPECT_EQ(status(), NavStatus::free);
}
TEST_F(ANavigator, KeepsTheOrderOfAHundredCancelsAndStarts) {
  for (int i = 0; i < 100; ++i) {
    cancel();
    start();
  }
  EXPECT_EQ(status(), NavStatus::run);
  EXPECT_EQ(said<CommandAccepted>().size(), 200U);
  EXPECT_EQ(said<PathReleased>().size(), 99U);
  cancel();
  EXPECT_EQ(status(), NavStatus::free);
  EXPECT_EQ(said<PathReleased>().size(), 100U);
}

// --- pauses -----------------------------------------------------------------------------------

TEST_F(ANavigator, PausesForAnObstacleAndGoesOnASecondAfterItLeft) {
  start_and_run();
  health.near_zone = true;
  NavOutput out = step();
  EXPECT_TRUE(out.drives);
  EXPECT_EQ(out.stop, Stop::controlled);
  EXPECT_TRUE(navigator.snapshot(health).obstacle);
  EXPECT_TRUE(navigator.snapshot(health).paused);
  EXPECT_EQ(status(), NavStatus::run);
  run_s(10);
  health.near_zone = false;
  EXPECT_EQ(run_s(0.95).stop, Stop::controlled);
  out = run_s(0.1);
  EXPECT_EQ(out.stop, Stop::none);
  EXPECT_GT(out.target.vx_mps, 0);
  EXPECT_FALSE(navigator.snapshot(health).obstacle);
  EXPECT_EQ(said<NavigationStarted>().size(), 1U);
}
TEST_F(ANavigator, WaitsAgainWhenTheObstacleComesBackWithinTheSecond) {
  start_and_run();
  for (int i = 0; i < 10; ++i) {
    health.near_zone = true;
    step();
    health.near_zone = false;
    ASSERT_EQ(run_s(0.9).stop, Stop::controlled);
  }
}
TEST_F(ANavigator, FailsWhenTheObstacleStaysTooLong) {
  start_and_run();
  health.near_zone = true;
  run_s(119);
  EXPECT_EQ(status(), NavStatus::run);
  run_s(2);
  expect_failed("obstacle");
  health.near_zone = false;
  run_s(5);
  EXPECT_EQ(status(), NavStatus::error) << "nothing goes on by itself";
}
TEST_F(ANavigator, PausesWhileThePositionIsLostAndGoesOnWhenItIsBack) {
  start_and_run();
  health.locate = LocateState::lost;
  EXPECT_EQ(step().stop, Stop::controlled);
  run_s(30);
  EXPECT_EQ(status(), NavStatus::run);
  health.locate = LocateState::good;
  EXPECT_EQ(run_s(0.9).stop, Stop::controlled);
  EXPECT_EQ(run_s(0.2).stop, Stop::none);
}
TEST_F(ANavigator, FailsWhenThePositionStaysLost) {
  start_and_run();
  health.locate = LocateState::lost;
  run_s(61);
  expect_failed("localisation");
}
TEST_F(ANavigator, SaysNotStartedWhenAnObstacleStoodThereFromTheBeginning) {
  health.near_zone = true;
  start();
  run_s(1);
  EXPECT_TRUE(said<NavigationStarted>().empty());
  EXPECT_TRUE(navigator.snapshot(health).paused);
  run_s(121);
  EXPECT_EQ(said<NavigationNotStarted>().size(), 1U);
  EXPECT_TRUE(said<TaskEnded>().empty());
}

// --- slower -----------------------------------------------------------------------------------

TEST_F(ANavigator, DrivesSlowlyWhileSomebodyIsInTheFarZone) {
  start_and_run();
  estimate.pose.vx_mps = 0.25;
  health.far_zone = true;
  EXPECT_LE(run_s(1).target.vx_mps, 0.25 + 1e-9);
  health.far_zone = false;
  EXPECT_GT(run_s(1).target.vx_mps, 0.3);
}
TEST_F(ANavigator, ReturnsSlowlyAfterAShoveButNotForEver) {
  start_and_run();
  estimate.pose.y_m = 0.2;
  estimate.shoved = now;
  EXPECT_LE(run_s(3).target.vx_mps, 0.2);
  estimate.pose.y_m = 0.07;
  EXPECT_LE(run_s(3).target.vx_mps, 0.2) << "not back yet";
  // It crabs along a slope, say, and never comes nearer.
  EXPECT_GT(run_s(20).target.vx_mps, 0.3);
}
TEST_F(ANavigator, SlowsDownWhenTheErrorBudgetIsNearlySpent) {
  start_and_run();
  health.budget_used = 1;
  EXPECT_NEAR(run_s(1).target.vx_mps, 0.25, 0.02);
}

/// A square of 4 m, driven counter-clockwise, that ends where it began.
Path square() {
  Path loop;
  for (int i = 0; i <= 8; ++i) loop.points.push_back({0.5 * i, 0});
  for (int i = 1; i <= 8; ++i) loop.points.push_back({4, 0.5 * i});
  for (int i = 1; i <= 8; ++i) loop.points.push_back({4 - 0.5 * i, 4});
  for (int i = 1; i <= 8; ++i) loop.points.push_back({0, 4 - 0.5 * i});
  return loop;
}

TEST_F(ANavigator, ReachesTheFirstPointOfAClosedLoopByDrivingOn) {
  const Path loop = square();
  estimate.pose.x_m = 2;
  start_on(&loop, 0, 0.5);
  EXPECT_EQ(refusal_text(), "");
  const auto nav = navigator.snapshot(health);
  EXPECT_EQ(nav.target_id, 1U);
  EXPECT_NEAR(nav.distance_left_m, 14, 0.5);
}
TEST_F(ANavigator, DrivesBackAlongAClosedLoopWhereTheRobotLooksThatWay) {
  const Path loop = square();
  estimate.pose.x_m = 2;
  estimate.pose.yaw_rad = 3.1;
  start_on(&loop, 0, 0.5);
  EXPECT_NEAR(navigator.snapshot(health).distance_left_m, 2, 0.1);
}
TEST_F(ANavigator, DrivesNoLapFromThePointWhereItStands) {
  const Path loop = square();
  estimate.pose.x_m = 0.02;
  start_on(&loop, 0, 0.5);
  EXPECT_EQ(status(), NavStatus::success);
}
TEST_F(ANavigator, DoesNotCloseALoopThatIsOpen) {
  Path loop = square();
  loop.points.pop_back();
  estimate.pose.x_m = 2;
  start_on(&loop, 0, 0.5);
  EXPECT_THAT(refusal_text(),
              ::testing::HasSubstr("turned 180 degrees away from the way to point 1"));
}
TEST_F(ANavigator, TellsAfterAnErrorHowFarItWasFromItsTarget) {
  start_and_run();
  health.end_task = "charger connected";
  step();
  EXPECT_EQ(status(), NavStatus::error);
  EXPECT_NEAR(navigator.snapshot(health).distance_left_m, 8, 0.1);
}

}  // namespace
}  // namespace drover::engine
