#include "engine/health/latch.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace drover::engine {
namespace {

using Source = RequestId::Source;

struct ALatch : ::testing::Test {
  ALatch() { health.ready = true; }
  std::string refuses(Source by = Source::mqtt) {
    return std::string(latch
                           .refuses({.by = by,
                                     .runs_away = runs_away,
                                     .moves = moves,
                                     .turns = turns,
                                     .task_active = task_active,
                                     .at_rest = at_rest,
                                     .health = health})
                           .view());
  }
  /// The program died and is back.
  void restart() {
    Remembered left;
    latch.remember(left);
    latch = {};
    latch.recall(left);
  }

  Latch latch;
  HealthReport health;
  Reason runs_away;
  bool moves = false;
  bool turns = false;
  bool task_active = false;
  bool at_rest = true;
};

TEST_F(ALatch, HoldsNothingAtFirst) {
  EXPECT_TRUE(latch.why().empty());
  EXPECT_TRUE(latch.hinders_all().empty());
  EXPECT_TRUE(latch.hinders_joints().empty());
  EXPECT_FALSE(latch.power_cut());
  EXPECT_EQ(refuses(), "");
}
TEST_F(ALatch, TellsAFailedTaskUntilAnythingBeginsAndHindersNothing) {
  for (const Act act : {Act::begin, Act::cancel, Act::reset}) {
    latch.set(Latched::task_failed, "left the corridor");
    EXPECT_EQ(latch.why(), "left the corridor");
    EXPECT_TRUE(latch.hinders_all().empty());
    EXPECT_TRUE(latch.hinders_joints().empty());
    latch.reset(act);
    EXPECT_TRUE(latch.why().empty());
  }
}
TEST_F(ALatch, LetsJointCommandsWaitUntilAPersonActs) {
  for (const Act act : {Act::take, Act::cancel, Act::reset}) {
    latch.set(Latched::stream_stopped, "bumper touched");
    latch.reset(Act::begin);
    EXPECT_EQ(latch.hinders_joints(), "reset the stop first: bumper touched");
    EXPECT_TRUE(latch.hinders_all().empty()) << "a task may begin: it is a person's act";
    latch.reset(act);
    EXPECT_TRUE(latch.why().empty());
  }
}
TEST_F(ALatch, EndsAStopByAResetOnly) {
  for (const Latched what : {Latched::asked, Latched::ran_away, Latched::did_not_stop}) {
    latch.set(what, "a stop");
    for (const Act act : {Act::begin, Act::take, Act::cancel}) latch.reset(act);
    EXPECT_EQ(latch.hinders_all(), "reset the stop first: a stop");
    latch.reset(Act::reset);
    EXPECT_TRUE(latch.why().empty());
    EXPECT_FALSE(latch.ran_away() || latch.power_cut());
  }
}
TEST_F(ALatch, TellsTheGravestFirst) {
  latch.set(Latched::stream_stopped, "bumper touched");
  latch.set(Latched::task_failed, "left the corridor");
  EXPECT_EQ(latch.why(), "left the corridor");
  latch.set(Latched::asked, "emergency stop");
  EXPECT_EQ(latch.why(), "emergency stop");
}
TEST_F(ALatch, KeepsWhatWasToldFirstOfAWheelThatRunsAway) {
  latch.set(Latched::ran_away, "2.0 m/s too fast");
  latch.set(Latched::ran_away, "2.1 m/s too fast");
  EXPECT_EQ(latch.stop(), "2.0 m/s too fast");
  EXPECT_TRUE(latch.ran_away());
}
TEST_F(ALatch, TakesNothingBackForAStopThatIsLessGrave) {
  latch.set(Latched::did_not_stop, "the robot did not stop");
  latch.set(Latched::asked, "emergency stop");
  EXPECT_TRUE(latch.power_cut());
  latch.recall([&] {
    Remembered left;
    latch.remember(left);
    return left;
  }());
  EXPECT_EQ(refuses(Source::internal), "this stop is reset at the robot: drover reset");
}
TEST_F(ALatch, RefusesAResetWhileTheCausePersistsOrTheRobotMoves) {
  at_rest = false;
  EXPECT_EQ(refuses(), "the robot is still stopping");
  at_rest = true;
  health.stop = health.stop_but_guard = "e-stop pressed";
  EXPECT_EQ(refuses(), "e-stop pressed");
  health.stop.clear();
  health.stop_but_guard.clear();
  task_active = true;
  EXPECT_EQ(refuses(), "a task runs: cancel it first");
  health.ready = false;
  EXPECT_EQ(refuses(), "the gateway has just started");
  runs_away = "wheel a runs away";
  EXPECT_EQ(refuses(), "wheel a runs away");
}
TEST_F(ALatch, RefusesTheResetOfAStopWhileTheWheelsTurnOrAnythingElseMovesTheRobot) {
  turns = true;
  EXPECT_EQ(refuses(), "") << "no stop is latched";
  latch.set(Latched::asked, "emergency stop");
  EXPECT_EQ(refuses(), "the robot still moves");
  turns = false;
  health.causes = bit(Cause::moved);
  health.texts[static_cast<std::size_t>(Cause::moved)] = "the robot is pushed or carried";
  EXPECT_EQ(refuses(), "the robot is pushed or carried");
  health.causes = 0;
  moves = true;
  EXPECT_EQ(refuses(), "") << "where only a receiver says so";
}
TEST_F(ALatch, GivesPowerBackAtTheRobotOnlyAndNotWhileItMoves) {
  latch.set(Latched::did_not_stop, "the robot did not stop");
  EXPECT_EQ(refuses(Source::mqtt), "the power was cut: reset it at the robot");
  EXPECT_EQ(refuses(Source::aimrt), "the power was cut: reset it at the robot");
  moves = true;
  EXPECT_EQ(refuses(Source::cli), "the robot still moves");
  moves = false;
  EXPECT_EQ(refuses(Source::cli), "");
}
TEST_F(ALatch, OutlivesTheProgramButForHowItsTaskEnded) {
  latch.set(Latched::task_failed, "left the corridor");
  latch.set(Latched::stream_stopped, "bumper touched");
  latch.set(Latched::did_not_stop, "the robot did not stop");
  restart();
  EXPECT_EQ(latch.stop(), "the robot did not stop");
  EXPECT_EQ(latch.hinders_joints(), "reset the stop first: bumper touched");
  EXPECT_TRUE(latch.power_cut());
  EXPECT_TRUE(latch.task().empty());
  EXPECT_EQ(refuses(Source::internal), "this stop is reset at the robot: drover reset");
}

TEST_F(ALatch, KnowsOverARestartThatAWheelRanAwayUntilAReset) {
  latch.set(Latched::ran_away, "wheel a runs away");
  restart();
  EXPECT_TRUE(latch.ran_away());
  latch.set(Latched::asked, "emergency stop");
  restart();
  EXPECT_TRUE(latch.ran_away()) << "a stop that is less grave takes nothing back";
  latch.reset(Act::reset);
  restart();
  EXPECT_FALSE(latch.ran_away());
}

}  // namespace
}  // namespace drover::engine
