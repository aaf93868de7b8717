#include "tests/unit/engine/clearance/clearance_fixture.h"

namespace drover::engine {
namespace {

TEST_F(AClearance, PermitsNothingBeforeTheFirstAnswer) {
  answers = false;
  tick(30);
  EXPECT_EQ(watch.caps().ahead_mps, 0);
  EXPECT_THAT(why(), HasSubstr("nothing is known yet"));
}

TEST_F(AClearance, PermitsWhatCanStopBeforeTheFirstThingEachWay) {
  found.ahead_m = stop_way(0.8, gentle);
  found.back_m = stop_way(0.5, gentle);
  tick(30);
  EXPECT_EQ(why(), "");
  EXPECT_NEAR(watch.caps().ahead_mps, 0.8, 0.01);
  EXPECT_NEAR(watch.caps().back_mps, 0.5, 0.01);
  EXPECT_GT(watch.caps().left_radps, 0.8);
}

TEST_F(AClearance, PermitsNothingAsideAsNobodyLooksThere) {
  tick(30);
  EXPECT_GT(watch.limit({0.3, 0}).vx_mps, 0.2);
  EXPECT_TRUE(is_zero(watch.limit({0.3, 0, 0.1})));
  EXPECT_TRUE(is_zero(watch.limit({0, 0, -0.1})));
  EXPECT_EQ(watch.rim_cap_mps({0, 0, 0.1}, 0.3), 0);
}

TEST_F(AClearance, TakesOffWhatWasDrivenSince) {
  found.ahead_m = 1;
  input.commanded = {0.5, 0};
  tick(31);  // the last one brought an answer
  answers = false;
  const double before_mps = watch.caps().ahead_mps;
  tick(8);
  EXPECT_LT(watch.caps().ahead_mps, before_mps - 0.005);
  EXPECT_EQ(why(), "");
}

TEST_F(AClearance, PermitsNothingWithAnAnswerThatIsTooOld) {
  tick(30);
  ASSERT_EQ(why(), "");
  answers = false;
  tick(40);
  EXPECT_EQ(watch.caps().ahead_mps, 0);
  EXPECT_EQ(watch.caps().left_radps, 0);
  EXPECT_THAT(why(), HasSubstr("was looked at 0."));
  EXPECT_FALSE(blocked()) << "it is not known that anything is there";
}

TEST_F(AClearance, PermitsNothingOnAnotherPath) {
  input.path = 8;
  tick(30);
  EXPECT_EQ(watch.caps().along_mps, 0);
  EXPECT_EQ(watch.caps().ahead_mps, 0);
  EXPECT_THAT(why(), HasSubstr("this track"));
  found.path = 8;
  tick(30);
  EXPECT_GT(watch.caps().along_mps, 0.8);
}

TEST_F(AClearance, PermitsNothingWhereNothingCanBeSaid) {
  found.unknown = "the lidar sees nothing: is its lens covered?";
  tick(30);
  EXPECT_EQ(watch.caps().ahead_mps, 0);
  EXPECT_THAT(why(), HasSubstr("lens"));
}

TEST_F(AClearance, PermitsNothingOfWhatIsNoNumber) {
  found.ahead_m = NAN;
  tick(30);
  EXPECT_EQ(watch.caps().ahead_mps, 0);
}

/// One answer that comes late is no obstacle: it is braked for, and driven on with the next one.
TEST_F(AClearance, PermitsNothingWithALateAnswerAndAllWithTheNext) {
  input.commanded = {0.5, 0};
  tick(31);
  answers = false;
  tick(12);  // it is 110 ms old
  EXPECT_EQ(watch.caps().ahead_mps, 0);
  EXPECT_EQ(watch.caps().left_radps, 0);
  EXPECT_EQ(why(), "");
  answers = true;
  count = 0;
  tick(1);
  EXPECT_GT(watch.caps().ahead_mps, 0.5);
}

/// A scene that takes 0.14 s for each look: the robot would stand without a word for ever.
TEST_F(AClearance, TellsOfAnswersThatAreLateOneAfterTheOther) {
  tick(30);
  ASSERT_EQ(why(), "");
  answers = false;
  const auto tick_late = [this](int cycles, Duration age) {
    for (int i = 0; i < cycles; ++i) {
      if (count++ % 8 == 0) {
        found.t = now - age;
        watch.on_clearance(found);
      }
      tick();
    }
  };
  tick_late(30, 105ms);
  EXPECT_EQ(why(), "") << "not yet";
  tick_late(40, 105ms);
  EXPECT_EQ(watch.caps().ahead_mps, 0);
  EXPECT_THAT(why(), HasSubstr("nobody looked for 0.15 s"));
  EXPECT_FALSE(blocked());
  tick_late(60, 20ms);
  EXPECT_EQ(why(), "");
  EXPECT_GT(watch.caps().ahead_mps, 0.5);
}

/// Each is in time when it comes, and too old before the next one does.
TEST_F(AClearance, TellsOfAnswersThatGrowTooOldInBetween) {
  answers = false;
  bool moved = false;
  for (int i = 0; i < 100; ++i) {
    if (i % 18 == 0) {  // each 90 ms, about 85 ms before
      found.t = now - 85ms;
      watch.on_clearance(found);
    }
    tick();
    moved = moved || (i > 80 && watch.caps().ahead_mps > 0);
  }
  EXPECT_THAT(why(), HasSubstr("nobody looked for 0.1"));
  EXPECT_FALSE(moved) << "it jerks";
}

TEST_F(AClearance, TellsABrokenConstraintUntilItHeldForASecond) {
  found.broken = "the fence of field_north: 0.20 m outside";
  tick(30);
  EXPECT_EQ(watch.broken(), found.broken);
  EXPECT_FALSE(blocked());
  EXPECT_EQ(watch.caps().back_mps, 0);
  found.broken.clear();
  tick(190);
  EXPECT_FALSE(watch.broken().empty());
  tick(40);
  EXPECT_TRUE(watch.broken().empty());
  EXPECT_GT(watch.caps().back_mps, 0.5);
}

TEST_F(AClearance, HandsOnWhatIsNoNumber) {
  tick(30);
  EXPECT_TRUE(std::isnan(watch.limit({NAN, 0}).vx_mps));
  EXPECT_TRUE(std::isnan(watch.limit({0.2, NAN}).wz_radps));
}

TEST(AClearanceThatIsNotRequired, PermitsEverything) {
  ClearanceWatch watch{ClearanceConfig{}, LimitsConfig{}, false};
  watch.update({.now = Time{1s}, .path = 3});
  EXPECT_EQ(watch.caps().along_mps, INFINITY);
  EXPECT_EQ(watch.limit({-0.8, 0.3}).vx_mps, -0.8);
  EXPECT_EQ(watch.rim_cap_mps({0, 0}, 0.3), INFINITY);
  EXPECT_TRUE(watch.unknown().empty() && watch.unasked().empty() && watch.blocked().empty());
}

TEST_F(AClearance, SlowsATwistAlongItsOwnCurve) {
  found.ahead_m = stop_way(0.4, gentle);
  tick(30);
  const Twist slower = watch.limit({0.8, 0.2});
  EXPECT_NEAR(slower.vx_mps, 0.4, 0.01);
  EXPECT_NEAR(slower.wz_radps, 0.1, 0.005);
  EXPECT_EQ(watch.limit({-0.8, 0.2}).vx_mps, -0.8);
  EXPECT_EQ(watch.limit({0, 0.5}).wz_radps, 0.5);
  found.right_rad = 0.02;
  tick(10);
  EXPECT_GT(watch.limit({0, -0.5}).wz_radps, -0.2);
  EXPECT_EQ(watch.limit({0, 0.5}).wz_radps, 0.5);
  found.unknown = "blind";
  tick(10);
  EXPECT_TRUE(is_zero(watch.limit({0.8, 0.2})));
  EXPECT_TRUE(is_zero(watch.limit({0, 0.2})));
}

TEST_F(AClearance, ForgetsAnAnswerOfATimeToCome) {
  Clearance early = found;
  early.t = now + 10s;
  watch.on_clearance(early);
  answers = false;
  tick(1);
  EXPECT_EQ(watch.caps().ahead_mps, 0);
  answers = true;
  tick(30);
  EXPECT_EQ(why(), "");
  EXPECT_GT(watch.caps().ahead_mps, 0.5);
}

TEST_F(AClearance, IgnoresAnAnswerThatIsOlderThanTheLast) {
  tick(30);
  Clearance older = found;
  older.t = now - 80ms;
  older.ahead_m = 100;
  found.ahead_m = 0.3;
  tick(10);
  watch.on_clearance(older);
  tick(1);
  EXPECT_LT(watch.caps().ahead_mps, 0.55);
}

}  // namespace
}  // namespace drover::engine
