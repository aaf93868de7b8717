#include "engine/health/locate.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "drover/angle.h"

namespace drover::engine {
namespace {

using ::testing::HasSubstr;
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

class ALocateMonitor : public ::testing::Test {
 protected:
  ALocateMonitor() {
    estimate.has_position = estimate.has_heading = true;
    estimate.predicted_error_m = 0.03;
    estimate.yaw_error_rad = 0.01;
  }
  LocateState update(bool task = false, bool origin = true) {
    return monitor.update(estimate, origin, task);
  }
  std::string reason() { return std::string(monitor.reason().view()); }

  LocateMonitor monitor{EstimateConfig{}};
  Estimate estimate;
};

TEST_F(ALocateMonitor, IsNotInitialisedWithoutOriginPositionOrHeading) {
  EXPECT_EQ(update(false, false), LocateState::uninit);
  EXPECT_EQ(reason(), "no origin is set");
  estimate.has_heading = false;
  EXPECT_EQ(update(), LocateState::uninit);
  EXPECT_EQ(reason(), "no heading yet (with one antenna: drover heading find)");
  estimate.has_position = false;
  EXPECT_EQ(update(), LocateState::uninit);
  EXPECT_EQ(reason(), "no position yet");
  EXPECT_EQ(monitor.used(), 1);
}
TEST_F(ALocateMonitor, IsLostWhenAnErrorIsAbsentOrNotANumber) {
  estimate.predicted_error_m = kNan;
  EXPECT_EQ(update(), LocateState::lost);
  estimate.predicted_error_m = 0.01;
  estimate.yaw_error_rad = kNan;
  EXPECT_EQ(update(), LocateState::lost);
  estimate.yaw_error_rad = 0.01;
  estimate.pose.y_m = kNan;
  EXPECT_EQ(update(), LocateState::lost);
  EXPECT_THAT(reason(), HasSubstr("not a number"));
}
TEST_F(ALocateMonitor, IsLostWhenSourcesContradictEachOther) {
  estimate.disagrees = true;
  EXPECT_EQ(update(), LocateState::lost);
  EXPECT_THAT(reason(), HasSubstr("disagrees"));
}
TEST_F(ALocateMonitor, LetsATaskGoOnSlowlyWhereOnlyWayTellsTheHeading) {
  estimate.yaw_error_rad = to_rad(7.0);
  EXPECT_EQ(update(true), LocateState::lost) << "a receiver tells it";
  estimate.way_heals = true;
  EXPECT_EQ(update(true), LocateState::good) << "waiting brings nothing";
  EXPECT_EQ(monitor.used(), 1) << "slowly";
  EXPECT_EQ(update(false), LocateState::lost) << "nothing begins so";
  estimate.yaw_error_rad = to_rad(11.0);
  EXPECT_EQ(update(true), LocateState::lost);
  estimate.yaw_error_rad = to_rad(3.0);
  estimate.predicted_error_m = 1;
  EXPECT_EQ(update(true), LocateState::lost) << "the place has its own bound";
}
TEST_F(ALocateMonitor, IsLostBeyondTheBoundOfTheHeading) {
  estimate.yaw_error_rad = 0.1;
  EXPECT_EQ(update(), LocateState::lost);
  EXPECT_THAT(reason(), HasSubstr("5.7 degrees"));
}
TEST_F(ALocateMonitor, HasATighterBoundBeforeATaskThanDuringOne) {
  estimate.predicted_error_m = 0.2;
  EXPECT_EQ(update(false), LocateState::lost);
  EXPECT_THAT(reason(), HasSubstr("0.200 m, allowed 0.080 m"));
  EXPECT_EQ(update(true), LocateState::good);
  estimate.predicted_error_m = 0.26;
  EXPECT_EQ(update(true), LocateState::lost);
}
TEST_F(ALocateMonitor, TellsTheBoundOfTheHeadingThatCounts) {
  estimate.yaw_error_rad = to_rad(0.9 * EstimateConfig{}.bound_yaw_deg);
  EXPECT_EQ(update(false), LocateState::lost);
  EXPECT_THAT(reason(), HasSubstr("heading uncertain by 4.5 degrees, allowed 4.0"));
}
TEST_F(ALocateMonitor, DoesNotFlapAtTheBound) {
  estimate.predicted_error_m = 0.24;
  EXPECT_EQ(update(true), LocateState::lost) << "good only well inside";
  estimate.predicted_error_m = 0.2;
  EXPECT_EQ(update(true), LocateState::good);
  estimate.predicted_error_m = 0.24;
  EXPECT_EQ(update(true), LocateState::good);
  estimate.predicted_error_m = 0.26;
  EXPECT_EQ(update(true), LocateState::lost);
  estimate.predicted_error_m = 0.24;
  EXPECT_EQ(update(true), LocateState::lost);
}
TEST_F(ALocateMonitor, TellsHowMuchOfTheBudgetIsUsed) {
  estimate.predicted_error_m = 0.125;
  EXPECT_EQ(update(true), LocateState::good);
  EXPECT_NEAR(monitor.used(), 0.5, 1e-9);
  EXPECT_EQ(reason(), "");
}

}  // namespace
}  // namespace drover::engine
