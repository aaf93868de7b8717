// The speed loop of one motor by itself: bytes in, a current out.
#include "drivers/robomaster_c620/motor.h"

#include <gtest/gtest.h>

#include <cmath>

namespace drover::robomaster {
namespace {

using std::chrono::milliseconds;

Settings settings_with(double gain = 3) {
  Options options(option_table());
  options.set("velocity_gain_Nms_per_rad", gain);
  return read_settings(options);
}

/// A motor that is told what it shows, 5 ms apart.
class RobomasterMotor : public testing::Test {
 protected:
  void show(int rpm, std::uint16_t angle = 0, std::uint8_t degC = 25, double current_A = 0) {
    now += milliseconds(5);
    const auto current = static_cast<std::int16_t>(current_A * settings.counts_per_A);
    motor.on_feedback({angle, static_cast<std::int16_t>(rpm), current, degC}, now);
  }
  /// It turns a little slower than it should, and tells this current: how long until it is torn.
  int cycles_until_torn(double current_A, int most = 400) {
    for (int i = 0; i < most; ++i) {
      show(static_cast<int>(1.95 / kRadpsPerRpm * settings.gear_ratio),
           static_cast<std::uint16_t>(1000 + 3000 * (i % 2)), 25, current_A);
      follow(2);
      if (motor.is_torn()) return i;
    }
    return most;
  }
  void follow(double radps) { motor.follow(radps, milliseconds(5), now); }
  void brake(double radps = 0) { motor.brake(radps, milliseconds(5), now); }
  int limit_counts() const {
    return static_cast<int>(settings.limit_Nm / settings.Nm_per_A * settings.counts_per_A);
  }

