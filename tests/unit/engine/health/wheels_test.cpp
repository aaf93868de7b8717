#include "engine/health/wheels.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace drover::engine {
namespace {

using ::testing::HasSubstr;

/// Four wheels that do what a test says.
class AWheelMonitor : public ::testing::Test {
 protected:
  AWheelMonitor() {
    for (std::size_t i = 0; i < 4; ++i) {
      axes[i].joint = std::string_view("abcd").substr(i, 1);
      axes[i].state = AxisState::running;
      axes[i].motion.position_rad = 100;
      axes[i].motion.velocity_radps = 0;
    }
  }
  void command(double radps) {
    for (AxisSnapshot& axis : axes) axis.commanded_velocity_radps = radps;
  }
  /// Wheel i moves with share[i] of its command. Returns the time of the first fault, or 0.
  double run_s(double seconds, std::array<double, 4> share) {
    for (int i = 1; i <= static_cast<int>(seconds * 200 + 0.5); ++i) {
      for (std::size_t k = 0; k < 4; ++k) {
        axes[k].motion.velocity_radps = share[k] * axes[k].commanded_velocity_radps;
        if (k != stuck) axes[k].motion.position_rad += axes[k].motion.velocity_radps * 0.005;
        if (k == speechless) axes[k].motion.velocity_radps = kAbsent;
      }
      step();
      if (fault != WheelFault::none) return i * 0.005;
    }
    return 0;
  }
  void step() {
    now += std::chrono::milliseconds(5);
    for (AxisSnapshot& axis : axes) axis.last_motion = now;
    fault = monitor.update(now, std::chrono::milliseconds(5), axes);
  }
  /// All wheels turn at `radps` at first and slow down by `falls_radps2`, whatever is commanded.
  double turn_s(double seconds, double radps, double falls_radps2 = 0) {
    for (int i = 1; i <= static_cast<int>(seconds * 200 + 0.5); ++i) {
      const double speed_radps = std::max(radps - i * 0.005 * falls_radps2, 0.0);
      for (AxisSnapshot& axis : axes) {
        axis.motion.velocity_radps = speed_radps;
        axis.motion.position_rad += speed_radps * 0.005;
      }
      step();
      if (fault != WheelFault::none) return i * 0.005;
    }
    return 0;
  }
  /// The drives let go while the wheels turn by `mps` at the rim, and run again.
  void switch_on_at(double mps) {
    for (AxisSnapshot& axis : axes) axis.state = AxisState::idle;
    turn_s(0.1, mps / config.base.wheel_radius_m);
    for (AxisSnapshot& axis : axes) axis.state = AxisState::running;
    step();
  }
  /// Nothing is heard of the drives.
  void be_silent_s(double seconds) {
    for (int i = 0; i < static_cast<int>(seconds * 200 + 0.5) && fault == WheelFault::none; ++i) {
      now += std::chrono::milliseconds(5);
      fault = monitor.update(now, std::chrono::milliseconds(5), axes);
    }
  }
  /// Caught at `mps`: the command falls to zero, the wheels by `falls_mps2`.
  double catch_s(double seconds, double mps, double falls_mps2) {
    switch_on_at(mps);
    const double radius_m = config.base.wheel_radius_m;
    for (int i = 1; i <= static_cast<int>(seconds * 200 + 0.5); ++i) {
      command(std::max(mps - i * 0.005 * kRampDown_mps2, 0.0) / radius_m);
      if (turn_s(0.005, std::max(mps - i * 0.005 * falls_mps2, 0.0) / radius_m) > 0)
        return i * 0.005;
    }
    return 0;
  }
  std::string reason() { return std::string(monitor.reason().view()); }

