#include "engine/health/worst_speed.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace drover::engine {
namespace {

using namespace std::chrono_literals;

class TheWorstSpeed : public testing::Test {
 protected:
  /// A cycle; the receiver's word is 0.1 s old.
  double tell(double wheels_mps, double receiver_mps, double direction = 1) {
    now_ += 10ms;
    return speed_.update(
        {now_, wheels_mps, std::abs(wheels_mps), receiver_mps, now_ - 100ms, direction});
  }
  WorstSpeed speed_;
  Time now_{100s};
};

TEST_F(TheWorstSpeed, IsTheWheelsAfterAStopThatTheReceiverHasNotSeenYet) {
  for (int i = 0; i < 100; ++i) EXPECT_EQ(tell(0.5, 0.52), 0.5);
  for (int i = 0; i < 9; ++i) EXPECT_EQ(tell(0.1, 0.52), 0.1);
  for (int i = 0; i < 20; ++i) EXPECT_EQ(tell(-0.1, 0.4), -0.1) << "it swings back";
  for (int i = 0; i < 100; ++i) EXPECT_EQ(tell(0, 0), 0);
}

TEST_F(TheWorstSpeed, IsTheReceiversWhereTheWheelsStandStillInTheirWords) {
  for (int i = 0; i < 100; ++i) EXPECT_EQ(tell(0, 7), 7);
  for (int i = 0; i < 100; ++i) EXPECT_EQ(tell(-0.001, 7), 7) << "noise is no direction";
  EXPECT_EQ(tell(0, 7, -1), -7) << "it was driven so";
  EXPECT_EQ(tell(0, 7, 0), 7) << "nobody knows";
}

TEST_F(TheWorstSpeed, IsTheReceiversSoonAfterTheEncodersFroze) {
  for (int i = 0; i < 100; ++i) (void)tell(0.5, 0.5);
  int cycles = 0;
  while (tell(0, 2) < 1 && cycles < 100) ++cycles;
  EXPECT_LE(cycles, 40);
}

TEST_F(TheWorstSpeed, HasTheWheelsSignWhereTheyTurn) {
  for (int i = 0; i < 100; ++i) EXPECT_EQ(tell(-0.5, 3), -3);
}

TEST_F(TheWorstSpeed, IsUnknownWithoutWheels) {
  EXPECT_TRUE(std::isnan(tell(std::numeric_limits<double>::quiet_NaN(), 3)));
}

}  // namespace
}  // namespace drover::engine
