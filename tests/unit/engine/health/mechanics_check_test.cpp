// The first way of a robot whose turns nothing shows but where its receiver goes: what is asked of
// it behind the swing, while that was not seen.
#include "engine/health/mechanics_check.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "drover/angle.h"
#include "unit/engine/engine_rig.h"

namespace drover::engine {
namespace {

using ::testing::HasSubstr;

EngineConfig unproved() {
  EngineConfig config = rig_config();
  config.navigate.first_way_m = 0.3;
  config.estimate.antenna_x_m = 0;
  return config;
}

/// Its wheels do what they are told, in the same cycle; its one antenna is over the middle.
class Robot {
 public:
  void rest_s(double seconds) { go_s(seconds, {}); }
  /// As it is guided; nobody else limits its speed.
  void go_s(double seconds, const Twist& wanted) {
    for (int i = 0; i < static_cast<int>(seconds * 100); ++i) cycle(wanted);
  }
  double turned_deg() const { return to_deg(by_wheels_rad_); }

  MechanicsCheck check{unproved()};
  double true_turn = 1;  ///< of what its wheels say; -1: the sides are swapped
  FixQuality fix = FixQuality::rtk_fixed;

 private:
  void cycle(const Twist& wanted) {
    constexpr double kDt_s = 0.01;
    now_ += from_s(kDt_s);
    const bool moves = wanted.vx_mps != 0;
    const Twist body = moves ? check.guide(wanted) : Twist{};
    by_wheels_rad_ += body.wz_radps * kDt_s;
    const double yaw_rad = true_turn * by_wheels_rad_;
    east_m_ += body.vx_mps * std::cos(yaw_rad) * kDt_s;
    north_m_ += body.vx_mps * std::sin(yaw_rad) * kDt_s;
    if (++cycles_ % 10 == 0) check.on_position(place(), now_);
    check.step({.now = now_,
                .dt = from_s(kDt_s),
                .body = body,
                .fastest_mps = std::abs(body.vx_mps),
                .commanded = moves,
                .asked_radps = body.wz_radps,
                .yaw_slip_factor = unproved().base.yaw_slip_factor,
                .yaw_rad = by_wheels_rad_});
  }
  /// On the equator, where a degree is as long to the east as to the north.
  GnssPosition place() const {
    GnssPosition position;
    position.quality = fix;
    position.latitude_deg = to_deg(north_m_ / 6371000.0);
    position.longitude_deg = to_deg(east_m_ / 6371000.0);
    position.sigma_north_m = position.sigma_east_m = 0.005;
    return position;
  }

  Time now_{std::chrono::seconds(100)};
  int cycles_ = 0;
  double by_wheels_rad_ = 0;
  double east_m_ = 0;
  double north_m_ = 0;
};

/// Its receiver has lost its fix with the first centimetre.
class BehindASwingThatNobodySaw : public ::testing::Test {
 protected:
  BehindASwingThatNobodySaw() {
    robot.rest_s(3);
    robot.fix = FixQuality::rtk_float;
    robot.go_s(100, {0.5, 0});
  }
  Robot robot;
};

TEST_F(BehindASwingThatNobodySaw, ItIsSteeredAgainAndStaysSlow) {
  ASSERT_NEAR(robot.turned_deg(), 0, 1) << "it swung to both sides and is straight again";
  EXPECT_THAT(robot.check.slowly(FirstWay::task).view(), HasSubstr("let it rest for two seconds"));
  const Twist left = robot.check.guide({0.5, 0.25});
  EXPECT_DOUBLE_EQ(left.vx_mps, 0.05);
  EXPECT_DOUBLE_EQ(left.wz_radps, 0.025) << "the same curve";
  const Twist back = robot.check.guide({-0.5, 0.25});
  EXPECT_DOUBLE_EQ(back.vx_mps, -0.05);
  EXPECT_DOUBLE_EQ(back.wz_radps, 0.025);
  robot.go_s(60, {0.5, 0.25});
  EXPECT_GT(robot.turned_deg(), 45) << "where nobody looked any more";
  EXPECT_DOUBLE_EQ(robot.check.speed_cap_mps(FirstWay::task), 0.05);
  EXPECT_FALSE(robot.check.proved());
}

/// Where it came to rest its fix is back.
TEST_F(BehindASwingThatNobodySaw, ItsNextWayIsAFirstOneAgain) {
  robot.rest_s(2);
  EXPECT_TRUE(robot.check.slowly(FirstWay::task).empty());
  robot.fix = FixQuality::rtk_fixed;
  robot.rest_s(2);
  robot.go_s(60, {0.5, 0});
  EXPECT_TRUE(robot.check.proved()) << robot.check.fault().view();
}

TEST_F(BehindASwingThatNobodySaw, ItsNextWayShowsThatItTurnsToTheOtherSide) {
  robot.fix = FixQuality::rtk_fixed;
  robot.true_turn = -1;
  robot.rest_s(3);
  robot.go_s(60, {0.5, 0});
  EXPECT_THAT(robot.check.fault().view(), HasSubstr("by where the receiver went -"));
  EXPECT_FALSE(robot.check.proved());
}

}  // namespace
}  // namespace drover::engine
