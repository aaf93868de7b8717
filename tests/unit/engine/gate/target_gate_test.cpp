#include "engine/gate/target_gate.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace drover::engine {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInf = std::numeric_limits<double>::infinity();

class ATargetGate : public ::testing::Test {
 protected:
  static constexpr Duration kTick = std::chrono::milliseconds(5);
  static constexpr double kTick_s = 0.005;

  const Twist& offer(Owner owner, Twist twist, Stop stop = Stop::none, Duration age = {}) {
    now += kTick;
    const Offer one{owner, twist, now - age};
    return gate.step(now, kTick, {&one, 1}, stop);
  }
  const Twist& drive(double vx_mps, double wz_radps = 0) {
    return offer(Owner::task, {vx_mps, wz_radps});
  }
  void cruise(double vx_mps = 0.5, double wz_radps = 0) {
    for (int i = 0; i < 1000; ++i) drive(vx_mps, wz_radps);
    ASSERT_DOUBLE_EQ(gate.twist().vx_mps, vx_mps);
    ASSERT_DOUBLE_EQ(gate.twist().wz_radps, wz_radps);
  }
  /// Until at rest; returns the time it took.
  double stop_s(Stop stop) {
    for (int i = 1; i < 2000; ++i) {
      offer(Owner::task, {}, stop);
      if (gate.at_rest()) return i * kTick_s;
    }
    return kInf;
  }

  LimitsConfig limits;
  TargetGate gate{limits, std::chrono::milliseconds(100)};
  Time now{std::chrono::seconds(100)};
};

