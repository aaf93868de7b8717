// Which way a robot turned, by where its one antenna went.
#include "engine/health/place_turn.h"

#include <gtest/gtest.h>

#include <cmath>

#include "drover/angle.h"

namespace drover::engine {
namespace {

using Verdict = PlaceTurn::Verdict;

constexpr double kSigma_m = 0.01;

/// The antenna is over the middle. The wheels say that it turned to the left at once and went
/// straight on from there.
WheelsWay went(double ahead_m, double turn_deg) {
  return {ahead_m * std::sin(to_rad(turn_deg)), to_rad(turn_deg)};
}

/// Where a base is that truly turned so.
PathPoint place(double ahead_m, double turn_deg) {
  return {ahead_m * std::cos(to_rad(turn_deg)), ahead_m * std::sin(to_rad(turn_deg))};
}

/// Two places in succession, as a receiver tells them.
Verdict verdict(double ahead_m, double told_deg, double true_deg, double sigma_m = kSigma_m) {
  PlaceTurn turn;
  for (int i = 0; i < 2; ++i)
    turn.look(went(ahead_m, told_deg), place(ahead_m, true_deg), {}, sigma_m);
  return turn.verdict();
}

TEST(PlaceTurn, IsOpenBeforeItWentFarEnoughBehindTheTurn) {
  EXPECT_EQ(verdict(0.1, 12, 12), Verdict::open);
  EXPECT_EQ(verdict(0.1, 12, -12), Verdict::open);
}

TEST(PlaceTurn, IsOpenWhereTheWheelsTurnedByLittleHoweverFarAsideItWent) {
  EXPECT_EQ(verdict(0.5, 1, 20), Verdict::open);
}

TEST(PlaceTurn, IsOpenFarAwayAndBehindWideTurns) {
  EXPECT_EQ(verdict(1.6, 12, -12), Verdict::open) << "what wheels say of a turn adds up by then";
  EXPECT_EQ(verdict(1.0, 46, -46), Verdict::open);
}

TEST(PlaceTurn, IsOpenWherePlacesScatterMoreThanItWentAside) {
  EXPECT_EQ(verdict(0.5, 12, -12, 0.1), Verdict::open);
}

TEST(PlaceTurn, SaysWhichWayItWas) {
  EXPECT_EQ(verdict(0.5, 12, 12), Verdict::right);
  EXPECT_EQ(verdict(0.5, 12, -12), Verdict::against);
  EXPECT_EQ(verdict(0.5, -12, 12), Verdict::against);
  EXPECT_EQ(verdict(0.8, 30, 10), Verdict::right) << "soil took up most of it";
  EXPECT_EQ(verdict(0.8, 12, 0), Verdict::not_at_all);
}

/// One place that is just far enough aside may be an error of its own; one that is far aside is
/// none.
TEST(PlaceTurn, BelievesOnePlaceOnlyWhereItIsFarAside) {
  PlaceTurn near_by;
  near_by.look(went(0.3, 12), place(0.3, -12), {}, kSigma_m);
  EXPECT_EQ(near_by.verdict(), Verdict::open);
  near_by.look(went(0.3, 12), place(0.3, -12), {}, kSigma_m);
  EXPECT_EQ(near_by.verdict(), Verdict::against);
  PlaceTurn far_away;
  far_away.look(went(1, 30), place(1, -30), {}, kSigma_m);
  EXPECT_EQ(far_away.verdict(), Verdict::against);
}

TEST(PlaceTurn, TellsByHowMuchItTurned) {
  PlaceTurn turn;
  turn.look(went(1, 20), place(1, -20), {}, kSigma_m);
  EXPECT_NEAR(to_deg(turn.wheels_rad()), 20, 0.01);
  EXPECT_NEAR(to_deg(turn.turned_rad()), -20, 0.01);
}

/// An antenna ahead of the middle goes aside by the turn itself.
TEST(PlaceTurn, SeesATurnOnTheSpotByAnAntennaThatIsAhead) {
  AntennaConfig ahead;
  ahead.x_m = 0.5;
  PlaceTurn turn;
  for (int i = 0; i < 2; ++i)
    turn.look({0, to_rad(15)}, {0.5 * (std::cos(to_rad(15)) - 1), -0.5 * std::sin(to_rad(15))},
              ahead, kSigma_m);
  EXPECT_EQ(turn.verdict(), Verdict::against);
}

}  // namespace
}  // namespace drover::engine
