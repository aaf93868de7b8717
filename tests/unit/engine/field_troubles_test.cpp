// What ordinarily goes wrong in a field, one thing with another: tasks bear it, and what is
// published holds.
#include <gtest/gtest.h>

#include "bench/field_world.h"
#include "support/seeds.h"

namespace drover {
namespace {

using bench::field_config;
using bench::field_rows;
using bench::FieldPlan;
using bench::FieldWorld;
using bench::Judgement;

/// An outage of 20 s with an antenna line 2 degrees off, which nobody knows yet.
TEST(AnAntennaLineThatIsMountedAskew, EndsNoTaskWhenTheReceiverIsBackAfterAnOutage) {
  for (std::uint64_t seed = 1; seed <= test::seeds(5); ++seed) {
    FieldPlan plan;
    plan.heading_off_deg = 2;
    plan.outage_s = {12, 32};
    engine::EngineConfig config = field_config();
    config.estimate.bound_run_m = 0.6;  // it drives on
    FieldWorld world(config, plan, seed);
    const Judgement end = world.drive(field_rows(1, 40), 300);
    EXPECT_TRUE(end.success) << seed << ": " << end.words;
    EXPECT_EQ(end.outside_s, 0) << seed;
  }
}

/// A shove, and positions 50 ms late, which still show some of it when it is over.
TEST(AShoveInAField, EndsNoTaskWherePositionsAreLate) {
  for (std::uint64_t seed = 1; seed <= test::seeds(10); ++seed) {
    FieldPlan plan;
    plan.gst = true;
    plan.late_s = 0.05;  // gnss_late_sigma_s is 0.1
    plan.shove_at_s = 12 + 0.3 * static_cast<double>(seed);
    plan.shove_left_m = seed % 2 == 0 ? -0.4 : 0.4;
    FieldWorld world(field_config(), plan, seed);
    const Judgement end = world.drive(field_rows(1, 40), 300);
    EXPECT_TRUE(end.success) << seed << ": " << end.words;
    EXPECT_EQ(end.outside_s, 0) << seed;
  }
}

/// What is known of the mounting and not made up for yet is still in the heading.
TEST(APublishedHeading, IsNotSaidToBeKnownBeforeTheMountingIsMadeUpFor) {
  for (std::uint64_t seed = 1; seed <= test::seeds(5); ++seed) {
    FieldPlan plan;
    plan.heading_off_deg = 2;
    FieldWorld world(field_config(), plan, seed);
    double worst = 0;
    const auto watch = [&](const Snapshot& seen, const Pose& truth, double since_s) {
      if (since_s < 0) return;
      const double error_rad = std::abs(wrap_rad(seen.pose.yaw_rad - truth.yaw_rad));
      worst = std::max(worst, error_rad / seen.pose.yaw_sigma_rad);
    };
    (void)world.drive(field_rows(2, 20), 300, watch);
    EXPECT_LE(worst, 3) << seed;
  }
}

/// Nothing shows it as long as there is no fix.
TEST(WheelsThatSlipInAnOutage, MoveNothingBeyondWhatIsPublished) {
  for (std::uint64_t seed = 1; seed <= test::seeds(6); ++seed) {
    FieldPlan plan;
    plan.gst = seed % 2 == 0;
    plan.outage_s = {20, 28};
    plan.slip_s = {20.5 + 0.5 * static_cast<double>(seed), 26};
    plan.slip_share = 0.35;
    FieldWorld world(field_config(), plan, seed);
    EXPECT_EQ(world.drive(field_rows(1, 40), 300).outside_s, 0) << seed;
  }
}

/// A fix that is lost while they slip says nothing against it.
TEST(WheelsThatSlip, EndNoTaskWhenTheFixIsLostForAMoment) {
  for (std::uint64_t seed = 1; seed <= test::seeds(10); ++seed) {
    FieldPlan plan;
    plan.gst = seed % 2 == 0;
    plan.slip_s = {15, 22};
    plan.slip_share = 0.28;
    plan.float_s = {17, 17.5 + 0.2 * static_cast<double>(seed)};
    FieldWorld world(field_config(), plan, seed);
    const Judgement end = world.drive(field_rows(1, 40), 300);
    EXPECT_TRUE(end.success) << seed << ": " << end.words;
    EXPECT_EQ(end.outside_s, 0) << seed;
  }
}

/// 5 cm for good, and nothing that could decide it: both places are inside of the corridor.
TEST(AnotherIntegerSolution, EndsNoTaskWhereBothPlacesAreInsideOfTheCorridor) {
  for (std::uint64_t seed = 1; seed <= test::seeds(5); ++seed) {
    FieldPlan plan;
    plan.gst = true;
    plan.step_s = {15, INFINITY};
    plan.step_m = 0.06 + 0.02 * static_cast<double>(seed);
    plan.step_rad = 1.3 * static_cast<double>(seed);
    FieldWorld world(field_config(), plan, seed);
    const Judgement end = world.drive(field_rows(2, 40), 400);
    EXPECT_TRUE(end.success) << seed << ": " << end.words;
    EXPECT_EQ(end.outside_s, 0) << seed;
    EXPECT_EQ(end.beyond_s, 0) << seed;
  }
}

/// The fix that is found again holds a minute: longer than navigate.locate_timeout_s by a little.
TEST(AFixThatIsFoundElsewhere, EndsNoTaskThatWaitsUntilItIsDecided) {
  for (std::uint64_t seed = 1; seed <= test::seeds(3); ++seed) {
    FieldPlan plan;
    plan.float_s = {15, 18};
    plan.slip_s = {15, 18};
    plan.slip_share = 0.35;
    FieldWorld world(field_config(), plan, seed);
    const Judgement end = world.drive(field_rows(1, 40), 400);
    EXPECT_TRUE(end.success) << seed << ": " << end.words;
    EXPECT_EQ(end.outside_s, 0) << seed;
  }
}

/// 15 cm off in any direction after a float.
TEST(AFixThatIsFoundElsewhere, IsNotBelievedAtOnce) {
  for (std::uint64_t seed = 1; seed <= test::seeds(6); ++seed) {
    FieldPlan plan;
    plan.gst = true;
    plan.float_s = {15, 18};
    plan.step_s = {16, 36};
    plan.step_m = 0.15;
    plan.step_rad = 1.05 * static_cast<double>(seed);
    FieldWorld world(field_config(), plan, seed);
    const Judgement end = world.drive(field_rows(1, 40), 400);
    EXPECT_TRUE(end.success) << seed << ": " << end.words;
    EXPECT_EQ(end.outside_s, 0) << seed;
  }
}

/// A float of a moment finds nothing anew: it is the same solution, and as wrong as before.
TEST(AFixThatIsFoundElsewhere, StaysInTheBoundWhenItIsLostForAMoment) {
  for (std::uint64_t seed = 1; seed <= test::seeds(6); ++seed) {
    FieldPlan plan;
    plan.gst = true;
    plan.float_s = {15, 18};
    plan.step_s = {17, INFINITY};
    plan.step_m = 0.18;
    plan.step_rad = 1.05 * static_cast<double>(seed);
    plan.more.push_back({bench::Trouble::Kind::floats, {85, 85.3}});
    FieldWorld world(field_config(), plan, seed);
    EXPECT_EQ(world.drive(field_rows(1, 90), 400).outside_s, 0) << seed;
  }
}

/// 70 cm off in any direction after a loss for which the task had to wait.
TEST(AFixThatIsFoundElsewhere, AfterAPauseForItTakesNothingOutOfTheCorridorOrTheBound) {
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    FieldPlan plan;
    plan.gst = seed % 2 == 0;
    plan.outage_s = {15, seed % 4 < 2 ? 45.0 : 42.0};
    plan.float_s = {plan.outage_s.to, 45};
    plan.step_s = {45, seed % 2 == 0 ? INFINITY : 75};
    plan.step_m = 0.7;
    plan.step_rad = kPi / 4 * static_cast<double>(seed);
    FieldWorld world(field_config(), plan, seed);
    const Judgement end = world.drive(field_rows(2, 20), 300);
    EXPECT_EQ(end.outside_s, 0) << seed << ": " << end.worst_outside_m;
    EXPECT_EQ(end.beyond_s, 0) << seed;
  }
}

/// How long it waited for a fix is no reason to wait shorter for what that is worth: a wrong one
/// that steps back within a minute ends no task.
TEST(AFixThatIsFoundElsewhere, HasItsOwnTimeAfterAPauseForIt) {
  for (std::uint64_t seed = 1; seed <= test::seeds(4); ++seed) {
    FieldPlan plan;
    plan.gst = seed % 2 == 0;
    plan.outage_s = {12, 62};
    plan.step_s = {62, 110};
    plan.step_m = 0.7;
    plan.step_rad = seed < 3 ? kPi / 2 : 0;  // no slip explains it
    FieldWorld world(field_config(), plan, seed);
    const Judgement end = world.drive(field_rows(1, 40), 400);
    EXPECT_TRUE(end.success) << seed << ": " << end.words;
    EXPECT_EQ(end.outside_s, 0) << seed;
    EXPECT_EQ(end.beyond_s, 0) << seed;
  }
}

/// Two minutes in which no fix stays for as long as a look takes; and for good.
TEST(AStandAndLook, EndsNoTaskWhileFixesComeAndGo) {
  for (std::uint64_t seed = 1; seed <= test::seeds(4); ++seed) {
    for (const bool for_good : {false, true}) {
      FieldPlan plan;
      plan.heading_off_deg = seed % 2 == 0 ? 4 : -4;
      const double until_s = for_good ? 500 : 140;
      for (double at_s = 16; at_s < until_s; at_s += 6)
        plan.more.push_back({bench::Trouble::Kind::floats, {at_s, at_s + 3.5}});
      FieldWorld world(field_config(), plan, seed);
      const Judgement end = world.drive(field_rows(1, 40), 600);
      EXPECT_EQ(end.success, !for_good) << seed << ": " << end.words;
      EXPECT_EQ(end.outside_s, 0) << seed;
      EXPECT_GT(end.paused_s, for_good ? 290 : 80) << seed << ": " << end.words;
    }
  }
}

/// A tape that was held to the wrong mark: before the first turn nothing shows it.
TEST(AnAntennaThatIsElsewhere, IsInTheBoundFromTheStart) {
  for (const double lever_m : {-0.2, 0.2}) {
    for (const bool aside : {false, true}) {
      FieldPlan plan;
      (aside ? plan.lever_y_m : plan.lever_x_m) = lever_m;
      plan.gst = true;
      FieldWorld world(field_config(), plan, 1);
      double bound_m = 0;
      const auto watch = [&](const Snapshot& seen, const Pose&, double) {
        bound_m = seen.nav.error_bound_m;
      };
      const Judgement end = world.drive(field_rows(2, 20), 300, watch);
      EXPECT_EQ(end.outside_s, 0) << lever_m << ' ' << aside << ": " << end.worst_outside_m;
      EXPECT_GT(bound_m, 0.15) << "where it is was told by then, and it is not made up for";
    }
  }
  FieldWorld world(field_config(), FieldPlan{.gst = true}, 1);
  double bound_m = 0;
  const auto watch = [&](const Snapshot& seen, const Pose&, double) {
    bound_m = seen.nav.error_bound_m;
  };
  (void)world.drive(field_rows(2, 20), 300, watch);
  EXPECT_LT(bound_m, 0.15) << "a turn showed that it is where it was said to be";
}

/// What they lost on the straight is beside the track in the turn behind it.
TEST(WheelsThatSlipInAnOutage, TakeNothingOutOfTheCorridorInTheNextTurn) {
  double driven_m = 0;
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    FieldPlan plan;
    plan.outage_s = {36, 66};
    plan.slip_s = {37, 44};
    plan.slip_share = 0.34;
    FieldWorld world(field_config(), plan, seed);
    const auto watch = [&](const Snapshot&, const Pose& truth, double since_s) {
      if (plan.outage_s.holds(since_s)) driven_m += truth.vx_mps * 0.005 / 4;
    };
    const Judgement end = world.drive(field_rows(2, 20), 300, watch);
    EXPECT_EQ(end.outside_s, 0) << seed;
    EXPECT_EQ(end.beyond_s, 0) << seed;
  }
  EXPECT_GT(driven_m, 3) << "the straight it drives on";
}

/// Two places, and the one that the receiver tells wanders on to the side.
TEST(AnotherIntegerSolution, ThatWandersMovesNothingBeyondWhatIsPublished) {
  double driven_m = 0;
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    FieldPlan plan;
    plan.gst = seed % 2 == 0;
    plan.step_s = {15, INFINITY};
    plan.step_m = 0.1;
    plan.step_rad = kPi / 2;
    plan.drift_m = {6, 60};
    plan.drift_mps = 0.01 + 0.01 * static_cast<double>(seed);
    FieldWorld world(field_config(), plan, seed);
    const auto watch = [&](const Snapshot&, const Pose& truth, double since_s) {
      if (since_s > 16) driven_m += truth.vx_mps * 0.005;
    };
    const Judgement end = world.drive(field_rows(1, 40), 400, watch);
    EXPECT_EQ(end.outside_s, 0) << seed;
    EXPECT_EQ(end.beyond_s, 0) << seed;
  }
  EXPECT_GT(driven_m, 6) << "it goes on until it may be outside of its corridor";
}

}  // namespace
}  // namespace drover
