// Receiver and wheels contradict each other: outliers, wrong fixes, a carried robot.
#include <gtest/gtest.h>

#include "unit/engine/estimate/rig.h"

namespace drover::engine::estimate {
namespace {

class EstimateJumps : public testing::TestWithParam<double> {};

TEST_P(EstimateJumps, AreNotFollowedWhileDriving) {
  Rig rig;
  rig.stand(5);
  rig.drive(0.5, 0.5, 5);
  rig.world.jump_x_m = GetParam();
  rig.forget();
  rig.drive(0.5, 0.5, 0.9);
  EXPECT_FALSE(rig.last.disagrees);
  EXPECT_LT(rig.max_m(), 0.05);
  rig.drive(0.5, 0.5, 0.5);
  EXPECT_TRUE(rig.last.disagrees);
  EXPECT_TRUE(rig.last.disputed);
  EXPECT_TRUE(rig.last.reason.view().starts_with("position disagrees with odometry by"))
      << rig.last.reason.view();
  EXPECT_GT(rig.last.predicted_error_m, 0.8 * GetParam());
  rig.drive(0.5, 0.5, 3);
  EXPECT_TRUE(rig.last.disagrees);
  EXPECT_LT(rig.max_m(), 0.1);
}

TEST_P(EstimateJumps, EndWhenTheReceiverComesBack) {
  Rig rig;
  rig.stand(5);
  rig.drive(0.5, 0.5, 5);
  rig.world.jump_x_m = GetParam();
  rig.drive(0.5, 0.5, 2);
  rig.world.jump_x_m = 0;
  rig.drive(0.5, 0.5, 0.5);
  EXPECT_FALSE(rig.last.disagrees);
  EXPECT_LT(rig.position_error_m(), 0.05);
}

INSTANTIATE_TEST_SUITE_P(HalfAMetreToFifty, EstimateJumps, testing::Values(0.5, 5.0, 50.0));

/// Two places are in question, and a poor position says a third: it decides nothing.
TEST(EstimateContradiction, APoorPositionMovesNothingWhileADisputeHolds) {
  Rig rig;
  rig.stand(5);
  rig.drive(0.5, 0.5, 5);
  rig.world.jump_x_m = 0.3;
  rig.drive(0.5, 0.5, 2);
  ASSERT_TRUE(rig.last.disputed);
  rig.stand(1);
  rig.world.quality = FixQuality::rtk_float;
  rig.world.jump_x_m = 2.5;
  rig.forget();
  rig.stand(10);
  EXPECT_LT(rig.max_m(), 0.5);
  rig.world.quality = FixQuality::rtk_fixed;
  rig.world.jump_x_m = 0;
  rig.stand(5);
  EXPECT_LT(rig.position_error_m(), 0.05);
  EXPECT_EQ(rig.share_bound(), 1);
}

/// Nothing was heard for a while, of anything: where dead reckoning has it then is no other place.
TEST(EstimateContradiction, IsNoneWithAPlaceThatNobodyKnewTheWayTo) {
  for (const double rolled_m : {0.0, 0.2, 2.0}) {
    Rig rig;
    rig.stand(5);
    rig.drive(0.5, 0.5, 5);
    rig.world.wheels = rig.world.position = rig.world.heading = false;
    rig.drive(0.1, 0.1, 10 * rolled_m);
    rig.stand(50);
    rig.world.wheels = rig.world.position = rig.world.heading = true;
    rig.stand(10);
    EXPECT_LT(rig.position_error_m(), 0.05) << rolled_m;
    EXPECT_LT(rig.last.error_bound_m, 0.2 + rolled_m) << rolled_m;
    rig.stand(60);
    EXPECT_LT(rig.last.error_bound_m, 0.2) << rolled_m;
  }
}

/// Where the fix was lost and found at rest its filters have to settle before it tells how far it
/// is beside: what fades of the poor position before it is no other place.
class AFixThatIsFoundAtRest : public testing::TestWithParam<FixQuality> {
 protected:
  AFixThatIsFoundAtRest() {
    rig.world.imu = true;
    rig.world.gst = true;
    rig.stand(5);
    rig.drive(0.5, 0.5, 5);
    rig.world.quality = GetParam();
  }
  void find() {
    rig.world.quality = FixQuality::rtk_fixed;
    rig.forget();
    rig.stand(10);
  }
  Rig rig;
};

TEST_P(AFixThatIsFoundAtRest, LeavesNothingInTheBoundThatOnlyFaded) {
  for (const double fade_s : {0.3, 1.0}) {
    rig.world.fade_s = fade_s;
    rig.world.quality = GetParam();
    rig.stand(60);
    find();
    EXPECT_LT(rig.last.error_bound_m, 0.25) << fade_s;
    EXPECT_LT(rig.position_error_m(), 0.05) << fade_s;
    EXPECT_EQ(rig.share_bound(), 1) << fade_s;
  }
}

/// Without a position at all, too.
TEST(EstimateContradiction, AFixThatIsFoundElsewhereAtRestStaysInTheBound) {
  Rig rig;
  rig.stand(5);
  rig.drive(0.5, 0.5, 5);
  rig.stand(1);
  rig.world.position = false;
  rig.stand(60);
  rig.world.jump_x_m = 0.3;
  rig.world.position = true;
  rig.stand(100);
  EXPECT_GT(rig.last.error_bound_m, 0.3);
}

/// Dead reckoning is worth less than a fix then, whatever that still has of its error.
TEST_P(AFixThatIsFoundAtRest, TellsOfALongWayNoMoreThanThatWasUncertain) {
  rig.world.fade_s = 0.3;
  rig.drive(0.5, 0.5, 60);
  rig.stand(1);
  const double way_m = 2 * rig.last.predicted_error_m;
  find();
  EXPECT_LT(rig.last.error_bound_m, way_m + 0.2);
  EXPECT_LT(rig.position_error_m(), 0.05);
  EXPECT_EQ(rig.share_bound(), 1);
}

TEST_P(AFixThatIsFoundAtRest, ElsewhereIsInTheBound) {
  rig.world.fade_s = 0.3;
  rig.stand(60);
  rig.world.jump_x_m = 0.3;
  find();
  rig.stand(100);
  EXPECT_GT(rig.last.error_bound_m, 0.3);
}

INSTANTIATE_TEST_SUITE_P(After, AFixThatIsFoundAtRest,
                         testing::Values(FixQuality::rtk_float, FixQuality::dgps,
                                         FixQuality::single));

struct Beside {
  double m = 0;        ///< to the east
  double yaw_rad = 0;  ///< where it drives
};

/// It drove on without one until it had to wait: that it stands now is no word for where it is
/// found.
class AFixThatIsFoundAfterAWay : public testing::TestWithParam<std::tuple<FixQuality, Beside>> {
 protected:
  AFixThatIsFoundAfterAWay() {
    rig.world.imu = true;
    rig.world.gst = true;
    rig.yaw_rad = beside().yaw_rad;
    rig.stand(5);
    rig.drive(0.5, 0.5, 20);
    lose();
    rig.drive(0.5, 0.5, 10);
    rig.stand(5);
  }
  static Beside beside() { return std::get<1>(GetParam()); }
  void lose() {
    const FixQuality meanwhile = std::get<0>(GetParam());
    rig.world.position = meanwhile != FixQuality::none;
    rig.world.quality = meanwhile;
  }
  void find(double beside_m) {
    rig.world.position = true;
    rig.world.quality = FixQuality::rtk_fixed;
    rig.world.jump_x_m = beside_m;
  }
  Rig rig;
};

TEST_P(AFixThatIsFoundAfterAWay, BesideDeadReckoningIsNotBelieved) {
  find(beside().m);
  rig.forget();
  rig.stand(55);
  EXPECT_TRUE(rig.last.disputed) << rig.last.reason.view();
  EXPECT_LT(rig.max_m(), 0.25);
  EXPECT_GT(rig.last.predicted_error_m, std::abs(beside().m) - 0.2);
  EXPECT_EQ(rig.share_bound(), 1);
}

/// Slip leads back along the way; nothing leads so far ahead or aside of it.
TEST_P(AFixThatIsFoundAfterAWay, IsBelievedAfterAMinuteWhereSlipExplainsIt) {
  find(beside().m);
  rig.forget();
  rig.stand(75);
  const bool slipped = beside().yaw_rad == kPi;
  EXPECT_EQ(rig.last.disputed, !slipped) << rig.last.reason.view();
  EXPECT_EQ(rig.position_error_m() > 0.5, slipped);
  EXPECT_EQ(rig.share_bound(), 1) << "the other place is in it";
}

/// Where the base is had nothing slipped is told until another fix is found.
TEST_P(AFixThatIsFoundAfterAWay, TellsOfTheOtherPlaceUntilAnotherFixIsFound) {
  find(beside().m);
  rig.stand(75);
  const bool slipped = beside().yaw_rad == kPi;
  ASSERT_EQ(rig.last.disputed, !slipped) << rig.last.reason.view();
  if (!slipped) return;
  EXPECT_NEAR(rig.last.pose.x_m - rig.x_m, beside().m, 0.1);
  EXPECT_NEAR(rig.last.unbelieved_x_m, -beside().m, 0.2);
  EXPECT_NEAR(rig.last.unbelieved_y_m, 0, 0.2);
  EXPECT_GT(rig.last.unbelieved_error_m, 0);
  lose();
  rig.stand(5);
  find(beside().m);
  rig.stand(5);
  EXPECT_GT(rig.last.unbelieved_error_m, 0) << "after a moment it is the same solution";
  lose();
  rig.stand(15);
  find(beside().m);
  rig.stand(5);
  EXPECT_EQ(rig.last.unbelieved_error_m, 0);
  EXPECT_EQ(rig.last.unbelieved_x_m, 0);
}

TEST_P(AFixThatIsFoundAfterAWay, IsBelievedWhenItStepsToDeadReckoning) {
  find(beside().m);
  rig.stand(20);
  ASSERT_TRUE(rig.last.disputed) << rig.last.reason.view();
  find(0);
  rig.stand(5);
  EXPECT_FALSE(rig.last.disagrees) << rig.last.reason.view();
  EXPECT_LT(rig.position_error_m(), 0.05);
}

TEST_P(AFixThatIsFoundAfterAWay, WhereDeadReckoningIsIsBelievedAtOnce) {
  find(0);
  rig.stand(5);
  EXPECT_FALSE(rig.last.disagrees) << rig.last.reason.view();
  EXPECT_LT(rig.position_error_m(), 0.05);
}

INSTANTIATE_TEST_SUITE_P(After, AFixThatIsFoundAfterAWay,
                         testing::Combine(testing::Values(FixQuality::none, FixQuality::rtk_float),
                                          testing::Values(Beside{0.5, kPi / 2},
                                                          Beside{0.7, kPi / 2}, Beside{0.7, 0},
                                                          Beside{0.7, kPi})));

TEST(EstimateContradiction, SingleOutliersAreNoDisagreement) {
  Rig rig;
  rig.stand(5);
  for (int i = 0; i < 20; ++i) {
    rig.world.jump_x_m = 2;
    rig.drive(0.5, 0.5, 0.1);
    rig.world.jump_x_m = 0;
    rig.drive(0.5, 0.5, 0.3);
    EXPECT_FALSE(rig.last.disagrees);
  }
  EXPECT_LT(rig.position_error_m(), 0.05);
  EXPECT_GT(rig.estimator.counters().refused, 15U);
}

TEST(EstimateContradiction, ACarriedRobotIsFoundAgainWhenItStands) {
  Rig rig;
  rig.stand(20);
  rig.x_m += 3;
  rig.yaw_rad += 1;
  rig.stand(0.9);
  EXPECT_GT(rig.position_error_m(), 2.9);  // not yet believed
  rig.stand(0.5);
  EXPECT_LT(rig.position_error_m(), 0.05);
  EXPECT_LT(to_deg(rig.yaw_error_rad()), 1.5);
  EXPECT_FALSE(rig.last.disagrees);
}

TEST(EstimateContradiction, AWanderingReceiverIsNotFollowedByAStandingRobot) {
  Rig rig;
  rig.stand(20);
  for (int i = 0; i < 40; ++i) {
    rig.world.jump_x_m = 3 + 0.5 * i;  // never twice the same place
    rig.stand(0.1);
  }
  EXPECT_TRUE(rig.last.disagrees);
  EXPECT_LT(rig.position_error_m(), 0.05);
}

TEST(EstimateContradiction, AFlippedHeadingIsNotFollowedWhileDriving) {
  Rig rig;
  rig.stand(5);
  rig.drive(0.5, 0.5, 2);
  rig.world.heading_off_deg = 180;
  rig.drive(0.5, 0.5, 2);
  EXPECT_TRUE(rig.last.disagrees);
  EXPECT_EQ(rig.last.reason.view(), "heading disagrees with odometry: 180 degrees beside wheels");
  EXPECT_LT(to_deg(rig.yaw_error_rad()), 2.0);
}

TEST(EstimateContradiction, AHeadingFlippedFromTheStartShowsWithinAMetre) {
  Rig rig;
  rig.world.heading_off_deg = 180;
  rig.stand(5);
  const double x_m = rig.x_m;
  const double y_m = rig.y_m;
  while (!rig.last.disagrees && std::hypot(rig.x_m - x_m, rig.y_m - y_m) < 2) rig.tick(0.5, 0.5);
  EXPECT_LT(std::hypot(rig.x_m - x_m, rig.y_m - y_m), 1.0);
}

TEST(EstimateContradiction, AStuckReceiverShowsWhileDriving) {
  Rig rig;
  rig.stand(5);
  rig.world.position = false;
  const double x_m = rig.x_m;
  const double y_m = rig.y_m;
  for (int i = 0; i < 20; ++i) {
    rig.estimator.on_measurement(rig.position_at(x_m, y_m, FixQuality::rtk_fixed, rig.now));
    rig.drive(0.5, 0.5, 0.1);
  }
  EXPECT_TRUE(rig.last.disagrees);
}

}  // namespace
}  // namespace drover::engine::estimate