  const Settings settings = settings_with();
  Motor motor{settings, 0};
  Time now{std::chrono::seconds(1)};
};

TEST_F(RobomasterMotor, CountsTheTurnsOfItsRotorByTheSpeedThatItTells) {
  // 9000 rpm are 1.5 turns in 10 ms: the angle alone would tell of half a turn.
  show(9000);
  now += milliseconds(5);
  show(9000, 4096);
  EXPECT_NEAR(motor.position_rad(), 1.5 * kTurn_rad / settings.gear_ratio, 1e-9);
  now += milliseconds(5);
  show(9000, 0);
  EXPECT_NEAR(motor.position_rad(), 3 * kTurn_rad / settings.gear_ratio, 1e-9);
}

TEST_F(RobomasterMotor, GoesOnFromWhereItWasAfterASilence) {
  show(0, 100);
  show(0, 200);
  const double before_rad = motor.position_rad();
  now += milliseconds(500);
  show(0, 5000);
  EXPECT_EQ(motor.position_rad(), before_rad);
}

TEST_F(RobomasterMotor, RampsToWhatItIsTold) {
  show(0);
  follow(10);
  // 60 rad/s² for 5 ms: 0.3 rad/s of 10. And friction at once: 0.15 A.
  const double torque_Nm = (3 + 25 * 0.005) * 0.3 + 0.15 * settings.Nm_per_A;
  EXPECT_NEAR(motor.counts(), torque_Nm / settings.Nm_per_A * settings.counts_per_A, 2);
}

TEST_F(RobomasterMotor, AsksForNoMoreThanItsLimitAndAddsNothingUpThere) {
  for (int i = 0; i < 1000; ++i) {
    show(0);
    follow(20);  // it is blocked
  }
  EXPECT_EQ(motor.counts(), limit_counts());
  // Free again, and as fast as it should be: it does not go on pushing for long.
  int pushed = 0;
  for (int i = 0; i < 100; ++i) {
    show(static_cast<int>(25 / kRadpsPerRpm * settings.gear_ratio));
    follow(20);
    pushed += motor.counts() > 0 ? 1 : 0;
  }
  EXPECT_LT(pushed, 40) << "5 ms each";
}

TEST_F(RobomasterMotor, IsStuckWhenItTellsTheSameAngleHoweverHardItIsPushed) {
  int cycles = 0;
  for (; cycles < 100 && !motor.is_stuck(); ++cycles) {
    show(0, 77);
    follow(9);
  }
  EXPECT_GT(cycles, 30) << "a wheel has a moment to break away";
  EXPECT_LT(cycles, 45) << "5 ms each";
  show(0, 78);
  EXPECT_FALSE(motor.is_stuck());
}

TEST_F(RobomasterMotor, IsNotStuckWhileItIsPushedLittleOrStandsOrGivesByAPartOfATurn) {
  for (int i = 0; i < 400; ++i) {
    show(0, 77);
    follow(0.004);
    ASSERT_FALSE(motor.is_stuck()) << "it is hardly pushed";
    if (motor.counts() > 300) break;
  }
  motor.coast();
  for (int i = 0; i < 400; ++i) {
    show(0, 77);
    brake();
    ASSERT_FALSE(motor.is_stuck()) << "it is to stand";
  }
  for (int i = 0; i < 400; ++i) {
    show(0, static_cast<std::uint16_t>(77 + i / 20 % 2));
    follow(9);
    ASSERT_FALSE(motor.is_stuck()) << "a wheel that is blocked";
  }
}

TEST_F(RobomasterMotor, IsTornWhenItIsAskedForACurrentForAThirdOfASecondAndHasNone) {
  show(0, 0, 25, 1);
  const int cycles = cycles_until_torn(0);
  EXPECT_GT(cycles, 60) << "5 ms each";
  EXPECT_LT(cycles, 80);
}

TEST_F(RobomasterMotor, IsNotTornWhileItHasWhatTurnsIt) {
  show(0, 0, 25, 1);
  EXPECT_EQ(cycles_until_torn(0.1), 400) << "its running friction is 0.15 A";
}

TEST_F(RobomasterMotor, IsNotTornWhereNoMotorEverToldACurrent) {
  EXPECT_EQ(cycles_until_torn(0), 400);
  motor.expect_current();  // another one did
  EXPECT_LT(cycles_until_torn(0), 80);
}

TEST_F(RobomasterMotor, IsNotTornWhileLittleIsAskedOfItOrForAMoment) {
  show(0, 0, 25, 1);
  const int rpm = static_cast<int>(2 / kRadpsPerRpm * settings.gear_ratio);
  for (int i = 0; i < 400; ++i) {
    const bool behind = motor.counts() > settings.friction_Nm / settings.Nm_per_A * 820;
    show(behind ? rpm + 1 : rpm, static_cast<std::uint16_t>(1000 + 3000 * (i % 2)));
    follow(2);  // as fast as it should be: its friction is all that is asked for
    ASSERT_FALSE(motor.is_torn());
  }
  for (int i = 0; i < 10; ++i) {
    ASSERT_EQ(cycles_until_torn(0, 50), 50);
    show(rpm, 0, 25, 0.3);
    follow(2);
  }
}

TEST_F(RobomasterMotor, IsTriedAgainWhenItBeginsAnew) {
  show(0, 0, 25, 1);
  ASSERT_LT(cycles_until_torn(0), 80);
  motor.begin_anew();
  EXPECT_FALSE(motor.is_torn());
  EXPECT_GT(cycles_until_torn(0), 50);
}

TEST_F(RobomasterMotor, BrakesByARampAndNeverTheOtherWay) {
  const int rpm = static_cast<int>(5 / kRadpsPerRpm * settings.gear_ratio);
  show(rpm);
  brake();
  EXPECT_LT(motor.counts(), 0);
  const int first = motor.counts();
  show(rpm);
  brake();
  EXPECT_LT(motor.counts(), first) << "the ramp goes on";
  show(0);
  brake();
  EXPECT_EQ(motor.counts(), 0) << "at rest there is nothing to brake";
}

TEST_F(RobomasterMotor, IsKeptWhereItCameToRest) {
  show(0, 1000);
  brake();
  EXPECT_EQ(motor.counts(), 0);
  show(60, 1000 + 4000);  // pushed ahead by half a turn of the rotor
  brake();
  EXPECT_LT(motor.counts(), 0);
  show(0, 1000 + 4000);
  brake();
  EXPECT_LT(motor.counts(), 0) << "it stands, and not where it stood";
}

TEST_F(RobomasterMotor, IsNotPulledBackToWhereItWasStillRolling) {
  // It slows for half a second, until friction ends it: a heavy robot, and a soft loop.
  double joint_rad = 0;
  double radps = 1;
  const auto show_joint = [&] {
    const double rotor_turns = joint_rad * settings.gear_ratio / kTurn_rad;
    const double part = rotor_turns - std::floor(rotor_turns);
    show(static_cast<int>(std::lround(radps / kRadpsPerRpm * settings.gear_ratio)),
         static_cast<std::uint16_t>(part * kAnglesPerTurn));
  };
  for (; radps > 0.09; radps *= 0.98) {
    show_joint();
    brake();
    joint_rad += radps * 0.005;
  }
  radps = 0;
  show_joint();
  brake();
  EXPECT_EQ(motor.counts(), 0)
      << "it is kept where it rests, not where it was 0.3 s after the stop";
}

TEST_F(RobomasterMotor, IsKeptWhereASlopeRollsItSteadily) {
  const int rpm = static_cast<int>(0.5 / kRadpsPerRpm * settings.gear_ratio);
  std::uint16_t angle = 0;
  const auto roll_for = [&](int cycles) {
    for (int i = 0; i < cycles; ++i) {
      angle = static_cast<std::uint16_t>(
          (angle + static_cast<int>(rpm / 60.0 * 0.005 * kAnglesPerTurn)) % kAnglesPerTurn);
      show(rpm, angle);
      brake();
    }
    return static_cast<int>(motor.counts());
  };
  roll_for(40);  // the ramp is over
  const int braked = roll_for(1);
  EXPECT_LT(roll_for(100), braked) << "half a second later it pulls back, too";
}

TEST_F(RobomasterMotor, CallsABrakeOnlyWhatIsNoMoreThanOne) {
  const int rpm = static_cast<int>(1 / kRadpsPerRpm * settings.gear_ratio);
  show(rpm);
  brake();
  show(rpm);
  brake();
  const std::int16_t brakes = motor.counts();
  ASSERT_LT(brakes, 0);
  EXPECT_TRUE(motor.is_brake(0, now));
  EXPECT_TRUE(motor.is_brake(brakes, now));
  EXPECT_TRUE(motor.is_brake(static_cast<std::int16_t>(brakes / 2), now));
  EXPECT_FALSE(motor.is_brake(static_cast<std::int16_t>(brakes * 2), now)) << "it would turn back";
  EXPECT_FALSE(motor.is_brake(1, now)) << "along";
  const Time later = now + milliseconds(31);
  EXPECT_FALSE(motor.is_brake(brakes, later)) << "nobody knows whether it turns";
  EXPECT_TRUE(motor.is_brake(0, later));
}

TEST_F(RobomasterMotor, GetsNoCurrentWhileItTellsNothing) {
  show(0);
  follow(1);
  ASSERT_GT(motor.counts(), 0);
  now += milliseconds(31);
  follow(1);
  EXPECT_EQ(motor.counts(), 0);
  show(100);
  brake();
  now += milliseconds(31);
  brake();
  EXPECT_EQ(motor.counts(), 0);
}

TEST_F(RobomasterMotor, GetsLessTheHotterItIs) {
  const auto most_at = [this](std::uint8_t degC) {
    for (int i = 0; i < 400; ++i) {
      show(0, 0, degC);
      follow(20);
    }
    return static_cast<int>(motor.counts());
  };
  EXPECT_EQ(most_at(69), limit_counts());
  EXPECT_NEAR(most_at(80), limit_counts() * (1 - 0.7 * 10 / 15), 2);
  EXPECT_NEAR(most_at(120), limit_counts() * 0.3, 2);
  EXPECT_TRUE(motor.too_hot());
}

TEST(RobomasterSettings, RefusesWhatDoesNotFitTogether) {
  const auto refusal = [](std::string_view name, double value) -> std::string {
    Options options(option_table());
    options.set("velocity_gain_Nms_per_rad", 0.3).set(name, value);
    try {
      static_cast<void>(read_settings(options));
    } catch (const std::exception& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(refusal("current_limit_A", 20.5), "current_limit_A is more than full_scale_A");
  EXPECT_EQ(refusal("hot_degC", 85), "hot_degC is not below too_hot_degC");
  EXPECT_EQ(refusal("blind_s", 0.2), "blind_s is longer than stale_s");
  EXPECT_EQ(refusal("stale_s", 0.4), "stale_s is longer than timeout_s");
  EXPECT_EQ(refusal("current_limit_A", 20), "");
}

}  // namespace
}  // namespace drover::robomaster
