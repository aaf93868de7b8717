#include "engine/health/motion_witness.h"

#include <gtest/gtest.h>

#include <string>

namespace drover::engine {
namespace {

using namespace std::chrono_literals;

class AMotionWitness : public testing::Test {
 protected:
  AMotionWitness() {
    position_.latitude_deg = 48;
    position_.longitude_deg = 11;
  }
  /// Ten times a second, as a receiver tells it, with the way that comes of the speed.
  void tell(double speed_mps, FixQuality quality) { tell(speed_mps, speed_mps, quality); }
  /// Its places go by `way_mps`, whatever its speed is.
  void tell(double speed_mps, double way_mps, FixQuality quality = FixQuality::rtk_fixed) {
    now_ += 100ms;
    constexpr double kMetresPerDegree = 111195;
    position_.quality = quality;
    position_.latitude_deg += way_mps * 0.1 / kMetresPerDegree;
    witness_.on_position(position_, now_);
    GnssVelocity velocity;
    velocity.speed_mps = speed_mps;
    witness_.on_speed(velocity, now_);
  }
  int moving() const { return witness_.hear(now_).moving; }

  MotionWitness witness_{EngineConfig{}};
  Time now_{100s};
  GnssPosition position_;
};

TEST_F(AMotionWitness, SeesAMotionThatBeginsSlowlyWithAFix) {
  witness_.expect_rest(now_, 0);
  witness_.set_at_rest(true);
  for (int i = 0; i < 100; ++i) tell(0.01, FixQuality::rtk_fixed);
  EXPECT_EQ(moving(), 0);
  for (int i = 0; i < 20; ++i) tell(0.03 * i, FixQuality::rtk_fixed);
  EXPECT_EQ(moving(), 2) << witness_.hear(now_).in_words.view();
}

TEST_F(AMotionWitness, TellsWhatADriveDoesFromAShoveAside) {
  for (int i = 0; i < 3; ++i) tell(1.6, FixQuality::rtk_fixed);  // to the north
  constexpr double kNorth_rad = 1.5707963267948966;
  EXPECT_NEAR(witness_.proven_speed_mps(now_, kNorth_rad), 1.6, 0.01);
  EXPECT_NEAR(witness_.proven_speed_mps(now_, -kNorth_rad), 1.6, 0.01) << "backwards";
  EXPECT_EQ(witness_.proven_speed_mps(now_, 0), 0) << "it is shoved aside";
  EXPECT_NEAR(witness_.proven_speed_mps(now_, kAbsent), 1.6, 0.01) << "nobody knows where to";
}

TEST_F(AMotionWitness, LearnsTheNoiseOfAFloatSolutionWhileItRests) {
  witness_.set_at_rest(true);
  for (int i = 0; i < 100; ++i) tell(i % 2 == 0 ? 0.3 : 0.1, FixQuality::rtk_float);
  tell(0.7, FixQuality::rtk_float);
  EXPECT_EQ(moving(), 0);
}

TEST_F(AMotionWitness, TellsStandingFromFiveCentimetresASecondWhenItMayLookForThreeSeconds) {
  for (int i = 0; i < 15; ++i) tell(0.05, 0.05);
  EXPECT_TRUE(witness_.stands(now_)) << "in a second it is as little as noise";
  for (int i = 0; i < 40; ++i) tell(0.05, 0.05);
  EXPECT_FALSE(witness_.stood(now_));
  for (int i = 0; i < 35; ++i) tell(0.01, 0.01);
  EXPECT_TRUE(witness_.stood(now_));
  tell(0.01, 0.01, FixQuality::rtk_float);
  now_ += 2s;
  EXPECT_FALSE(witness_.stood(now_)) << "nobody looks any more";
}

TEST_F(AMotionWitness, SeesAReceiverStandThatTellsOnceASecond) {
  for (int i = 0; i < 3; ++i) {
    now_ += 900ms;
    tell(0, 0);
  }
  EXPECT_TRUE(witness_.stands(now_));
}

TEST_F(AMotionWitness, BelievesAWayThatSpeedAndPlacesTellTogetherForASecond) {
  for (int i = 0; i < 18; ++i) tell(0.5, 0.5);
  EXPECT_FALSE(witness_.proven_way(now_));
  for (int i = 0; i < 6; ++i) tell(0.5, 0.5);
  const auto way = witness_.proven_way(now_);
  ASSERT_TRUE(way);
  EXPECT_NEAR(way->y_m, 0.5, 0.02);
  EXPECT_NEAR(way->x_m, 0, 0.02);
}

TEST_F(AMotionWitness, BelievesNoWayOfAReceiverThatContradictsItself) {
  for (int i = 0; i < 100; ++i) {
    tell(i % 3 == 0 ? 1.4 : 0.2, 0.8);
    EXPECT_FALSE(witness_.proven_way(now_)) << i;
  }
}

}  // namespace
}  // namespace drover::engine