TEST_F(ATargetGate, MakesZeroOfWhatIsNotANumberAndCountsIt) {
  for (const Twist bad : {Twist{kNan, 0}, Twist{0, kNan}, Twist{kInf, 0}, Twist{0, -kInf}}) {
    offer(Owner::task, bad);
    EXPECT_TRUE(gate.at_rest());
    EXPECT_EQ(gate.refusal(), TargetRefusal::not_finite);
  }
  EXPECT_EQ(gate.not_finite(), 4U);
}
TEST_F(ATargetGate, RefusesAWishThatIsTooOldOrFromTheTimeToCome) {
  offer(Owner::task, {0.5, 0}, Stop::none, std::chrono::milliseconds(101));
  EXPECT_EQ(gate.refusal(), TargetRefusal::stale);
  offer(Owner::task, {0.5, 0}, Stop::none, -kTick);
  EXPECT_EQ(gate.refusal(), TargetRefusal::stale);
  EXPECT_TRUE(gate.at_rest());
}
TEST_F(ATargetGate, RestsWhenNobodyWantsAnything) {
  offer(Owner::nobody, {0.5, 0.5});
  EXPECT_TRUE(gate.at_rest());
  EXPECT_EQ(gate.refusal(), TargetRefusal::nobody);
  gate.step(now, kTick, {}, Stop::none);
  EXPECT_TRUE(gate.at_rest());
}
TEST_F(ATargetGate, HasAReasonForEveryRefusal) {
  for (const auto refusal : {TargetRefusal::nobody, TargetRefusal::stop, TargetRefusal::stale,
                             TargetRefusal::not_finite}) {
    EXPECT_FALSE(text(refusal).empty());
  }
  EXPECT_TRUE(text(TargetRefusal::none).empty());
}
TEST_F(ATargetGate, IsAtZeroInTheCycleOfAnEstop) {
  cruise(0.8, 0.5);
  offer(Owner::estop, {0.8, 0.5});
  EXPECT_TRUE(gate.at_rest());
  EXPECT_EQ(gate.refusal(), TargetRefusal::stop);
}
TEST_F(ATargetGate, IsAtZeroInTheCycleOfAnImmediateStop) {
  cruise(0.8, 0.5);
  offer(Owner::task, {0.8, 0.5}, Stop::immediate);
  EXPECT_TRUE(gate.at_rest());
}
TEST_F(ATargetGate, GivesTheBaseToTheHighestRankEvenIfItsWishIsSenseless) {
  now += kTick;
  const Offer offers[] = {{Owner::joint_command, {0.8, 0}, now},
                          {Owner::task, {kNan, 0}, now},
                          {Owner::nobody, {}, now}};
  gate.step(now, kTick, offers, Stop::none);
  EXPECT_TRUE(gate.at_rest());
  EXPECT_EQ(gate.refusal(), TargetRefusal::not_finite);
  const Offer with_estop[] = {{Owner::task, {0.5, 0}, now}, {Owner::estop, {}, now}};
  gate.step(now, kTick, with_estop, Stop::none);
  EXPECT_TRUE(gate.at_rest());
}
TEST_F(ATargetGate, ClampsSpeedAndYawRate) {
  for (int i = 0; i < 2000; ++i) {
    drive(9, -9);
    EXPECT_LE(gate.twist().vx_mps, limits.max_speed_mps);
    EXPECT_GE(gate.twist().wz_radps, -limits.max_yaw_rate_radps);
  }
  EXPECT_DOUBLE_EQ(gate.twist().vx_mps, limits.max_speed_mps);
  EXPECT_DOUBLE_EQ(gate.twist().wz_radps, -limits.max_yaw_rate_radps);
}
TEST_F(ATargetGate, StopsWithTheConfiguredDecelerationAndNoLonger) {
  cruise(0.8);
  EXPECT_NEAR(stop_s(Stop::controlled), 0.8 / limits.deceleration_mps2, 2 * kTick_s);
}
TEST_F(ATargetGate, StaysOnItsCurveDuringAControlledStop) {
  cruise(0.5, 0.25);
  while (!gate.at_rest()) {
    offer(Owner::task, {}, Stop::controlled);
    if (gate.twist().vx_mps > 0.01) {
      EXPECT_NEAR(gate.twist().wz_radps / gate.twist().vx_mps, 0.5, 0.02);
    }
  }
}
TEST_F(ATargetGate, RampsDownWhenTheOwnerFallsSilent) {
  cruise(0.5);
  for (int i = 0; i < 200; ++i) offer(Owner::task, {0.5, 0}, Stop::none, std::chrono::seconds(1));
  EXPECT_TRUE(gate.at_rest());
}
TEST_F(ATargetGate, ForgetsAllMotionWhenReset) {
  cruise(0.5, 0.2);
  gate.reset();
  EXPECT_TRUE(gate.at_rest());
  EXPECT_LE(drive(0.5).vx_mps, 2 * limits.jerk_mps3 * kTick_s * kTick_s);
}
TEST_F(ATargetGate, DoesNotGoOnGainingSpeedOnceLessIsWanted) {
  while (gate.twist().vx_mps < 0.4) drive(0.8);
  const double before_mps = gate.twist().vx_mps;
  EXPECT_LT(drive(0.2).vx_mps, before_mps);
}
TEST_F(ATargetGate, NeverPassesZeroOnTheWayToAReversedWish) {
  cruise(0.5);
  double last_mps = 0.5;
  while (last_mps > 0) {
    drive(-0.5);
    EXPECT_GE(gate.twist().vx_mps, 0);
    last_mps = gate.twist().vx_mps;
  }
  for (int i = 0; i < 1000; ++i) drive(-0.5);
  EXPECT_DOUBLE_EQ(gate.twist().vx_mps, -0.5);
}
TEST_F(ATargetGate, HoldsItsLimitsForAnyHistoryOfWishes) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> wish(-1.2, 1.2);
  Twist before;
  double a_before_mps2 = 0;
  Twist target;
  for (int i = 0; i < 200000; ++i) {
    if (random() % 50 == 0) target = {wish(random), wish(random)};
    const Stop stop = random() % 400 < 20 ? Stop::controlled : Stop::none;
    const Twist after = offer(Owner::task, target, stop);
    const double a_mps2 = (after.vx_mps - before.vx_mps) / kTick_s;
    const bool slower = std::abs(after.vx_mps) < std::abs(before.vx_mps);
    const double limit = slower ? limits.deceleration_mps2 : limits.acceleration_mps2;
    ASSERT_LE(std::abs(a_mps2), limit + 1e-9) << i;
    ASSERT_LE(std::abs(after.wz_radps - before.wz_radps),
              limits.yaw_acceleration_radps2 * kTick_s + 1e-9);
    ASSERT_LE(std::abs(after.vx_mps), limits.max_speed_mps);
    if (!slower && a_mps2 * a_before_mps2 > 0 && std::abs(a_mps2) > std::abs(a_before_mps2)) {
      ASSERT_LE(std::abs(a_mps2 - a_before_mps2), limits.jerk_mps3 * kTick_s + 1e-9) << i;
    }
    before = after;
    a_before_mps2 = a_mps2;
  }
}
TEST_F(ATargetGate, StopsForATargetOfZeroInTheDistanceThatTheTrackerForesees) {
  cruise(0.1);
  double way_m = 0;
  while (!gate.at_rest()) way_m += drive(0).vx_mps * kTick_s;
  EXPECT_NEAR(way_m, 0.1 * std::sqrt(0.1 / limits.jerk_mps3), 0.005);
}

}  // namespace
}  // namespace drover::engine
