// What is learned of the antenna: how late its positions and headings are, and where it is.
#include <gtest/gtest.h>

#include <cmath>

#include "drover/angle.h"
#include "engine/estimate/antenna_fit.h"
#include "engine/estimate/filter.h"
#include "engine/estimate/heading_late.h"

namespace drover::engine::estimate {
namespace {

constexpr double kStep_s = 0.1;

/// A base that drives exactly as it says, with an antenna that is late and elsewhere.
class AnAntenna : public testing::Test {
 protected:
  AnAntenna() : fit(config) {}

  void drive(double mps, double radps, double for_s) {
    for (double s = 0; s < for_s - kStep_s / 2; s += kStep_s) {
      const double speed_mps = at_mps_ + (mps - at_mps_) * std::min(1.0, kStep_s / 0.5);
      yaw_rad_ += radps * kStep_s;
      const double way_m = speed_mps * kStep_s;
      const double east_m = way_m * std::cos(yaw_rad_);
      const double north_m = way_m * std::sin(yaw_rad_);
      x_m_ += east_m;
      y_m_ += north_m;
      at_mps_ = speed_mps;
      fit.advance(east_m * told_share, north_m * told_share, std::abs(way_m),
                  std::abs(radps) * kStep_s);
      now_ += from_s(kStep_s);
      const double c = std::cos(yaw_rad_);
      const double s_ = std::sin(yaw_rad_);
      AntennaPoint point;
      point.time = now_;
      point.vx_mps = speed_mps * c;
      point.vy_mps = speed_mps * s_;
      point.x_m = x_m_ + ahead_m * c - left_m * s_ - late_s * point.vx_mps;
      point.y_m = y_m_ + ahead_m * s_ + left_m * c - late_s * point.vy_mps;
      point.yaw_rad = yaw_rad_;
      point.white_m = 0.006;
      point.slow_m = 0.0125;
      fit.hear(point, config);
    }
  }
  void rows() {
    drive(0, 0, 3);
    drive(0.5, 0, 20);
    drive(0.5, 0.33, kPi / 0.33);
    drive(0.5, 0, 20);
    drive(0.5, -0.33, kPi / 0.33);
    drive(0, 0, 3);
  }

  EstimateConfig config;
  AntennaFit fit;
  double late_s = 0;
  double ahead_m = 0;  ///< farther than configured
  double left_m = 0;
  double told_share = 1;

