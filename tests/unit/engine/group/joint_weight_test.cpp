// What a held joint that carries a weight lets go of what it pressed with, and how far it sinks.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "engine/group/joint_shaper.h"
#include "unit/engine/group/arm_joint.h"
#include "unit/engine/group/shaped_joint.h"

namespace drover::engine {
namespace {

constexpr double kBit_rad = 25.0 / 65535;

/// A bar with something in its way, which it was told to go beyond.
struct WeightTest : ::testing::Test {
  WeightTest() {
    joint.state = AxisState::running;
    joint.position_rad = 0.1;
    shaper.take_over(measured());
  }
  /// As its drive tells it.
  JointMeasured measured() const {
    return {kBit_rad * std::round(joint.position_rad / kBit_rad), joint.velocity_radps,
            joint.torque_Nm};
  }
  void move() {
    joint.obey({AxisRequest::run, shaper.velocity_radps(), shaper.impedance()});
    for (int k = 0; k < 5; ++k) joint.step(kCycle_s / 5);
    places.push_back(joint.position_rad);
    fastest_radps = std::max(fastest_radps, std::abs(joint.velocity_radps));
  }
  void follow_s(double seconds, double position_rad, double effort_Nm = 0) {
    JointTarget target = at(position_rad);
    target.effort_Nm = effort_Nm;
    for (int i = 0; i < static_cast<int>(seconds / kCycle_s); ++i) {
      shaper.follow(target, measured(), kCycle_s);
      move();
    }
    places.clear();
    fastest_radps = 0;
  }
  void hold_s(double seconds) {
    for (int i = 0; i < static_cast<int>(seconds / kCycle_s); ++i) {
      shaper.hold(measured(), kCycle_s);
      move();
    }
  }
  double weight_Nm() const { return joint.weight_Nm * std::cos(joint.position_rad); }
  /// The way up is that against its weight.
  double sank_rad(double from_rad) const {
    double sank = 0;
    for (const double place : places) sank = std::max(sank, up * (from_rad - place));
    return sank;
  }
  double rose_rad(double from_rad) const {
    double rose = 0;
    for (const double place : places) rose = std::max(rose, up * (place - from_rad));
    return rose;
  }
  /// Times that it turned round by more than its drive can tell.
  int turns() const {
    int turns = 0;
    double way = 0;
    double farthest = places.front();
    for (const double place : places) {
      if (way * (place - farthest) >= 0 && way != 0) {
        farthest = place;
      } else if (std::abs(place - farthest) > kBit_rad) {
        turns += way != 0 ? 1 : 0;
        way = std::copysign(1.0, place - farthest);
        farthest = place;
      }
    }
    return turns;
  }
  void mirror() {
    up = -1;
    joint.weight_Nm = -joint.weight_Nm;
    joint.position_rad = -joint.position_rad;
    shaper.take_over(measured());
  }
  void stop_above(double rad) { (up > 0 ? joint.stop_rad : joint.low_stop_rad) = up * rad; }
  void stop_below(double rad) { (up > 0 ? joint.low_stop_rad : joint.stop_rad) = up * rad; }
  void free() {
    joint.stop_rad = 10;
    joint.low_stop_rad = -10;
  }

