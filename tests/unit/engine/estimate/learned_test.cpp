// What one program learned of the robot, and the next one begins with.
#include "drover/learned.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "unit/engine/estimate/rig.h"

namespace drover::engine::estimate {
namespace {

class LearnedBefore : public ::testing::Test {
 protected:
  static void settle(Rig& rig) {
    rig.yaw_rad = 0;
    rig.world.imu = true;
    rig.stand(5);
  }
  static void drive(Rig& rig, double seconds) {
    for (double driven_s = 0; driven_s < seconds && !rig.last.disagrees;) {
      if (!rig.last.looks.empty()) {
        rig.stand(0.1);
      } else {
        rig.drive(0.5, 0.5, 0.1);
        driven_s += 0.1;
      }
    }
  }
  static void turn_round(Rig& rig) { rig.circle(0.5, 1.5, kPi * 1.5 / 0.5); }
  static void there_and_back(Rig& rig) {
    drive(rig, 50);
    turn_round(rig);
    drive(rig, 50);
  }
  /// Of a robot whose line is mounted so.
  static LearnedValues taught(double off_deg) {
    Rig rig(4);
    rig.world.heading_off_deg = off_deg;
    settle(rig);
    there_and_back(rig);
    return rig.last.learned;
  }
  static LearnedValues mounted(double off_deg, double sigma_deg) {
    LearnedValues learned;
    learned.mounting_rad = {to_rad(off_deg), to_rad(sigma_deg)};
    return learned;
  }
};

TEST_F(LearnedBefore, IsNothingOfARobotThatHasNotDriven) {
  Rig rig(4);
  settle(rig);
  EXPECT_FALSE(rig.last.learned.mounting_rad.known());
  EXPECT_FALSE(rig.last.learned.late_s.known());
  EXPECT_FALSE(rig.last.learned.antenna_ahead_m.known());
  EXPECT_FALSE(rig.last.learned.turn_gain.known());
}

TEST_F(LearnedBefore, TheMountingIsKnownFromTheFirstHeadingOn) {
  for (const double off_deg : {-4.0, 3.0}) {
    const LearnedValues learned = taught(off_deg);
    ASSERT_TRUE(learned.mounting_rad.known()) << off_deg;
    Rig rig(7);
    rig.estimator.recall(learned);
    rig.world.heading_off_deg = off_deg;
    settle(rig);
    EXPECT_TRUE(rig.last.mounting_known);
    EXPECT_NEAR(to_deg(rig.last.mounting_rad), -off_deg, 0.3);
    EXPECT_LT(to_deg(rig.yaw_error_rad()), 0.5);
    drive(rig, 10);
    rig.world.position = rig.world.heading = false;
    rig.forget();
    rig.drive(0.5, 0.5, 30);
    EXPECT_LT(rig.position_error_m(), 0.012 * 15);
    EXPECT_EQ(rig.share_bound(), 1) << off_deg;
  }
}

TEST_F(LearnedBefore, AnOriginIsGivenAfterwards) {
  const LearnedValues learned = taught(3);
  Rig rig(7);
  rig.estimator.recall(learned);
  rig.estimator.set_origin(kField);
  rig.world.heading_off_deg = 3;
  settle(rig);
  EXPECT_TRUE(rig.last.mounting_known);
}

/// A line that was mounted anew meanwhile: neither believed for good nor taken for a drift.
TEST_F(LearnedBefore, AnotherMountingIsNoticedAndLearned) {
  for (const double off_deg : {-3.0, 0.0, 3.0}) {
    Rig rig(5);
    rig.estimator.recall(mounted(3, 0.1));  // crab of -3 degrees: right for an offset of -3
    rig.world.heading_off_deg = off_deg;
    settle(rig);
    ASSERT_TRUE(rig.last.mounting_known);
    rig.forget();
    drive(rig, 30);
    if (off_deg != -3.0) {
      EXPECT_FALSE(rig.last.mounting_known) << off_deg;
    }
    drive(rig, 20);
    turn_round(rig);
    drive(rig, 50);
    turn_round(rig);
    drive(rig, 50);
    EXPECT_FALSE(rig.last.disagrees) << off_deg << ' ' << rig.last.reason.view();
    EXPECT_TRUE(rig.last.mounting_known) << off_deg;
    EXPECT_NEAR(to_deg(rig.last.mounting_rad), -off_deg, 0.4);
    EXPECT_EQ(rig.share_bound(), 1) << off_deg;
  }
}

/// What refutes it ends it at once: who loses the receiver then has a heading that is as uncertain
/// as it is told.
TEST_F(LearnedBefore, AnotherMountingIsGivenUpAtTheFirstLeg) {
  for (const double off_deg : {-2.0, 0.0, 2.0}) {
    Rig rig(5);
    rig.estimator.recall(mounted(off_deg < 0 ? -3 : 3, 0.1));
    rig.world.heading_off_deg = off_deg;
    settle(rig);
    drive(rig, 30);
    EXPECT_FALSE(rig.last.mounting_known) << off_deg;
    EXPECT_NEAR(to_deg(rig.last.mounting_rad), 0, 1e-9) << off_deg;
    EXPECT_FALSE(rig.last.learned.mounting_rad.known()) << off_deg;
    rig.world.position = rig.world.heading = false;
    rig.forget();
    rig.drive(0.5, 0.5, 20);
    EXPECT_EQ(rig.share_bound(), 1) << off_deg;
    EXPECT_FALSE(rig.last.disagrees) << off_deg << ' ' << rig.last.reason.view();
  }
}

/// The receiver is lost before the first leg could tell: the bound is that of an unknown mounting.
TEST_F(LearnedBefore, ALineThatWasBumpedIsInTheBoundBeforeTheFirstLeg) {
  for (const double off_deg : {-6.0, -3.0, 0.0}) {
    Rig rig(5);
    rig.estimator.recall(mounted(3, 0.1));
    rig.world.heading_off_deg = off_deg;
    settle(rig);
    rig.drive(0.5, 0.5, 1);
    rig.world.position = rig.world.heading = false;
    rig.forget();
    rig.drive(0.5, 0.5, 30);
    EXPECT_EQ(rig.share_bound(), 1) << off_deg;
  }
}

TEST_F(LearnedBefore, IsProvedThereAndBackAndNotRoundACorner) {
  const EstimateConfig config;
  const auto leg = [&](Mounting& mounting, double course_rad) {
    learn(mounting, {.way_m = 5, .course_rad = course_rad, .across_m = 0, .variance_m2 = 0.0013},
          config);
  };
  Mounting mounting;
  mounting.recall(to_rad(2), to_rad(0.14), config);
  EXPECT_FALSE(mounting.proved(config));
  leg(mounting, 0);
  leg(mounting, kPi / 2);
  leg(mounting, -kPi / 2);
  EXPECT_FALSE(mounting.proved(config));
  leg(mounting, kPi);
  EXPECT_TRUE(mounting.proved(config));
}

/// The scale of the one gyro says nothing of the other one's.
TEST_F(LearnedBefore, AScaleIsOfItsGyro) {
  LearnedValues learned;
  learned.imu = 1;
  learned.gyro_scale = {1.02, 0.001};
  Rig rig(4);
  rig.estimator.recall(learned);
  settle(rig);  // it hears the first one
  EXPECT_EQ(rig.last.learned.imu, 0);
  EXPECT_FALSE(rig.last.learned.gyro_scale.known());
  learned.imu = 0;
  Rig same(4);
  same.estimator.recall(learned);
  settle(same);
  EXPECT_NEAR(same.last.learned.gyro_scale.value, 1.02, 0.002);
}

TEST_F(LearnedBefore, WhatNoRobotCanBeIsLeftOut) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  constexpr double kInf = std::numeric_limits<double>::infinity();
  const LearnedValue odd[] = {{kNan, 0.001}, {0.01, kNan}, {kInf, 0.001}, {0.01, kInf}, {0.01, 0},
                              {0.01, -1},    {1e9, 0.001}, {-1e9, 0.001}, {0.01, 1e9}};
  for (const LearnedValue& value : odd) {
    LearnedValues learned;
    each_learned(learned, [&](const char*, LearnedValue& one) { one = value; });
    Rig rig(4);
    rig.estimator.recall(learned);
    settle(rig);
    EXPECT_FALSE(rig.last.mounting_known) << value.value << ' ' << value.sigma;
    EXPECT_NEAR(rig.last.yaw_slip_factor, 1, 0.3);
    EXPECT_LT(rig.position_error_m(), 0.05);
    EXPECT_LT(to_deg(rig.yaw_error_rad()), 2);
  }
}

TEST_F(LearnedBefore, ALineThatWasCalibratedIsLeftAsItIs) {
  EngineConfig config = rig_config();
  config.estimate.heading_mount_sigma_deg = 0;
  Rig rig(4, config);
  rig.estimator.recall(mounted(3, 0.1));
  settle(rig);
  EXPECT_LT(to_deg(rig.yaw_error_rad()), 0.5);
}

TEST_F(LearnedBefore, ADelayNeedsNoChangeOfSpeedAnyMore) {
  LearnedValues learned;
  learned.late_s = {0.2, 0.01};
  for (const bool recalls : {false, true}) {
    Rig rig(6);
    rig.world.noise = 0;
    rig.world.latency_s = rig.world.stamp_error_s = 0.2;
    if (recalls) rig.estimator.recall(learned);
    settle(rig);
    rig.drive(0.5, 0.5, 1);
    EXPECT_LT(rig.position_error_m(), 0.03);
    if (recalls) {
      EXPECT_LT(rig.last.error_bound_m, 0.15);
    } else {
      EXPECT_GT(rig.last.error_bound_m, 0.3) << "nothing to show: it is known at once";
    }
  }
}

/// The spare's positions are on time, and it tells no heading.
TEST_F(LearnedBefore, ADelayIsNotThatOfAnotherReceiver) {
  LearnedValues learned;
  learned.late_s = {0.2, 0.01};
  Rig rig(6);
  rig.world.noise = 0;
  rig.world.latency_s = rig.world.stamp_error_s = 0.2;
  rig.estimator.recall(learned);
  settle(rig);
  rig.drive(1, 1, 5);
  EXPECT_LT(rig.position_error_m(), 0.05);
  EXPECT_TRUE(rig.last.learned.late_s.known());
  rig.world.heading = false;
  rig.world.receiver = 1;
  rig.world.stamp_error_s = 0;
  rig.world.latency_s = 0.05;
  rig.drive(1, 1, 10);
  EXPECT_LT(rig.position_error_m(), 0.05);
  EXPECT_FALSE(rig.last.disagrees) << rig.last.reason.view();
  EXPECT_FALSE(rig.last.learned.late_s.known()) << "under the first one's name";
}

TEST_F(LearnedBefore, AnArmIsInTheBoundFromTheFirstMetreOn) {
  LearnedValues learned;
  learned.antenna_ahead_m = {0.2, 0.01};
  learned.antenna_left_m = {0.0, 0.01};
  Rig rig(6);
  rig.estimator.recall(learned);
  settle(rig);
  rig.drive(0.5, 0.5, 2);
  EXPECT_NEAR(rig.last.arm_ahead_m, 0.2, 0.03);
  EXPECT_GE(rig.last.predicted_error_m, 0.19);
}

TEST_F(LearnedBefore, AnArmThatFitsIsKnownFromTheStartOn) {
  EngineConfig config = rig_config();
  config.estimate.antenna_sigma_m = 0.06;
  Rig fresh(6, config);
  settle(fresh);
  EXPECT_NEAR(fresh.last.arm_unknown_m, 0.12, 1e-9);

  LearnedValues learned;
  learned.antenna_ahead_m = {0.005, 0.01};
  learned.antenna_left_m = {-0.003, 0.01};
  Rig rig(6, config);
  rig.estimator.recall(learned);
  settle(rig);
  EXPECT_FALSE(std::isfinite(rig.last.arm_unknown_m));
}

TEST_F(LearnedBefore, IsHandedOnAsItWasTaken) {
  const LearnedValues learned = taught(3);
  Rig rig(7);
  rig.estimator.recall(learned);
  rig.world.heading_off_deg = 3;
  settle(rig);
  EXPECT_NEAR(rig.last.learned.mounting_rad.value, learned.mounting_rad.value, to_rad(0.05));
  EXPECT_EQ(rig.last.learned.receiver, 0);
}

/// Started again and again, with hardly a way between.
TEST_F(LearnedBefore, LastsOverStartsWithoutADrive) {
  LearnedValues learned = mounted(3, 0.1);
  for (int start = 0; start < 10; ++start) {
    Rig rig(7);
    rig.estimator.recall(learned);
    rig.world.heading_off_deg = -3;
    settle(rig);
    learned = rig.last.learned;
  }
  EXPECT_NEAR(to_deg(learned.mounting_rad.value), 3, 0.01);
  EXPECT_NEAR(to_deg(learned.mounting_rad.sigma), 0.2, 0.01);
}

TEST_F(LearnedBefore, IsForgottenAtAPersonsWord) {
  Rig rig(4);
  rig.estimator.recall(mounted(-3, 0.1));
  rig.world.heading_off_deg = 3;
  settle(rig);
  there_and_back(rig);
  ASSERT_TRUE(rig.last.mounting_known);
  rig.stand(2);
  rig.estimator.forget_learned();
  rig.stand(2);
  EXPECT_FALSE(rig.last.mounting_known);
  EXPECT_EQ(rig.last.learned.forgotten, 1U);
  EXPECT_FALSE(rig.last.learned.mounting_rad.known());
  EXPECT_TRUE(rig.last.has_position && rig.last.has_heading);
  EXPECT_FALSE(rig.last.disagrees) << rig.last.reason.view();
}

}  // namespace
}  // namespace drover::engine::estimate
