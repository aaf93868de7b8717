// What the estimator refuses, when it knows what, and in which order things may come.
#include "engine/estimate/estimator.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <limits>
#include <random>
#include <vector>

#include "support/allocation_counter.h"
#include "unit/engine/estimate/rig.h"

namespace drover::engine::estimate {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

Measurement heading(double deg, Time at) {
  return {.time = at, .received = at, .value = GnssHeading{.heading_deg = deg}};
}

TEST(Estimator, RejectsPositionsThatNoReceiverCanMean) {
  Rig rig;
  for (const double bad : {kNan, 91.0, -1e300, std::numeric_limits<double>::infinity()}) {
    Measurement m = rig.position_at(0, 0, FixQuality::rtk_fixed, rig.now);
    std::get<GnssPosition>(m.value).latitude_deg = bad;
    rig.estimator.on_measurement(m);
  }
  Measurement m = rig.position_at(0, 0, FixQuality::rtk_fixed, rig.now);
  std::get<GnssPosition>(m.value).longitude_deg = 188.2;
  rig.estimator.on_measurement(m);
  std::get<GnssPosition>(m.value).longitude_deg = 13.2;  // 120 km from the origin
  rig.estimator.on_measurement(m);
  EXPECT_FALSE(rig.estimator.step(rig.now).has_position);
  EXPECT_EQ(rig.estimator.counters().absurd, 6U);
}

TEST(Estimator, RejectsHeadingsThatAreNotAngles) {
  Rig rig;
  for (const double bad : {kNan, 361.0, -1e9}) rig.estimator.on_measurement(heading(bad, rig.now));
  EXPECT_FALSE(rig.estimator.step(rig.now).has_heading);
  EXPECT_EQ(rig.estimator.counters().absurd, 3U);
}

TEST(Estimator, RejectsWheelSpeedsThatAreNoSpeeds) {
  Rig rig;
  rig.stand(2);
  const Pose before = rig.last.pose;
  for (const double bad : {kNan, 1e9, -std::numeric_limits<double>::infinity()}) {
    rig.estimator.on_measurement(rig.wheel_at(0, bad, rig.now));
  }
  const Estimate& e = rig.estimator.step(rig.now + std::chrono::milliseconds(20));
  EXPECT_EQ(e.pose.x_m, before.x_m);
  EXPECT_EQ(rig.estimator.counters().absurd, 3U);
}

TEST(Estimator, TakesNoPositionFromAReceiverThatHasNone) {
  for (const FixQuality quality :
       {FixQuality::none, FixQuality::estimated, FixQuality::manual, FixQuality::simulator}) {
    Rig rig;
    rig.world.quality = quality;
    rig.stand(2);
    EXPECT_FALSE(rig.last.has_position) << static_cast<int>(quality);
    EXPECT_EQ(rig.last.reason.view(), "no position yet");
  }
}

TEST(Estimator, HasNoPositionWithoutAnOrigin) {
  const EngineConfig config = rig_config();
  Estimator estimator(config.estimate, config.base);
  const Rig maker;
  estimator.on_measurement(maker.position_at(0, 0, FixQuality::rtk_fixed, maker.now));
  const Estimate& e = estimator.step(maker.now);
  EXPECT_FALSE(e.has_position);
  EXPECT_EQ(e.reason.view(), "no origin");
  EXPECT_TRUE(std::isnan(estimator.local(kField).x_m));
  EXPECT_TRUE(std::isnan(estimator.antenna_geodetic(e.pose).latitude_deg));
}

TEST(Estimator, NeverTakesAMissingHeadingForEast) {
  Rig rig;
  rig.world.heading = false;
  rig.stand(5);
  EXPECT_TRUE(rig.last.has_position);
  EXPECT_FALSE(rig.last.has_heading);
  EXPECT_TRUE(std::isnan(rig.last.yaw_error_rad));
  EXPECT_EQ(rig.last.reason.view(), "no heading");
  rig.forget();
  rig.drive(0.5, 0.5, 10);  // follows the receiver, and says how badly
  EXPECT_GT(rig.share_inside(), 0.9);
  EXPECT_LT(rig.position_error_m(), 0.3);
}

TEST(Estimator, DropsAndCountsWhatIsTooLate) {
  Rig rig;
  rig.stand(3);
  const Pose before = rig.last.pose;
  const Time old = rig.now - std::chrono::milliseconds(501);
  rig.estimator.on_measurement(rig.position_at(3, 3, FixQuality::rtk_fixed, old));
  rig.estimator.on_measurement(heading(10, old));
  rig.estimator.on_measurement(rig.wheel_at(1, 1, old));
  rig.estimator.on_measurement(rig.position_at(3, 3, FixQuality::rtk_fixed, kNever));
  EXPECT_EQ(rig.estimator.counters().late, 3U);
  EXPECT_EQ(rig.estimator.step(rig.now).pose.x_m, before.x_m);
}

TEST(Estimator, CountsARepeatedInstantOnce) {
  Rig rig;
  rig.stand(1);
  const double once = rig.last.predicted_error_m;
  const Measurement m = rig.position_at(rig.x_m, rig.y_m, FixQuality::rtk_fixed, rig.now);
  rig.estimator.on_measurement(m);
  const double twice = rig.estimator.step(rig.now).predicted_error_m;
  for (int i = 0; i < 100; ++i) rig.estimator.on_measurement(m);
  EXPECT_LE(twice, once);
  EXPECT_EQ(rig.estimator.step(rig.now).predicted_error_m, twice);
  EXPECT_EQ(rig.estimator.counters().repeated, 100U);
}

TEST(Estimator, TakesAStampFromTheFutureForNow) {
  Rig rig;
  rig.drive(0.5, 0.5, 5);
  Measurement m =
      rig.position_at(rig.x_m, rig.y_m, FixQuality::rtk_fixed, rig.now + std::chrono::hours(1));
  m.received = kNever;
  rig.estimator.on_measurement(m);
  rig.estimator.on_measurement(
      heading(compass_deg_from_yaw_rad(rig.yaw_rad), rig.now + std::chrono::hours(2)));
  rig.drive(0.5, 0.5, 5);
  EXPECT_LT(rig.position_error_m(), 0.04);
  EXPECT_EQ(rig.estimator.counters().late, 0U);
}

TEST(Estimator, GivesTheSameStateInWhicheverOrderThingsCome) {
  const EngineConfig config = rig_config();
  const Rig maker;
  std::vector<Measurement> all;
  for (int i = 0; i < 40; ++i) {
    const Time at = maker.now + std::chrono::milliseconds(10 * i);
    for (AxisId axis = 0; axis < 4; ++axis) {
      all.push_back(maker.wheel_at(axis, axis < 2 ? 0.4 : 0.5, at));
    }
    if (i % 10 == 0) {
      all.push_back(maker.position_at(0.004 * i, 0, FixQuality::rtk_fixed, at));
      all.push_back(heading(90 - 0.1 * i, at));
    }
  }
  const auto run = [&](const std::vector<Measurement>& in) {
    Estimator estimator(config.estimate, config.base);
    estimator.set_origin(kField);
    estimator.step(maker.now);
    for (const Measurement& m : in) estimator.on_measurement(m);
    return estimator.step(maker.now + std::chrono::milliseconds(450));
  };
  const Estimate sorted = run(all);
  std::mt19937 random(7);
  for (int round = 0; round < 20; ++round) {
    std::shuffle(all.begin(), all.end(), random);
    for (Measurement& m : all) m.received = maker.now + std::chrono::milliseconds(450);
    const Estimate e = run(all);
    EXPECT_EQ(std::bit_cast<std::uint64_t>(e.pose.x_m),
              std::bit_cast<std::uint64_t>(sorted.pose.x_m));
    EXPECT_EQ(std::bit_cast<std::uint64_t>(e.pose.yaw_rad),
              std::bit_cast<std::uint64_t>(sorted.pose.yaw_rad));
    EXPECT_EQ(std::bit_cast<std::uint64_t>(e.predicted_error_m),
              std::bit_cast<std::uint64_t>(sorted.predicted_error_m));
  }
}

TEST(Estimator, IsTheSameToTheBitTwice) {
  Rig a(5);
  Rig b(5);
  for (Rig* rig : {&a, &b}) {
    rig->circle(0.6, 3, 20);
    rig->world.quality = FixQuality::rtk_float;
    rig->circle(0.6, 3, 5);
  }
  EXPECT_EQ(std::bit_cast<std::uint64_t>(a.last.pose.x_m),
            std::bit_cast<std::uint64_t>(b.last.pose.x_m));
  EXPECT_EQ(std::bit_cast<std::uint64_t>(a.last.yaw_slip_factor),
            std::bit_cast<std::uint64_t>(b.last.yaw_slip_factor));
}

TEST(Estimator, SurvivesMoreMeasurementsThanItsHistoryHolds) {
  Rig rig;
  rig.stand(2);
  const Time start = rig.now;
  for (int i = 1; i <= 2000; ++i) {
    const Time at = start + std::chrono::microseconds(100 * i);
    rig.estimator.on_measurement(heading(compass_deg_from_yaw_rad(rig.yaw_rad), at));
    rig.estimator.on_measurement(rig.position_at(rig.x_m, rig.y_m, FixQuality::rtk_fixed, at));
  }
  const Estimate& e = rig.estimator.step(start + std::chrono::milliseconds(200));
  EXPECT_NEAR(e.pose.x_m, rig.x_m, 0.03);
  EXPECT_TRUE(std::isfinite(e.predicted_error_m));
}

TEST(Estimator, AllocatesNothingAfterConstruction) {
  Rig rig;
  rig.drive(0.5, 0.5, 2);
  std::vector<Measurement> all;
  for (int i = 0; i < 400; ++i) {
    const Time at = rig.now + std::chrono::milliseconds(i);
    const double jump_m = i % 7 == 0 ? 5 : 0;
    all.push_back(rig.position_at(rig.x_m + jump_m, rig.y_m, FixQuality::rtk_fixed, at));
    all.push_back(Rig::heading_at(rig.yaw_rad, at));
    all.push_back(rig.wheel_at(static_cast<AxisId>(i % 5), 0.5, at));
  }
  const test::AllocationCounter counter;
  for (const Measurement& m : all) rig.estimator.on_measurement(m);
  rig.estimator.step(rig.now + std::chrono::milliseconds(400));
  rig.estimator.step(rig.now + std::chrono::seconds(100));
  rig.estimator.set_origin(kField);
  const Estimate& e = rig.estimator.step(rig.now + std::chrono::seconds(101));
  (void)rig.estimator.antenna_geodetic(e.pose);
  EXPECT_EQ(counter.count(), 0U);
  const std::vector<int> proof(10);  // the counter counts
  EXPECT_GT(counter.count(), 0U);
}

TEST(Estimator, SaysThatTheWheelsAreSilentAndTrustsItselfLess) {
  Rig rig;
  rig.drive(0.5, 0.5, 5);
  rig.world.wheels = rig.world.position = rig.world.heading = false;
  rig.drive(0, 0, 1);
  EXPECT_EQ(rig.last.reason.view(), "wheels are silent");
  EXPECT_EQ(rig.last.pose.vx_mps, 0);
  EXPECT_GT(rig.last.predicted_error_m, 0.4);
  EXPECT_GT(rig.last.yaw_error_rad, 0.4);
  rig.stand(5);
  EXPECT_FALSE(rig.last.has_heading);
}

TEST(Estimator, LeavesOutOneSilentWheelOfASide) {
  Rig rig;
  rig.drive(0.5, 0.5, 5);
  rig.world.wheels = false;
  for (int i = 0; i < 200; ++i) {
    for (const AxisId axis : {AxisId{0}, AxisId{2}, AxisId{3}}) {
      rig.estimator.on_measurement(rig.wheel_at(axis, 0.5, rig.now));
    }
    rig.tick(0.5, 0.5);
  }
  EXPECT_TRUE(rig.last.reason.empty()) << rig.last.reason.view();
  EXPECT_NEAR(rig.last.body.twist.vx_mps, 0.5, 0.01);
  EXPECT_NEAR(rig.last.pose.vx_mps, 0.5, 0.02);
}

TEST(Estimator, TellsTheSamePlaceAtOnceInTheFrameOfANewOrigin) {
  Rig rig;
  rig.world.slip = 1.5;
  rig.stand(2);
  rig.drive(-0.2, 0.2, 15);
  const Estimate before = rig.last;
  GeodeticPoint east = rig.estimator.origin();
  east.longitude_deg += 0.001;  // 74.5 m
  rig.estimator.set_origin(east);
  const Estimate& moved = rig.estimator.step(rig.now);
  EXPECT_TRUE(moved.has_position && moved.has_heading);
  EXPECT_NEAR(moved.pose.x_m, before.pose.x_m - 74.46, 0.05);
  EXPECT_NEAR(moved.pose.y_m, before.pose.y_m, 0.05);
  EXPECT_NEAR(moved.pose.yaw_rad, before.pose.yaw_rad, 1e-3);
  EXPECT_NEAR(moved.predicted_error_m, before.predicted_error_m, 0.01);
  rig.stand(1);
  EXPECT_TRUE(rig.last.has_position && rig.last.has_heading);
  EXPECT_NEAR(rig.last.pose.x_m, rig.x_m - 74.46, 0.1);
  EXPECT_NEAR(rig.last.yaw_slip_factor, before.yaw_slip_factor, 0.01);
}

TEST(Estimator, ForgetsAPlaceThatTheReceiverContradictsWhenTheOriginIsSet) {
  Rig rig;
  rig.stand(2);
  rig.drive(0.5, 0.5, 5);
  // The receiver jumps while the robot drives on: nobody knows which of the two is right.
  rig.x_m += 3;
  for (int i = 0; i < 400 && !rig.last.disagrees; ++i) rig.drive(0.5, 0.5, 0.05);
  ASSERT_TRUE(rig.last.disagrees);
  rig.estimator.set_origin(rig.estimator.origin());
  const Estimate& lost = rig.estimator.step(rig.now);
  EXPECT_FALSE(lost.has_position);
  EXPECT_FALSE(lost.has_heading);
  rig.stand(1);
  EXPECT_TRUE(rig.last.has_position && rig.last.has_heading);
  EXPECT_NEAR(rig.last.pose.x_m, rig.x_m, 0.1);
}

TEST(Estimator, GivesTheAntennaForThePose) {
  EngineConfig config = rig_config();
  config.estimate.antenna_x_m = 0.5;
  config.estimate.antenna_y_m = -0.2;
  Rig rig(1, config);
  Pose pose;
  pose.x_m = 10;
  pose.y_m = 20;
  pose.yaw_rad = kPi / 2;
  const PathPoint antenna = rig.estimator.local(rig.estimator.antenna_geodetic(pose));
  EXPECT_NEAR(antenna.x_m, 10.2, 1e-6);
  EXPECT_NEAR(antenna.y_m, 20.5, 1e-6);
}

}  // namespace
}  // namespace drover::engine::estimate
