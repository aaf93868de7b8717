// The inertial sensor in the estimate: outages, its loss, its faults, slipping wheels, slopes.
#include <gtest/gtest.h>

#include <cstdio>
#include <string>

#include "unit/engine/estimate/rig.h"

namespace drover::engine::estimate {
namespace {

bool says(const Reason& reason, const std::string& words) {
  return std::string(reason.view()).find(words) != std::string::npos;
}

/// At rest with the sensor on, as before a task.
void settle(Rig& rig) {
  rig.world.imu = true;
  rig.stand(5);
}

TEST(EstimateFusion, RefusesRatesThatNoSensorCanMean) {
  Rig rig;
  settle(rig);
  for (const double bad : {std::nan(""), HUGE_VAL, -1e6}) {
    ImuSample sample;
    sample.acceleration_mps2.z = 9.81;
    sample.angular_velocity_radps.z = bad;
    rig.estimator.on_measurement({.time = rig.now, .received = rig.now, .value = sample});
  }
  EXPECT_EQ(rig.estimator.counters().absurd, 3U);
  rig.drive(0.5, 0.5, 5);
  EXPECT_LT(rig.position_error_m(), 0.04);
}

TEST(EstimateFusion, IgnoresSamplesThatRunBackwards) {
  Rig rig;
  settle(rig);
  ImuSample sample;
  sample.acceleration_mps2.z = 9.81;
  sample.angular_velocity_radps.z = 1;
  const Time old = rig.now - std::chrono::milliseconds(50);
  rig.estimator.on_measurement({.time = old, .received = rig.now, .value = sample});
  EXPECT_EQ(rig.estimator.counters().repeated, 1U);
}

TEST(EstimateFusion, FallsBackToTheWheelsWhileTheSensorIsSaturated) {
  Rig rig;
  settle(rig);
  EXPECT_TRUE(rig.last.gyro_used);
  ImuSample sample;
  sample.acceleration_mps2.z = 9.81;
  sample.angular_velocity_radps.z = 34.9;
  sample.saturated = true;
  const Time at = rig.now + std::chrono::milliseconds(10);
  rig.estimator.on_measurement({.time = at, .received = at, .value = sample});
  EXPECT_FALSE(rig.estimator.step(at).gyro_used);
}

TEST(EstimateFusion, LearnsTheBiasOfAllAxesAtRest) {
  Rig rig;
  rig.world.gyro_bias_radps = 0.03;
  settle(rig);
  EXPECT_NEAR(rig.last.gyro_bias_radps.z, 0.03, 0.0005);
  EXPECT_NEAR(rig.last.gyro_bias_radps.x, -0.004, 0.0005);
  EXPECT_NEAR(rig.last.gyro_bias_radps.y, 0.006, 0.0005);
  EXPECT_LT(rig.last.gyro_bias_sigma_radps, 0.001);
}

struct Outage {
  double error_share = 0;  ///< of the way driven without the receiver
  double worst_share = 0;
  double yaw_deg = 0;
  double inside = 0;
};
Outage outage_on_a_curve(bool imu) {
  constexpr int kWorlds = 20;
  Outage sum;
  for (int seed = 1; seed <= kWorlds; ++seed) {
    Rig rig(static_cast<std::uint64_t>(seed));
    rig.world.imu = imu;
    rig.world.slip = 1.4;
    rig.stand(10);
    rig.circle(0.5, 5, 60);
    rig.world.position = rig.world.heading = false;
    const double before_m = rig.way_m;
    rig.forget();
    rig.circle(0.5, 5, 30);
    const double share = rig.position_error_m() / (rig.way_m - before_m);
    sum.error_share += share / kWorlds;
    sum.worst_share = std::max(sum.worst_share, share);
    sum.yaw_deg += to_deg(rig.yaw_error_rad()) / kWorlds;
    sum.inside += rig.share_inside() / kWorlds;
  }
  return sum;
}

TEST(EstimateFusion, KeepsItsPlaceThroughThirtySecondsOnACurve) {
  const Outage wheels = outage_on_a_curve(false);
  const Outage gyro = outage_on_a_curve(true);
  for (const auto& [name, o] : {std::pair{"wheels", wheels}, std::pair{"gyro", gyro}}) {
    std::printf("  30 s outage, 15 m curve, %-6s: %.2f %% of the way (worst %.2f %%), %.2f deg\n",
                name, 100 * o.error_share, 100 * o.worst_share, o.yaw_deg);
  }
  EXPECT_LE(gyro.error_share, 0.005);
  EXPECT_LT(gyro.error_share, 0.5 * wheels.error_share);
  EXPECT_GE(gyro.inside, 0.95);
  EXPECT_GE(wheels.inside, 0.93);
}

TEST(EstimateFusion, TellsItsErrorTruly) {
  constexpr int kWorlds = 20;
  double inside = 0;
  double yaw_inside = 0;
  double normalised2 = 0;
  int samples = 0;
  for (int i = 0; i < kWorlds; ++i) {
    // How late positions are is known, as by a calibration, and the receiver tells its error.
    EngineConfig config = rig_config();
    config.estimate.gnss_late_sigma_s = 0;
    Rig rig(static_cast<std::uint64_t>(i) + 1, config);
    rig.world.gst = true;
    rig.world.slip = 1.0 + 0.2 * (i % 4);
    rig.world.scale = 1.0 + 0.02 * (i % 3 - 1);
    rig.world.gyro_bias_radps = 0.01 * (i % 5 - 2);
    rig.world.gyro_scale = 1.0 + 0.005 * (i % 3 - 1);
    settle(rig);
    rig.forget();
    const auto leg = [&](double left_mps, double right_mps, int seconds) {
      for (int s = 0; s < seconds; ++s) {
        rig.drive(left_mps, right_mps, 1);
        const double position = rig.position_error_m() / rig.last.pose.position_sigma_m;
        const double yaw = rig.yaw_error_rad() / rig.last.pose.yaw_sigma_rad;
        normalised2 += position * position + yaw * yaw;
        ++samples;
        EXPECT_TRUE(rig.last.notice.empty()) << i << ' ' << rig.last.notice.view();
        EXPECT_FALSE(rig.last.disagrees) << i << ' ' << rig.last.reason.view();
      }
    };
    leg(0.45, 0.55, 20);
    leg(0, 0, 10);
    leg(0.5, 0.5, 25);
    leg(-0.2, 0.2, 5);
    rig.world.position = rig.world.heading = false;
    leg(0.45, 0.55, 20);
    EXPECT_EQ(rig.share_bound(), 1.0) << "world " << i;
    inside += rig.share_inside() / kWorlds;
    yaw_inside += rig.share_yaw_inside() / kWorlds;
  }
  std::printf("  inside two sigma: position %.3f, heading %.3f; mean square %.2f of 3\n", inside,
              yaw_inside, normalised2 / samples);
  EXPECT_GE(inside, 0.95);
  EXPECT_GE(yaw_inside, 0.95);
  EXPECT_GE(normalised2 / samples, 0.7);
}

TEST(EstimateFusion, GoesOnByTheWheelsWhileUnpluggedAndTakesItBack) {
  Rig rig(3);
  settle(rig);
  rig.circle(0.5, 4, 10);
  rig.world.imu = false;
  rig.forget();
  rig.circle(0.5, 4, 20);
  EXPECT_FALSE(rig.last.gyro_used);
  EXPECT_TRUE(std::isnan(rig.last.roll_rad));
  EXPECT_LT(rig.max_m(), 0.06);
  rig.world.gyro_bias_radps += 0.003;  // it was cold
  rig.world.imu = true;
  rig.circle(0.5, 4, 20);
  EXPECT_TRUE(rig.last.gyro_used) << rig.last.notice.view();
  EXPECT_LT(rig.max_m(), 0.06);
  EXPECT_LT(to_deg(rig.yaw_error_rad()), 1.0);
}

TEST(EstimateFusion, NoticesAGyroThatIsStuck) {
  Rig rig(2);
  settle(rig);
  rig.drive(0.5, 0.5, 5);
  rig.world.imu_frozen = true;
  rig.circle(0.5, 3, 3);
  EXPECT_TRUE(says(rig.last.notice, "gyro not believed")) << rig.last.notice.view();
  EXPECT_FALSE(rig.last.gyro_used);
  rig.circle(0.5, 3, 5);
  EXPECT_LT(to_deg(rig.yaw_error_rad()), 2.0);
  EXPECT_FALSE(rig.last.disagrees);
}

TEST(EstimateFusion, NoticesABiasThatJumpsAndLearnsTheNewOne) {
  Rig rig(4);
  settle(rig);
  rig.drive(0.5, 0.5, 5);
  rig.world.gyro_bias_radps += to_rad(2.0);
  rig.forget();
  bool noticed = false;
  for (int i = 0; i < 30; ++i) {
    rig.drive(0.5, 0.5, 0.1);
    noticed = noticed || says(rig.last.notice, "gyro not believed");
  }
  EXPECT_TRUE(noticed);
  rig.drive(0.5, 0.5, 10);
  EXPECT_FALSE(rig.last.disagrees);
  EXPECT_TRUE(rig.last.gyro_used) << rig.last.notice.view();
  EXPECT_LT(rig.max_m(), 0.08);
  EXPECT_NEAR(rig.last.gyro_bias_radps.z, 0.01 + to_rad(2.0), 0.005);
}

TEST(EstimateFusion, BelievesNeitherWhenNobodyCanTell) {
  Rig rig(4);
  rig.world.heading = true;
  settle(rig);
  rig.drive(0.5, 0.5, 5);
  rig.world.position = rig.world.heading = false;
  rig.world.gyro_bias_radps += to_rad(2.0);
  rig.forget();
  rig.drive(0.5, 0.5, 8);
  EXPECT_TRUE(says(rig.last.notice, "contradict")) << rig.last.notice.view();
  EXPECT_TRUE(rig.last.slipping);
  EXPECT_LE(rig.yaw_error_rad(), rig.last.yaw_error_rad);
  EXPECT_GT(rig.share_inside(), 0.9);
}

TEST(EstimateFusion, NeverFollowsAGyroWithTheWrongSign) {
  Rig rig(6);
  rig.world.gyro_scale = -1;
  settle(rig);
  rig.drive(0.5, 0.5, 3);
  bool noticed = false;
  double worst_rad = 0;
  for (int i = 0; i < 300; ++i) {
    if (i / 50 % 2 == 0) {
      rig.circle(0.5, 2, 0.1);
    } else {
      rig.circle(0.5, -2, 0.1);
    }
    noticed = noticed || says(rig.last.notice, "gyro not believed");
    EXPECT_FALSE(rig.last.disagrees) << i;
    worst_rad = std::max(worst_rad, rig.yaw_error_rad());
  }
  EXPECT_TRUE(noticed);
  EXPECT_LT(to_deg(worst_rad), 15);
  EXPECT_LT(rig.position_error_m(), 0.06);
}

TEST(EstimateFusion, EstimatesAScaleThatIsTenPerCentWrong) {
  Rig rig(7);
  rig.world.gyro_scale = 1.1;
  settle(rig);
  rig.forget();
  rig.circle(0.5, 2, 60);
  EXPECT_LT(to_deg(rig.yaw_error_rad()), 1.5);
  EXPECT_LT(rig.max_m(), 0.08);
  EXPECT_FALSE(rig.last.disagrees);
}

TEST(EstimateFusion, LearnsTheSlipOfTheTurnWithoutTheReceiver) {
  Rig rig(8);
  rig.world.slip = 1.6;
  settle(rig);
  rig.world.position = rig.world.heading = false;
  rig.drive(-0.2, 0.2, 15);
  EXPECT_NEAR(rig.last.yaw_slip_factor, 1.6, 0.1);
  EXPECT_LT(to_deg(rig.yaw_error_rad()), 3.0);
}

TEST(EstimateFusion, TellsWheelsThatSlipInTheTurn) {
  Rig rig(9);
  settle(rig);
  rig.circle(0.5, 3, 10);
  rig.world.turn_grip = 0;
  rig.forget();
  rig.drive(0.3, 0.7, 2);
  EXPECT_TRUE(rig.last.slipping);
  EXPECT_TRUE(says(rig.last.notice, "wheels slip in the turn")) << rig.last.notice.view();
  EXPECT_LT(to_deg(rig.yaw_error_rad()), 1.0);
  EXPECT_LT(rig.max_m(), 0.05);
}

/// A fix that is lost for a moment shows nothing of them.
TEST(EstimateFusion, TakesWheelsThatSlippedForSlippingUntilFixesShowThatTheyDoNot) {
  Rig rig(10);
  settle(rig);
  rig.drive(0.5, 0.5, 5);
  rig.world.grip = 0.5;
  rig.drive(0.5, 0.5, 2);
  ASSERT_TRUE(rig.last.slipping);
  rig.world.quality = FixQuality::rtk_float;
  rig.drive(0.5, 0.5, 0.5);
  EXPECT_TRUE(rig.last.slipping);
  rig.world.quality = FixQuality::rtk_fixed;
  for (int i = 0; i < 6; ++i) {
    rig.drive(0.5, 0.5, 0.1);
    EXPECT_TRUE(rig.last.slipping) << i;
  }
  rig.world.grip = 1;
  rig.drive(0.5, 0.5, 3);
  EXPECT_FALSE(rig.last.slipping);
}

TEST(EstimateFusion, FollowsAndTellsWheelsThatSlipALittle) {
  Rig rig(10);
  settle(rig);
  rig.drive(0.5, 0.5, 5);
  rig.world.grip = 0.5;
  rig.drive(0.5, 0.5, 2);
  EXPECT_TRUE(says(rig.last.notice, "wheels slip")) << rig.last.notice.view();
  EXPECT_LT(rig.position_error_m(), 0.10);
  rig.world.grip = 1;
  rig.drive(0.5, 0.5, 3);
  EXPECT_FALSE(rig.last.slipping);
  EXPECT_LT(rig.position_error_m(), 0.05);
  EXPECT_FALSE(rig.last.disagrees);
}

TEST(EstimateFusion, TakesAFixThatSettlesForNoSlip) {
  Rig rig(15);
  rig.world.gst = true;
  rig.world.fade_s = 1;
  settle(rig);
  rig.world.quality = FixQuality::single;
  rig.stand(2);
  rig.world.quality = FixQuality::rtk_fixed;
  for (int i = 0; i < 60; ++i) {
    rig.stand(0.1);
    EXPECT_FALSE(rig.last.slipping) << i;
  }
}

TEST(EstimateFusion, TakesAJumpBackAlongTheWayForNoSlip) {
  for (const double v_mps : {0.3, 0.5, 0.8}) {
    for (const double back_m : {0.15, 0.2, 0.3, 0.35, 0.5}) {
      for (int phase = 0; phase < 8; ++phase) {  // of the time over which slip is looked for
        Rig rig(12);
        rig.yaw_rad = 0;
        settle(rig);
        rig.drive(v_mps, v_mps, 3 + 0.1 * phase);
        rig.world.jump_x_m = -back_m;
        bool slips = false;
        for (int i = 0; i < 9; ++i) {
          rig.drive(v_mps, v_mps, 0.1);
          slips = slips || rig.last.slipping;
        }
        EXPECT_FALSE(slips) << back_m << " m back at " << v_mps << " m/s, phase " << phase;
      }
    }
  }
}

TEST(EstimateFusion, AddsUpWhatItSlipped) {
  Rig rig(13);
  settle(rig);
  rig.drive(0.5, 0.5, 5);
  EXPECT_EQ(rig.last.slipped_m, 0);
  rig.world.grip = 0.5;
  rig.drive(0.5, 0.5, 4);  // of 2 m that rolled 1 m was driven
  EXPECT_NEAR(rig.last.slipped_m, 1, 0.3);
  rig.world.grip = 1;
  rig.drive(0.5, 0.5, 3);
  EXPECT_EQ(rig.last.slipped_m, 0);
}

TEST(EstimateFusion, HasNoFalsePlaceOnIce) {
  for (const bool imu : {false, true}) {
    Rig rig(11);
    settle(rig);
    rig.world.imu = imu;
    rig.drive(0.5, 0.5, 5);
    rig.world.grip = 0;
    rig.forget();
    rig.drive(0.5, 0.5, 1.6);
    EXPECT_TRUE(rig.last.disagrees);
    EXPECT_TRUE(says(rig.last.reason, "wheels slip or the receiver is stuck"))
        << rig.last.reason.view();
    EXPECT_GT(rig.share_inside(), 0.75);
    EXPECT_LE(rig.position_error_m(), rig.last.predicted_error_m);
  }
}

TEST(EstimateFusion, NoticesAPositionThatDriftsAwayWithAFix) {
  double latest_s = 0;
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    Rig rig(seed);
    rig.yaw_rad = 0;  // the drift goes north: along the way it is no other than soft ground
    settle(rig);
    rig.drive(0.5, 0.5, 20);
    rig.world.drift_mps = 0.02;
    double seconds = 0;
    for (; seconds < 25 && !rig.last.disagrees; seconds += 0.1) rig.drive(0.5, 0.5, 0.1);
    EXPECT_TRUE(says(rig.last.reason, "drifts")) << seed << ' ' << rig.last.reason.view();
    latest_s = std::max(latest_s, seconds);
  }
  std::printf("  a drift of 2 cm/s is noticed after %.1f s at the latest: %.2f m\n", latest_s,
              0.02 * latest_s);
  EXPECT_LT(0.02 * latest_s, 0.5);  // navigate.corridor_m
}

TEST(EstimateFusion, PutsTheAntennaWhereTheSlopeTiltsIt) {
  EngineConfig config = rig_config();
  config.estimate.antenna_z_m = 1.0;
  for (const bool imu : {false, true}) {
    Rig rig(12, config);
    rig.world.imu = imu;
    rig.world.pitch_rad = 0.15;
    rig.world.roll_rad = -0.1;
    rig.stand(5);
    if (!imu) {
      EXPECT_GT(rig.position_error_m(), 0.15);
      continue;
    }
    EXPECT_NEAR(rig.last.pitch_rad, 0.15, 0.01);
    EXPECT_NEAR(rig.last.roll_rad, -0.1, 0.01);
    EXPECT_LT(rig.position_error_m(), 0.04);
    rig.forget();
    rig.drive(0.5, 0.5, 20);
    EXPECT_LT(rig.max_m(), 0.06);
    rig.circle(0.5, 3, 3);  // tilted the same way: a cone, not a plane
    EXPECT_LT(to_deg(rig.yaw_error_rad()), 1.0);
  }
}

TEST(EstimateFusion, SaysHowManyMetresAreLeft) {
  EngineConfig config = rig_config();
  config.estimate.heading_mount_sigma_deg = 0;  // else MountedAskew.DrivesLessFarWithoutReceiver
  Rig rig(13, config);
  settle(rig);
  rig.drive(0.5, 0.5, 20);
  EXPECT_TRUE(std::isnan(rig.last.metres_left));
  rig.world.position = rig.world.heading = false;
  rig.drive(0.5, 0.5, 2);
  const double told_m = rig.last.metres_left;
  const double begin_m = rig.way_m;
  const EstimateConfig bounds;
  while (rig.last.predicted_error_m < bounds.bound_run_m && rig.way_m - begin_m < 200) {
    rig.drive(0.5, 0.5, 0.1);
  }
  const double driven_m = rig.way_m - begin_m;
  EXPECT_GT(driven_m, 5);
  EXPECT_NEAR(told_m, driven_m, 0.15 * driven_m);
  EXPECT_LT(rig.last.metres_left, 0.5);
  rig.world.position = rig.world.heading = true;
  rig.drive(0.5, 0.5, 1);
  EXPECT_TRUE(std::isnan(rig.last.metres_left));
}

TEST(EstimateFusion, TurnsWithABaseThatIsTurnedByHand) {
  Rig rig(14);
  settle(rig);
  rig.world.heading = false;
  for (int i = 0; i < 200; ++i) {  // a second of 1 rad/s while the wheels stand
    rig.yaw_rad += 0.005;
    rig.carry(0.005);
    rig.tick(0, 0);
  }
  EXPECT_LT(to_deg(rig.yaw_error_rad()), 4);
  EXPECT_TRUE(says(rig.last.notice, "while its wheels stand")) << rig.last.notice.view();
}

}  // namespace
}  // namespace drover::engine::estimate
