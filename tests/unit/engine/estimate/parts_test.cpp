// The small parts: wheels, history, jump watch, local frame, and the two measurement models.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "drover/angle.h"
#include "engine/estimate/history.h"
#include "engine/estimate/local_frame.h"
#include "engine/estimate/model_heading.h"

namespace drover::engine::estimate {
namespace {

using std::chrono::milliseconds;
constexpr Time kStart{std::chrono::seconds(50)};

TEST(History, SortsByTimeThenKind) {
  auto history = std::make_unique<History>();
  history->insert(kStart, AntennaPosition{});
  history->insert(kStart, YawInput{});
  history->insert(kStart - milliseconds(5), AntennaPosition{});
  history->insert(kStart, MotionInput{});
  ASSERT_EQ(history->size(), 4U);
  EXPECT_EQ(history->at(0).time, kStart - milliseconds(5));
  for (std::size_t i = 1; i < 4; ++i) EXPECT_EQ(history->at(i).input.index(), i - 1);
  EXPECT_EQ(history->find(kStart, 1), 2U);
  EXPECT_EQ(history->find(kStart + milliseconds(1), 1), 4U);
}

TEST(History, KnowsFromWhereToApplyAgain) {
  auto history = std::make_unique<History>();
  for (int i = 0; i < 10; ++i) history->insert(kStart + milliseconds(i), YawInput{});
  history->mark_clean();
  EXPECT_EQ(history->dirty(), 10U);
  history->insert(kStart + milliseconds(3), MotionInput{});
  EXPECT_EQ(history->dirty(), 3U);
  history->drop_oldest();
  EXPECT_EQ(history->dirty(), 2U);
}

TEST(JumpWatch, NeedsAnUnbrokenRun) {
  JumpWatch watch;
  watch.refused(kStart, false);
  watch.refused(kStart + milliseconds(900), true);
  EXPECT_FALSE(watch.disagrees(milliseconds(1000)));
  watch.refused(kStart + milliseconds(1000), false);
  EXPECT_TRUE(watch.disagrees(milliseconds(1000)));
  EXPECT_FALSE(watch.settled(milliseconds(1000)));
  watch.accepted();
  EXPECT_FALSE(watch.disagrees(milliseconds(1000)));
}

TEST(JumpWatch, SettlesOnAPlaceThatRepeats) {
  JumpWatch watch;
  watch.refused(kStart, false);
  EXPECT_TRUE(watch.new_place());
  watch.refused(kStart + milliseconds(1000), true);
  EXPECT_FALSE(watch.new_place());
  EXPECT_TRUE(watch.settled(milliseconds(1000)));
}

TEST(LocalFrame, GoesThereAndBack) {
  LocalFrame frame;
  frame.set_origin({.latitude_deg = -33.9, .longitude_deg = 151.2, .altitude_m = 20});
  const GeodeticPoint point = frame.geodetic({.x_m = 120, .y_m = -340}, 25);
  EXPECT_GT(point.longitude_deg, 151.2);
  EXPECT_LT(point.latitude_deg, -33.9);
  const PathPoint local = frame.local(point);
  EXPECT_NEAR(local.x_m, 120, 1e-6);
  EXPECT_NEAR(local.y_m, -340, 1e-6);
}

TEST(LocalFrame, TakesAnAbsurdAltitudeForTheOrigins) {
  LocalFrame frame;
  frame.set_origin({.latitude_deg = 48, .longitude_deg = 11, .altitude_m = 500});
  const PathPoint good =
      frame.local({.latitude_deg = 48.001, .longitude_deg = 11, .altitude_m = 500});
  for (const double bad : {1e12, std::nan("")}) {
    EXPECT_EQ(frame.local({.latitude_deg = 48.001, .longitude_deg = 11, .altitude_m = bad}).y_m,
              good.y_m);
  }
}

TEST(GnssModel, NeverTakesAnUnknownQualityForAGoodOne) {
  const EstimateConfig config;
  GnssPosition position;
  for (const int number : {1, 3, 9, 42}) {
    position.quality = static_cast<FixQuality>(number);
    EXPECT_EQ(class_of(position, config), GnssClass::single) << number;
  }
  for (const int number : {0, 6, 7, 8}) {
    position.quality = static_cast<FixQuality>(number);
    EXPECT_EQ(class_of(position, config), GnssClass::none) << number;
  }
}

TEST(GnssModel, TakesAFixWithOldCorrectionsForAFloat) {
  const EstimateConfig config;
  GnssPosition position;
  position.quality = FixQuality::rtk_fixed;
  EXPECT_EQ(class_of(position, config), GnssClass::fixed);  // age not given
  position.correction_age_s = 30;
  EXPECT_EQ(class_of(position, config), GnssClass::fixed);
  position.correction_age_s = 30.1;
  EXPECT_EQ(class_of(position, config), GnssClass::floating);
}

TEST(GnssModel, BelievesAReceiverThatSaysItIsWorseNotBetter) {
  const EstimateConfig config;
  const double floor = config.gnss_inflation * config.sigma_fixed_m;
  for (const double claimed : {0.001, -1.0, std::nan(""), HUGE_VAL}) {
    EXPECT_EQ(sigma_m(GnssClass::fixed, claimed, config), floor) << claimed;
  }
  EXPECT_EQ(sigma_m(GnssClass::fixed, 0.05, config), config.gnss_inflation * 0.05);
}

AntennaPosition fixed_at(double x_m, double y_m) {
  return {.x_m = x_m,
          .y_m = y_m,
          .quality = GnssClass::fixed,
          .sigma_x_m = 0.0125,
          .sigma_y_m = 0.0125};
}

TEST(GnssModel, TurnsTheBaseTowardsAnAntennaThatIsAside) {
  EstimateConfig config;
  config.antenna_x_m = 0.3;
  config.antenna_y_m = 0.4;
  for (const bool sideways : {true, false}) {
    State state;
    state.time = kStart;
    state.has_position = state.has_heading = true;
    state.belief.reset(kYaw, 0, 0.1);
    state.belief.reset(kX, 0, 1e-3);  // the place is known, so only the yaw can be wrong
    state.belief.reset(kY, 0, 1e-3);
    // 0.1 rad to the left moves the antenna by (-0.04, +0.03).
    apply(state, sideways ? fixed_at(0.3, 0.43) : fixed_at(0.26, 0.4), {}, config);
    EXPECT_GT(state.belief.mean[kYaw], 0.02) << sideways;
    EXPECT_LT(state.belief.mean[kYaw], 0.1) << sideways;
  }
}

TEST(GnssModel, LearnsNothingFromHearingTheFirstPositionAgain) {
  const EstimateConfig config;
  State state;
  state.time = kStart;
  apply_heading(state, 0, config);
  for (int i = 0; i < 20; ++i) apply(state, fixed_at(1, 2), {}, config);
  EXPECT_TRUE(state.has_position);
  EXPECT_GE(std::sqrt(state.belief.covariance[kX][kX]), 0.0124);
  EXPECT_GE(std::sqrt(state.belief.covariance[kY][kY]), 0.0124);
  EXPECT_NEAR(state.belief.mean[kX], 1, 1e-9);
}

// Source of the pairs: heading 90, offset 0 -> 0; 0, 0 -> 90; 270, 90 -> -90; 359.9, 180 -> -89.9.
TEST(HeadingModel, TurnsACompassBaselineIntoYaw) {
  AntennaConfig antenna;
  EXPECT_NEAR(to_deg(yaw_of_baseline_rad(90, antenna)), 0, 1e-9);
  EXPECT_NEAR(to_deg(yaw_of_baseline_rad(0, antenna)), 90, 1e-9);
  antenna.heading_baseline_offset_deg = 90;
  EXPECT_NEAR(to_deg(yaw_of_baseline_rad(270, antenna)), -90, 1e-9);
  antenna.heading_baseline_offset_deg = 180;
  EXPECT_NEAR(to_deg(yaw_of_baseline_rad(359.9, antenna)), -89.9, 1e-9);
}

TEST(HeadingModel, WeighsABurstLikeOne) {
  const EstimateConfig config;
  State state;
  state.time = kStart;
  apply_heading(state, 0.1, config);
  ASSERT_TRUE(state.has_heading);
  const double before = state.belief.covariance[kYaw][kYaw];
  for (int i = 0; i < 10; ++i) apply_heading(state, 0.1, config);
  EXPECT_GT(state.belief.covariance[kYaw][kYaw], 0.5 * before);
}

}  // namespace
}  // namespace drover::engine::estimate
