#include "engine/navigate/navigator.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <vector>

namespace drover::engine {
namespace {

using ::testing::HasSubstr;
using How = TaskEnded::How;
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

/// A navigator with everything about it in a test's hands: track along x from 0 to 10 m, the robot
/// at (2, 0) looking along it, all healthy, drives in closed loop.
class ANavigator : public ::testing::Test {
 protected:
  ANavigator() {
    for (int i = 0; i <= 10; ++i) path.points.push_back({1.0 * i, 0});
    path.name = "row";
    health.ready = health.drives_ok = health.drives_running = health.lines_ok = true;
    health.gnss_ok = health.guard_ok = true;
    health.locate = LocateState::good;
    health.budget_used = 0.2;
    estimate.has_position = estimate.has_heading = true;
    estimate.predicted_error_m = 0.03;
    estimate.yaw_error_rad = 0.01;
    estimate.pose.x_m = 2;
  }

  template <class Body>
  std::vector<Body> said() {
    std::vector<Body> all;
    for (const Event& event : log) {
      if (const auto* body = std::get_if<Body>(&event.body)) all.push_back(*body);
    }
    return all;
  }
  void drain() {
    FixedVector<Event, 64> some;
    events.drain(some);
    log.insert(log.end(), some.begin(), some.end());
  }
  RequestId next_id() { return {RequestId::Source::mqtt, ++number}; }
  void start(double speed_mps = 0.5, std::uint32_t target = 10) {
    start_on(&path, target, speed_mps);
  }
  void start_on(const Path* p, std::uint32_t target, double speed_mps) {
    navigator.start(next_id(), {p, target, speed_mps}, now, estimate, has_origin, health, events);
    drain();
  }
  void cancel() {
    navigator.cancel(next_id(), now, events);
    drain();
  }
  NavOutput step() {
    now += std::chrono::milliseconds(5);
    const NavOutput out = navigator.step(
        {now, std::chrono::milliseconds(5), estimate, health, wheels, wheel_reason, at_rest, refusal},
        events);
    const bool moving = out.target.vx_mps != 0 || out.target.wz_radps != 0;
    navigator.on_commanded(now, moving && out.stop == Stop::none, events);
    drain();
    return out;
  }
  NavOutput run_s(double seconds) {
    NavOutput out;
    for (int i = 0; i < static_cast<int>(seconds * 200); ++i) out = step();
    return out;
  }
  void start_and_run() {
    start();
    step();
    ASSERT_EQ(said<NavigationStarted>().size(), 1U);
  }
  NavStatus status() { return navigator.snapshot(health).status; }
  std::string refusal_text() {
    const auto refused = said<CommandRefused>();
    return refused.empty() ? "" : std::string(refused.back().reason.view());
  }
  void expect_failed(const std::string& reason) {
    ASSERT_EQ(said<TaskEnded>().size(), 1U);
    EXPECT_EQ(said<TaskEnded>()[0].how, How::failed);
    EXPECT_THAT(std::string(said<TaskEnded>()[0].reason.view()), HasSubstr(reason));
    EXPECT_EQ(status(), NavStatus::error);
    EXPECT_EQ(said<PathReleased>().size(), 1U);
    EXPECT_THAT(std::string(navigator.latched().view()), HasSubstr(reason));
    EXPECT_FALSE(step().drives);
  }

  EngineConfig config;
  Navigator navigator{config};
  EventQueue events;
  std::vector<Event> log;
  Path path;
  HealthReport health;
  Estimate estimate;
  WheelFault wheels = WheelFault::none;
  Reason wheel_reason;
  bool at_rest = true;
  bool has_origin = true;
  TargetRefusal refusal = TargetRefusal::none;
  Time now{std::chrono::seconds(50)};
  std::uint64_t number = 0;
};

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
  EXPECT_TRUE(navigator.latched().empty());
  run_s(5);
  EXPECT_EQ(status(), NavStatus::success) << "stays until the next command";
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
TEST_F(ANavigator, SlowsDownWhenTheErrorBudgetIsNearlySpent) {
  start_and_run();
  health.budget_used = 1;
  EXPECT_NEAR(run_s(1).target.vx_mps, 0.25, 0.02);
}

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
  EXPECT_TRUE(navigator.latched().empty());
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
  EXPECT_FALSE(navigator.latched().empty());
  navigator.reset_stop(next_id(), now, true, health, events);
  drain();
  EXPECT_TRUE(navigator.latched().empty());
  EXPECT_FALSE(step().drives) << "a reset never starts motion";
  start();
  EXPECT_EQ(status(), NavStatus::run);
}
TEST_F(ANavigator, RefusesAResetWhileTheCausePersistsOrTheRobotMoves) {
  navigator.reset_stop(next_id(), now, false, health, events);
  drain();
  EXPECT_EQ(refusal_text(), "the robot is still stopping");
  health.stop = "e-stop pressed";
  navigator.reset_stop(next_id(), now, true, health, events);
  drain();
  EXPECT_EQ(refusal_text(), "e-stop pressed");
  health.stop.clear();
  start_and_run();
  navigator.reset_stop(next_id(), now, true, health, events);
  drain();
  EXPECT_EQ(refusal_text(), "a task runs: cancel it first");
  health.ready = false;
  navigator.reset_stop(next_id(), now, true, health, events);
  drain();
  EXPECT_EQ(said<CommandRefused>().size(), 4U);
}

}  // namespace
}  // namespace drover::engine