  double up = 1;
  ArmJoint joint;
  JointShaper shaper{carries(rules_of(JointFollows::impedance))};
  std::vector<double> places;
  double fastest_radps = 0;
};

struct JointWeightOf : WeightTest, ::testing::WithParamInterface<bool> {
  JointWeightOf() {
    if (GetParam()) mirror();
  }
};
INSTANTIATE_TEST_SUITE_P(Either, JointWeightOf, ::testing::Bool(),
                         [](const auto& one) { return one.param ? "Down" : "Up"; });

TEST_P(JointWeightOf, IsCarriedOnWhileWhatPressedBesidesIsLetGo) {
  stop_above(0.2);
  follow_s(3, up * 0.28);
  const double pressed = std::abs(joint.stop_Nm());
  ASSERT_GT(pressed, 1.5);
  const double place = joint.position_rad;
  hold_s(10);
  RecordProperty("presses_mNm", static_cast<int>(1000 * std::abs(joint.stop_Nm())));
  EXPECT_LT(std::abs(joint.stop_Nm()), 0.1) << "of " << pressed;
  EXPECT_NEAR(joint.position_rad, place, 0.003);
  EXPECT_LT(sank_rad(place), 0.006);
  free();
  places.clear();
  fastest_radps = 0;
  hold_s(3);
  EXPECT_LT(rose_rad(place), 0.003) << "it was still pressed";
  EXPECT_LT(sank_rad(place), 0.003) << "its weight was let go as well";
  EXPECT_LT(fastest_radps, 0.1);
}

/// A person's arm.
TEST_P(JointWeightOf, IsCarriedOnBesideSomethingSoft) {
  joint.stop_Nmprad = 120;
  stop_above(0.2);
  follow_s(3, up * 0.28);
  const double pressed = std::abs(joint.stop_Nm());
  ASSERT_GT(pressed, 0.9);
  hold_s(15);
  EXPECT_LT(std::abs(joint.stop_Nm()), 0.35 * pressed);
  free();
  hold_s(3);
  EXPECT_NEAR(std::abs(joint.torque_Nm), std::abs(weight_Nm()), 0.05);
}

TEST_P(JointWeightOf, IsNotPressedOntoWhatItLiesOn) {
  stop_below(-0.05);
  follow_s(3, up * -0.1, up * -1.0);
  ASSERT_GT(std::abs(joint.stop_Nm()), std::abs(weight_Nm()) + 1.5);
  hold_s(14);
  EXPECT_LT(std::abs(joint.stop_Nm()), std::abs(weight_Nm()) + 0.05);
}

TEST_P(JointWeightOf, SinksByNextToNothingMeanwhile) {
  for (const double rubs_Nm : {0.0, 0.1}) {
    joint.rubs_Nm = rubs_Nm;
    follow_s(3, up * 0.1, up * 1.5);
    const double place = joint.position_rad;
    hold_s(20);
    RecordProperty("sank_urad", static_cast<int>(1e6 * sank_rad(place)));
    EXPECT_LT(sank_rad(place), 0.006) << "0.04 without any effort";
    EXPECT_LT(rose_rad(place), 0.002);
    // What rubs lets it rest where it is anywhere within 0.005 rad.
    EXPECT_LT(std::abs(joint.position_rad - place), rubs_Nm > 0 ? 0.006 : 0.001);
    EXPECT_LE(turns(), 2) << "down, up, and it rests";
    places.clear();
    hold_s(60);
    EXPECT_LT(sank_rad(joint.position_rad), 0.0005) << "it rests";
  }
}

/// While it presses most.
TEST_P(JointWeightOf, DoesNotJumpWhenWhatIsInItsWayIsGone) {
  for (const double after_s : {0.0, 0.5, 1.0, 2.0, 4.0}) {
    free();
    stop_above(0.2);
    follow_s(3, up * 0.28);
    const double place = joint.position_rad;
    hold_s(after_s);
    free();
    hold_s(15);
    EXPECT_LT(fastest_radps, 1) << after_s;
    EXPECT_NEAR(joint.position_rad, place, 0.004) << after_s;
    EXPECT_LT(sank_rad(place), 0.006) << after_s;
    EXPECT_NEAR(std::abs(joint.torque_Nm), std::abs(weight_Nm()), 0.05);
  }
}

/// Its encoder may stand: what it measures says nothing of a weight.
TEST_P(JointWeightOf, IsWhatItWasWhereNothingMovesToTheBit) {
  follow_s(3, up * 0.1, up * 1.5);
  joint.rests = true;
  const double carried = joint.torque_Nm;
  double least = std::abs(carried);
  for (int i = 0; i < 2000; ++i) {
    hold_s(kCycle_s);
    least = std::min(least, std::abs(joint.torque_Nm));
  }
  EXPECT_GT(least, std::abs(carried) - 0.25 * 4);
  EXPECT_NEAR(joint.torque_Nm, carried, 0.01);
}

/// Of a base that drives on, or of what swings on it.
TEST_P(JointWeightOf, IsFoundWhileItIsShaken) {
  stop_above(0.3);
  follow_s(3, up * 0.1, up * 1.5);
  const double place = joint.position_rad;
  for (int i = 0; i < 4000; ++i) {
    joint.push_Nm = 0.4 * std::sin(2 * 3.14159 * 3 * i * kCycle_s);
    hold_s(kCycle_s);
  }
  joint.push_Nm = 0;
  hold_s(2);
  EXPECT_NEAR(joint.position_rad, place, 0.006);
  EXPECT_LT(sank_rad(place), 0.035);
}

}  // namespace
}  // namespace drover::engine
