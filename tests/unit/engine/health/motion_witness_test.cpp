#include "engine/health/motion_witness.h"

#include <gtest/gtest.h>

#include <string>

namespace drover::engine {
namespace {

using namespace std::chrono_literals;

class AMotionWitness : public testing::Test {
 protected:
  /// Ten times a second, as a receiver tells it, with the way that comes of the speed.
  void tell(double speed_mps, FixQuality quality) {
    now_ += 100ms;
    constexpr double kMetresPerDegree = 111195;
    position_.quality = quality;
    position_.latitude_deg += speed_mps * 0.1 / kMetresPerDegree;
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
  position_.latitude_deg = 48;
  position_.longitude_deg = 11;
  witness_.expect_rest(now_, 0);
  witness_.set_at_rest(true);
  for (int i = 0; i < 100; ++i) tell(0.01, FixQuality::rtk_fixed);
  EXPECT_EQ(moving(), 0);
  for (int i = 0; i < 20; ++i) tell(0.03 * i, FixQuality::rtk_fixed);
  EXPECT_EQ(moving(), 2) << witness_.hear(now_).in_words.view();
}

TEST_F(AMotionWitness, LearnsTheNoiseOfAFloatSolutionWhileItRests) {
  position_.latitude_deg = 48;
  position_.longitude_deg = 11;
  witness_.set_at_rest(true);
  for (int i = 0; i < 100; ++i) tell(i % 2 == 0 ? 0.3 : 0.1, FixQuality::rtk_float);
  tell(0.7, FixQuality::rtk_float);
  EXPECT_EQ(moving(), 0);
}

}  // namespace
}  // namespace drover::engine
