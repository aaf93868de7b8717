#include "engine/health/hit_watch.h"

#include <gtest/gtest.h>

#include <string>

namespace drover::engine {
namespace {

using namespace std::chrono_literals;

class AHitWatch : public testing::Test {
 protected:
  std::string feel(double x_mps2, double y_mps2, int samples = 1, bool saturated = false) {
    ImuSample sample;
    sample.acceleration_mps2 = {x_mps2, y_mps2, 9.81};
    sample.saturated = saturated;
    for (int i = 0; i < samples; ++i) watch_.on_sample(sample, now_ += 10ms);
    return std::string(watch_.reason(now_).view());
  }
  HitWatch watch_{HealthConfig{}};
  Time now_{100s};
};

TEST_F(AHitWatch, TellsTheHardestOfAHitForASecond) {
  EXPECT_EQ(feel(0, 0, 100), "");
  EXPECT_EQ(feel(-12, 16.5), "") << "one sample of two within a hit";
  EXPECT_EQ(feel(-12, 16.5), "the robot was hit: 20 m/s2 across the ground");
  EXPECT_EQ(feel(30, 0), "the robot was hit: 30 m/s2 across the ground");
  EXPECT_EQ(feel(-25, 0), "the robot was hit: 30 m/s2 across the ground") << "it rings";
  EXPECT_NE(feel(0, 0, 98), "");
  EXPECT_EQ(feel(0, 0, 4), "");
  EXPECT_EQ(feel(0, 25, 2), "the robot was hit: 25 m/s2 across the ground") << "another one";
}
TEST_F(AHitWatch, TakesOneSampleForAJerk) {
  EXPECT_EQ(feel(0, 0, 50), "");
  EXPECT_EQ(feel(60, 0), "");
  EXPECT_EQ(feel(0, 0), "");
  EXPECT_EQ(feel(-60, 0), "");
}
TEST_F(AHitWatch, BelievesOneSampleOfASensorThatTellsNoMore) {
  EXPECT_EQ(feel(0, 0, 50), "");
  now_ += 10ms;  // 50 Hz
  EXPECT_EQ(feel(25, 0), "the robot was hit: 25 m/s2 across the ground");
}
TEST_F(AHitWatch, TakesWhatLastsForASlope) {
  EXPECT_EQ(feel(0, 0, 50), "");
  EXPECT_EQ(feel(6, 0, 500), "") << "37 degrees";
  EXPECT_EQ(feel(-13, 0, 2), "") << "19 from what lasts";
  EXPECT_NE(feel(-16, 0, 2), "");
}
TEST_F(AHitWatch, BelievesASaturatedSampleWhatItSays) {
  EXPECT_EQ(feel(0, 0, 50), "");
  EXPECT_NE(feel(39.2, 0, 2, true), "");
}
TEST_F(AHitWatch, FeelsNoneInWhatComesAfterASilence) {
  EXPECT_EQ(feel(0, 0, 50), "");
  now_ += 1s;
  EXPECT_EQ(feel(25, 0), "") << "it was turned over meanwhile, perhaps";
  EXPECT_NE(feel(0, 0, 2), "");
}
TEST_F(AHitWatch, LooksAtNoneOfItWhenItIsToldSo) {
  HealthConfig off;
  off.hit_mps2 = 0;
  watch_ = HitWatch(off);
  EXPECT_EQ(feel(0, 0, 50), "");
  EXPECT_EQ(feel(90, 0), "");
}

}  // namespace
}  // namespace drover::engine