 private:
  Time now_{std::chrono::seconds(10)};
  double x_m_ = 0, y_m_ = 0, yaw_rad_ = 0.4, at_mps_ = 0;
};

TEST_F(AnAntenna, ThatIsWhereItShouldBeIsNothingToTellOf) {
  rows();
  EXPECT_FALSE(fit.late_known());
  EXPECT_FALSE(fit.arm_wrong());
  EXPECT_NEAR(fit.late_s(), 0, 0.01);
}

TEST_F(AnAntenna, IsLateByWhatShowsWhenTheSpeedChanges) {
  late_s = 0.2;
  drive(0, 0, 3);
  EXPECT_NEAR(fit.late_sigma_s(), config.gnss_late_sigma_s, 0.02) << "at rest nothing tells";
  drive(0.5, 0, 6);
  EXPECT_NEAR(fit.late_used_s(), 0.2, 0.04);
  EXPECT_NEAR(fit.late_s(), 0.2, fit.late_doubt_s());
  EXPECT_FALSE(fit.late_known()) << "once is no proof";
  rows();
  EXPECT_TRUE(fit.late_known());
  EXPECT_NEAR(fit.late_s(), 0.2, 0.03);
  EXPECT_FALSE(fit.arm_wrong());
}

TEST_F(AnAntenna, IsLateByAsMuchWhenItIsDrivenBackwards) {
  late_s = 0.2;
  drive(0, 0, 3);
  for (int i = 0; i < 3; ++i) {
    drive(-0.5, 0, 6);
    drive(0, 0, 4);
  }
  EXPECT_TRUE(fit.late_known());
  EXPECT_NEAR(fit.late_s(), 0.2, 0.03);
}

TEST_F(AnAntenna, KeepsADelayThatIsRecalledUntilSeveralChangesOfSpeedContradictIt) {
  fit.recall_late(0.2, 0.006);
  late_s = 0.2;
  drive(0, 0, 3);
  drive(0.5, 0, 6);
  EXPECT_TRUE(fit.late_known());
  late_s = 0;
  for (int i = 0; i < 4; ++i) {
    drive(0, 0, 4);
    drive(0.5, 0, 6);
  }
  EXPECT_FALSE(fit.late_known());
  EXPECT_NEAR(fit.late_s(), 0, 0.03);
}

TEST_F(AnAntenna, IsNotLateBecauseItsWheelsSlippedAtAStart) {
  drive(0, 0, 3);
  told_share = 1.2;
  drive(0.5, 0, 3);
  told_share = 1;
  drive(0.5, 0, 6);
  EXPECT_FALSE(fit.late_known());
  EXPECT_LT(fit.late_s(), 0.15);
  EXPECT_LT(fit.late_s(), 4 * fit.late_doubt_s()) << "the bound has room for it";
  rows();
  EXPECT_NEAR(fit.late_s(), 0, 0.06);
  rows();
  EXPECT_NEAR(fit.late_s(), 0, 0.03);
}

TEST_F(AnAntenna, IsLearnedOfNothingThatASuspicionFollows) {
  drive(0, 0, 3);
  told_share = 1.3;
  drive(0.5, 0, 2);
  fit.pause();
  told_share = 1;
  drive(0.5, 0, 6);
  EXPECT_NEAR(fit.late_s(), 0, 0.01);
}

TEST_F(AnAntenna, IsElsewhereByWhatShowsInTurns) {
  for (const auto& [ahead, left] : {std::pair{0.2, 0.0}, std::pair{0.0, -0.2}}) {
    fit = AntennaFit(config);
    ahead_m = ahead;
    left_m = left;
    drive(0, 0, 3);
    drive(0.5, 0, 20);
    EXPECT_FALSE(fit.arm_wrong()) << "straight ahead nothing tells";
    rows();
    EXPECT_TRUE(fit.arm_wrong()) << ahead << ' ' << left;
    EXPECT_NEAR(fit.ahead_m(), ahead, 0.04);
    EXPECT_NEAR(fit.left_m(), left, 0.04);
    EXPECT_FALSE(fit.late_known());
  }
}

TEST_F(AnAntenna, IsLearnedAnewWhenItWasKnockedAside) {
  for (int i = 0; i < 4; ++i) rows();
  EXPECT_FALSE(fit.arm_wrong());
  ahead_m = -0.3;
  left_m = 0.3;
  for (int i = 0; i < 4; ++i) rows();
  EXPECT_TRUE(fit.arm_wrong());
  EXPECT_NEAR(fit.ahead_m(), -0.3, 0.05);
  EXPECT_NEAR(fit.left_m(), 0.3, 0.05);
}

TEST_F(AnAntenna, IsNotElsewhereBecauseWheelsAreWorn) {
  told_share = 1.03;
  rows();
  EXPECT_FALSE(fit.arm_wrong());
  EXPECT_FALSE(fit.late_known());
}

TEST_F(AnAntenna, IsNotLearnedOfWhatJumps) {
  rows();
  const double before_s = fit.late_s();
  late_s = 40;  // 20 m
  drive(0.5, 0, 2);
  EXPECT_NEAR(fit.late_s(), before_s, 0.01);
}

TEST_F(AnAntenna, ThatWasCalibratedStaysSo) {
  config.gnss_late_sigma_s = 0;
  fit = AntennaFit(config);
  late_s = 0.1;
  rows();
  EXPECT_EQ(fit.late_sigma_s(), 0);
  EXPECT_EQ(fit.late_s(), 0);
}

/// Turns there and back; headings of a while ago.
double learned_of_headings(double late_s, double jerks_rad = 0) {
  const EstimateConfig config;
  HeadingLate late(config);
  double yaw_rad = 0;
  const auto rate = [](double t) { return 0.33 * std::sin(2 * kPi * t / 20); };
  const auto yaw_at = [](double t) {
    return 0.33 * 20 / (2 * kPi) * (1 - std::cos(2 * kPi * t / 20));
  };
  late.begin(yaw_at(-late_s));
  for (int i = 1; i <= 400; ++i) {
    const double t = 0.1 * i;
    const double before_rad = yaw_rad;
    yaw_rad = yaw_at(t) + jerks_rad * (i % 2 == 0 ? 1 : -1);
    late.hear(wrap_rad(yaw_at(t - late_s)), yaw_rad - before_rad, 0.1, config);
  }
  EXPECT_NEAR(late.lag_rad(), rate(40) * late_s, 0.02);
  EXPECT_EQ(late.known(), late_s > 0.03) << late_s << ": " << late.late_s();
  return late.late_s();
}

TEST(LateHeadings, AreFoundInTurns) {
  for (const double late_s : {0.0, 0.1, 0.2, 0.35})
    EXPECT_NEAR(learned_of_headings(late_s), late_s, 0.02) << late_s;
}

TEST(LateHeadings, AreFoundThoughTheBaseJerks) {
  EXPECT_NEAR(learned_of_headings(0.2, 0.002), 0.2, 0.03);
}

}  // namespace
}  // namespace drover::engine::estimate