  static constexpr double kRampDown_mps2 = 0.8;
  EngineConfig config;
  WheelMonitor monitor{config};
  std::array<AxisSnapshot, 4> axes{};
  std::size_t stuck = 99;       ///< this wheel's position does not move
  std::size_t speechless = 99;  ///< this wheel reports no velocity
  Time now{std::chrono::seconds(9)};
  WheelFault fault = WheelFault::none;
};

TEST_F(AWheelMonitor, FindsAWheelThatDoesNotFollowWithinHalfASecond) {
  command(3);
  EXPECT_EQ(run_s(2, {1, 1, 1, 1}), 0);
  const double found_s = run_s(2, {1, 1, 0, 1});
  EXPECT_GT(found_s, 0.2);
  EXPECT_LE(found_s, 0.5);
  EXPECT_EQ(fault, WheelFault::not_following);
  EXPECT_EQ(reason(), "wheel c does not follow its command");
}
TEST_F(AWheelMonitor, FindsAWheelThatTurnsTheWrongWay) {
  command(3);
  EXPECT_GT(run_s(1, {1, 1, 1, -1}), 0);
  EXPECT_THAT(reason(), HasSubstr("wheel d"));
}
TEST_F(AWheelMonitor, GivesTyresThatWereWoundUpTheWayToUnwind) {
  command(0.05 / config.base.wheel_radius_m);
  EXPECT_EQ(run_s(1.0, {1, 1, 0, 0}), 0);
  EXPECT_EQ(run_s(0.9, {1, 1, -0.3, -0.3}), 0);
  EXPECT_EQ(run_s(5, {1, 1, 1, 1}), 0);
}
TEST_F(AWheelMonitor, FindsASlowWheelThatDoesNotFollowBeforeTheRobotWentFifteenCentimetres) {
  for (const double share : {0.0, -0.3, -1.0}) {
    monitor.reset();
    command(0.05 / config.base.wheel_radius_m);
    run_s(1, {1, 1, 1, 1});
    const double found_s = run_s(5, {1, 1, share, 1});
    EXPECT_GT(found_s, 0) << share;
    EXPECT_LE(found_s * 0.05, 0.15) << share;
    EXPECT_EQ(fault, WheelFault::not_following) << share;
  }
}
TEST_F(AWheelMonitor, GivesNoMoreTimeToAFastWheelThanToldInTheConfiguration) {
  command(0.5 / config.base.wheel_radius_m);
  run_s(1, {1, 1, 1, 1});
  EXPECT_NEAR(run_s(5, {1, 1, 0, 1}), config.health.follow_timeout_s, 0.11);
}
TEST_F(AWheelMonitor, FindsThatAllWheelsAreBlockedAfterTheTimeOut) {
  command(3);
  run_s(1, {1, 1, 1, 1});
  EXPECT_NEAR(run_s(5, {0, 0, 0, 0}), 2.0, 0.1);
  EXPECT_EQ(fault, WheelFault::blocked);
  EXPECT_THAT(reason(), HasSubstr("blocked: the wheels do not move for"));
}
TEST_F(AWheelMonitor, SaysOfWheelsThatTurnByAnotherMeasureThatTheyDo) {
  command(3);
  EXPECT_NEAR(run_s(5, {0.125, 0.125, 0.125, 0.125}), 2.0, 0.1);
  EXPECT_THAT(reason(), HasSubstr("the wheels made +12 % of what was commanded for 2.0 s"));
  EXPECT_THAT(reason(), HasSubstr("units or its direction"));
  monitor.reset();
  run_s(1, {1, 1, 1, 1});
  EXPECT_NEAR(run_s(5, {-1, -1, -1, -1}), 2.0, 0.1);
  EXPECT_THAT(reason(), HasSubstr("made -100 %"));
}
TEST_F(AWheelMonitor, FindsBlockedWheelsAlsoAtTheStartOfAMotion) {
  command(-1);
  EXPECT_NEAR(run_s(5, {0, 0, 0, 0}), 2.0, 0.1);
}
TEST_F(AWheelMonitor, IsNotFooledByAVelocityThatRunsOnWhileThePositionIsStuck) {
  command(3);
  stuck = 1;
  EXPECT_GT(run_s(1, {1, 1, 1, 1}), 0);
  EXPECT_EQ(fault, WheelFault::not_following);
  EXPECT_THAT(reason(), HasSubstr("wheel b"));
}
TEST_F(AWheelMonitor, DoesNotMindALagALoadOrASlowWheel) {
  command(3);
  EXPECT_EQ(run_s(0.2, {0, 0, 0, 0}), 0);
  EXPECT_EQ(run_s(5, {0.3, 1, 0.5, 1.2}), 0);
}
TEST_F(AWheelMonitor, DoesNotJudgeCommandsBelowFivePerCent) {
  command(0.2);
  EXPECT_EQ(run_s(10, {0, 0, 0, 0}), 0);
  command(0);
  EXPECT_EQ(run_s(10, {0, 0, 0, 0}), 0);
}
TEST_F(AWheelMonitor, JudgesADriveWithoutAPositionByItsVelocity) {
  command(3);
  axes[0].motion.position_rad = kAbsent;
  EXPECT_EQ(run_s(3, {1, 1, 1, 1}), 0);
  EXPECT_GT(run_s(3, {0, 1, 1, 1}), 0);
  EXPECT_THAT(reason(), HasSubstr("wheel a"));
}
TEST_F(AWheelMonitor, TakesADriveThatSaysNothingForStanding) {
  command(3);
  axes[0].motion.position_rad = kAbsent;
  speechless = 0;
  EXPECT_GT(run_s(3, {1, 1, 1, 1}), 0);
  EXPECT_THAT(reason(), HasSubstr("wheel a"));
}
TEST_F(AWheelMonitor, FindsAWheelThatRunsAway) {
  command(0);
  axes[2].motion.velocity_radps = 20;
  double found_s = 0;
  for (int i = 1; i < 100 && found_s == 0; ++i) {
    now += std::chrono::milliseconds(5);
    if (monitor.update(now, std::chrono::milliseconds(5), axes) == WheelFault::runaway) {
      found_s = i * 0.005;
    }
  }
  EXPECT_GT(found_s, 0.05);
  EXPECT_LE(found_s, 0.2);
  EXPECT_THAT(reason(), HasSubstr("wheel c runs away"));
}
TEST_F(AWheelMonitor, FindsAWheelThatTurnsThoughNobodyDrives) {
  turn_s(1, 0);
  axes[1].motion.velocity_radps = -3;
  int cycles = 0;
  for (; cycles < 100 && fault == WheelFault::none; ++cycles) step();
  EXPECT_GT(cycles, 15);
  EXPECT_LE(cycles, 40);
  EXPECT_EQ(fault, WheelFault::runaway);
  EXPECT_EQ(reason(), "wheel b turns by itself: -3.0 rad/s, commanded 0.0");
}
TEST_F(AWheelMonitor, FindsAWheelThatIsMuchFasterThanItsCommand) {
  command(2);
  EXPECT_EQ(run_s(2, {1, 1.3, 1, 1}), 0);
  const double found_s = run_s(1, {1, 1, 1, 2});
  EXPECT_GT(found_s, 0);
  EXPECT_LE(found_s, 0.2);
  EXPECT_EQ(reason(), "wheel d turns by itself: 4.0 rad/s, commanded 2.0");
}
TEST_F(AWheelMonitor, FindsAWheelThatGoesOnAfterItsCommandEnded) {
  command(4);
  run_s(1, {1, 1, 1, 1});
  command(0);
  const double found_s = turn_s(3, 4);
  EXPECT_GT(found_s, 0.5) << "a stop takes its time";
  EXPECT_LE(found_s, 1.2);
}
TEST_F(AWheelMonitor, DoesNotMindAWheelThatStopsWithADelayAndTheDeceleration) {
  command(4.8);
  run_s(1, {1, 1, 1, 1});
  command(0);
  EXPECT_EQ(turn_s(0.3, 4.8), 0);
  EXPECT_EQ(turn_s(3, 4.8, 0.8 / 0.165), 0);
}
TEST_F(AWheelMonitor, BeginsWithTheSpeedThatItFinds) {
  EXPECT_EQ(turn_s(3, 4, 0.8 / 0.165), 0) << "the guard is slowing it down";
  now += std::chrono::milliseconds(300);
  monitor.update(now, std::chrono::milliseconds(50), axes);
  EXPECT_EQ(turn_s(3, 4, 0.8 / 0.165), 0) << "after a silence";
  EXPECT_GT(turn_s(3, 4), 0) << "but it has to come to rest";
}
TEST_F(AWheelMonitor, BeginsWithTheSpeedOfARobotThatIsPushedWhenItsDrivesAreSwitchedOn) {
  for (AxisSnapshot& axis : axes) axis.state = AxisState::idle;
  EXPECT_EQ(turn_s(2, 4), 0);
  for (AxisSnapshot& axis : axes) axis.state = AxisState::running;
  EXPECT_EQ(turn_s(2, 4, 0.8 / 0.165), 0);
}
TEST_F(AWheelMonitor, LetsAWheelBeCaughtFasterThanAnyCommandMayBe) {
  EXPECT_EQ(catch_s(5, 2.4, kRampDown_mps2), 0) << reason();
}
TEST_F(AWheelMonitor, FindsACaughtWheelThatSpeedsUp) {
  const double found_s = catch_s(3, 2.4, -4);
  EXPECT_GT(found_s, 0.05);
  EXPECT_LE(found_s, 0.3);
  EXPECT_THAT(reason(), HasSubstr("wheel a runs away"));
}
TEST_F(AWheelMonitor, FindsACaughtWheelThatIsFasterAfterASilence) {
  const double limit_mps = max_rim_mps(kinematics_of(config.base), config.limits, {2.5}) + 0.3;
  const double radius_m = config.base.wheel_radius_m;
  switch_on_at(limit_mps + 1);
  ASSERT_EQ(turn_s(0.1, (limit_mps + 1) / radius_m), 0) << reason();
  be_silent_s(0.2);
  ASSERT_EQ(fault, WheelFault::none) << reason();
  const double found_s = turn_s(0.2, (limit_mps + 2) / radius_m);
  EXPECT_GT(found_s, 0);
  EXPECT_THAT(reason(), HasSubstr("wheel a runs away"));
}
TEST_F(AWheelMonitor, LetsACaughtWheelBeSilentWhileItSlowsDown) {
  const double radius_m = config.base.wheel_radius_m;
  switch_on_at(2.4);
  ASSERT_EQ(turn_s(0.1, 2.4 / radius_m), 0) << reason();
  be_silent_s(2);
  ASSERT_EQ(fault, WheelFault::none) << "no speed of a silent drive is believed: " << reason();
  EXPECT_EQ(turn_s(1, 1.5 / radius_m, kRampDown_mps2 / radius_m), 0) << reason();
}
TEST_F(AWheelMonitor, FindsACaughtWheelThatDoesNotSlowDown) {
  const double found_s = catch_s(5, 2.4, 0);
  EXPECT_GT(found_s, 0.5);
  EXPECT_LE(found_s, 1.2);
}
TEST_F(AWheelMonitor, FindsAWheelThatRunsAwayAgainAfterItWasCaught) {
  ASSERT_EQ(catch_s(2, 2.4, kRampDown_mps2), 0);
  command(0);
  const double found_s = turn_s(1, 2.4 / 0.165);
  EXPECT_GT(found_s, 0);
  EXPECT_LE(found_s, 0.15);
}
TEST_F(AWheelMonitor, LetsNoWheelBeFasterThatWasNotRollingWhenItsDriveWasSwitchedOn) {
  switch_on_at(0.5);
  const double found_s = turn_s(1, 2.4 / 0.165);
  EXPECT_GT(found_s, 0);
  EXPECT_LE(found_s, 0.15);
}
TEST_F(AWheelMonitor, BelievesNoSpeedOfASilentDrive) {
  command(4);
  run_s(1, {1, 1, 1, 1});
  command(0);
  for (int i = 0; i < 600; ++i) {
    now += std::chrono::milliseconds(5);
    ASSERT_EQ(monitor.update(now, std::chrono::milliseconds(5), axes), WheelFault::none);
  }
}
TEST_F(AWheelMonitor, DoesNotMindAnIdleRobotThatIsPushed) {
  axes[2].motion.velocity_radps = 20;
  axes[2].state = AxisState::idle;
  for (int i = 0; i < 100; ++i) {
    now += std::chrono::milliseconds(5);
    ASSERT_EQ(monitor.update(now, std::chrono::milliseconds(5), axes), WheelFault::none);
  }
}

}  // namespace
}  // namespace drover::engine
