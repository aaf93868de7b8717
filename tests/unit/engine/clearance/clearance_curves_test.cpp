// Curves that change, goals with a wall behind, turns: what an answer for another motion permits.
#include "tests/unit/engine/clearance/clearance_fixture.h"

namespace drover::engine {
namespace {

/// It may stop where both curves are still one, and comes no farther.
TEST_F(AClearance, PermitsOnAnotherCurveOnlyWhatStopsWhereBothAreStillOne) {
  input.commanded = {0.8, 0};
  tick(30);
  ASSERT_EQ(why(), "");
  answers = false;
  input.commanded = {0.8, 0.5};
  tick(1);
  const double stop_m = stop_way(watch.caps().ahead_mps, {0.28, limits.deceleration_mps2});
  const double bend_radpm = 0.5 / 0.8;
  EXPECT_GT(watch.caps().ahead_mps, 0.05);
  EXPECT_LE(bend_radpm * stop_m * (0.6 + stop_m / 2), 0.05);
  EXPECT_LT(watch.caps().ahead_mps, 0.3);
  EXPECT_FALSE(blocked()) << "it is not known that anything is there";
  answers = true;
  tick(20);
  EXPECT_GT(watch.caps().ahead_mps, 0.8) << "the new curve was looked along";
}

/// The wall behind a goal: the track was looked along and is free.
TEST_F(AClearance, SlowsNoTaskForWhatIsBehindItsGoal) {
  input.path = 7;
  found.along_m = INFINITY;
  for (const double behind_m : {0.5, 0.1}) {
    for (const double to_goal_m : {1.0, 0.8, 0.6, 0.4, 0.2, 0.1, 0.02}) {
      const double speed_mps = std::sqrt(2 * 0.4 * to_goal_m);  // as it brakes for a goal
      input.commanded = {std::min(speed_mps, 0.8), 0};
      // The answer is 55 ms old, and what was driven since is taken off.
      found.ahead_m = to_goal_m + behind_m + 0.06 * input.commanded.vx_mps;
      tick(30);
      EXPECT_FALSE(blocked()) << to_goal_m << " m, " << behind_m << " m";
      EXPECT_EQ(watch.limit(input.commanded).vx_mps, input.commanded.vx_mps)
          << to_goal_m << " m, " << behind_m << " m";
    }
  }
}

TEST_F(AClearance, StopsATaskThatLeavesItsTrackTowardsSomething) {
  input.path = 7;
  input.commanded = {0.8, 0};
  found.along_m = INFINITY;
  tick(30);
  found.ahead_m = stop_way(0.8, {0.28, limits.deceleration_mps2}) - 0.01;
  tick(10);
  EXPECT_TRUE(blocked());
  EXPECT_EQ(watch.caps().along_mps, 0);
}

/// At the end of a straight line into a bend the old curve leads off the track, and the new one is
/// not answered yet: what stands on the old one is no matter.
TEST_F(AClearance, StopsNoTaskForWhatIsOnACurveThatItLeft) {
  input.path = 7;
  input.commanded = {0.8, 0};
  tick(31);
  found.ahead_m = 0.5;
  found.t = now - 20ms;
  watch.on_clearance(found);
  answers = false;
  input.commanded = {0.8, 0.4};
  tick(1);
  EXPECT_FALSE(blocked());
  EXPECT_EQ(watch.limit(input.commanded).vx_mps, 0.8);
}

/// The same without a track: it is slowed, as nobody knows the new curve, but nothing is in its
/// way.
TEST_F(AClearance, TakesNothingForAnObstacleThatIsOnACurveThatWasLeft) {
  input.commanded = {0.8, 0};
  tick(31);
  found.ahead_m = 0.5;
  found.t = now - 20ms;
  watch.on_clearance(found);
  answers = false;
  input.commanded = {0.8, 0.4};
  tick(1);
  EXPECT_FALSE(blocked());
  EXPECT_LT(watch.limit(input.commanded).vx_mps, 0.5);
}

/// As a person steers: each answer is a little late for the curve, and nothing of it is felt.
TEST_F(AClearance, DoesNotSlowACurveThatChangesSteadily) {
  input.commanded = {1.2, 0};
  tick(30);
  for (int i = 0; i < 300; ++i) {
    input.commanded.wz_radps += 0.3 * 0.005;
    tick(1);
    ASSERT_GT(watch.caps().ahead_mps, 1.2) << i;
    ASSERT_EQ(why(), "");
  }
}

/// Its corners swing: after a turn the way ahead is another one than was looked along.
TEST_F(AClearance, PermitsNoWayAheadAfterATurnUntilThatWasLookedAlong) {
  input.commanded = {0, 1.2};
  tick(31);
  answers = false;
  tick(8);  // it turned by 6 degrees since its answer
  input.commanded = {};
  input.asked = {0.3, 0};
  tick(1);
  EXPECT_EQ(watch.caps().ahead_mps, 0);
  EXPECT_FALSE(blocked());
  answers = true;
  tick(31);
  EXPECT_GT(watch.caps().ahead_mps, 0.5);
}

TEST_F(AClearance, PermitsNoTurnElsewhereThanItWasLookedAround) {
  input.commanded = {0.8, 0};
  tick(36);
  EXPECT_EQ(watch.caps().left_radps, 0) << "it drove 6 cm since";
  input.commanded = {};
  tick(31);
  EXPECT_GT(watch.caps().left_radps, 0.5);
}

}  // namespace
}  // namespace drover::engine
