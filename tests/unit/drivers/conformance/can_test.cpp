// What every CAN drive of joints must do, whoever made it and however it is told. What is asked of
// everything on CAN that moves: can_wire_test.cpp; of what is told an impedance:
// impedance_test.cpp.
#include <gtest/gtest.h>

#include "support/describe.h"
#include "unit/drivers/conformance/can_movers.h"

namespace drover::test {
namespace {

class CanConformance : public ::testing::TestWithParam<Subject> {};

/// Told a velocity alone.
class CanVelocity : public CanConformance {};

constexpr auto kRun = AxisRequest::run;
constexpr auto kRest = AxisRequest::rest;

/// Where a stop damps, and lets nothing go, it may be told that: it may hold a weight, and only its
/// answers not come.
TEST_P(CanConformance, SendsNothingButItsStopToANodeThatWasNeverHeard) {
  CanBench bench(GetParam());
  bench.twin->set_power(false, bench.now);
  bench.run(milliseconds(500), kRest);
  bench.run(milliseconds(500), kRun, 1.0);
  const StopRecipe recipe = bench.actuator->stop_recipe();
  for (const CanFrame& frame : bench.sent) {
    const auto& frames = recipe.rounds[0].frames;
    const bool stop = recipe.ends == StopEnds::damps && frames.size() == 1 && frame == frames[0];
    EXPECT_EQ(bench.effect_of(frame), stop ? FrameEffect::stop : FrameEffect::harmless)
        << describe(frame);
  }
  EXPECT_EQ(bench.status.state, AxisState::unknown);
  EXPECT_EQ(bench.device->health(bench.now).state, SourceState::never_heard);
  expect_decent(bench);
}

TEST_P(CanConformance, NeverArmsByItselfWhileAtRest) {
  CanBench bench(GetParam());
  bench.run(milliseconds(2000), kRest);
  EXPECT_EQ(bench.status.state, AxisState::idle);
  EXPECT_EQ(bench.shaft.torque_Nm, 0.0);
  expect_decent(bench);
}

TEST_P(CanConformance, ReachesRunningAndFollowsTheVelocity) {
  CanBench bench(GetParam());
  bench.run(milliseconds(500), kRest);
  bench.run(milliseconds(1000), kRun, 0.0);
  ASSERT_EQ(bench.status.state, AxisState::running) << bench.status.reason.view();
  for (const double velocity_radps : {3.0, -2.0, 0.5}) {
    bench.run(milliseconds(1500), kRun, velocity_radps);
    EXPECT_NEAR(bench.shaft.velocity_radps, velocity_radps, 0.1 * std::abs(velocity_radps));
    EXPECT_NEAR(bench.motion.velocity_radps, velocity_radps, 0.1 * std::abs(velocity_radps));
  }
  const double before_rad = bench.motion.position_rad;
  const double truly_before_rad = bench.shaft.position_rad;
  bench.run(milliseconds(1000), kRun, 2.0);
  EXPECT_NEAR(bench.motion.position_rad - before_rad, bench.shaft.position_rad - truly_before_rad,
              0.1);
  expect_decent(bench);
}

/// Each with a speed of its own, or each turns the other's wheel.
TEST_P(CanConformance, TurnsEachChannelAsItIsTold) {
  CanBench bench(GetParam());
  bench.run(milliseconds(800), kRest);
  bench.run(milliseconds(1000), kRun, 0.0);
  const std::size_t count = bench.actuator->channels().size();
  for (int i = 0; i < 300; ++i) {
    bench.step(bench.wish(kRun),
               [](std::size_t channel) { return 1.0 + static_cast<double>(channel); });
  }
  for (std::size_t channel = 0; channel < count; ++channel) {
    const double told_radps = 1.0 + static_cast<double>(channel);
    EXPECT_NEAR(bench.shafts[channel].velocity_radps, told_radps, 0.1 * told_radps) << channel;
    EXPECT_NEAR(bench.motions[channel].velocity_radps, told_radps, 0.1 * told_radps) << channel;
  }
}

TEST_P(CanVelocity, StopsAtRestAndHoldsAgainstALoad) {
  CanBench bench(GetParam());
  bench.run(milliseconds(500), kRest);
  bench.run(milliseconds(2000), kRun, 3.0);
  bench.run(milliseconds(1000), kRest);
  EXPECT_NEAR(bench.shaft.velocity_radps, 0.0, 0.02);
  const double before_rad = bench.shaft.position_rad;
  bench.load_Nm = 4;  // a quarter of 60 kg on a slope of 15 %, radius 0.165 m
  bench.run(milliseconds(2000), kRest);
  EXPECT_NEAR(bench.shaft.position_rad, before_rad, 0.05 / 0.165);
  expect_decent(bench);
}

/// Its answers are lost, and it obeys: its own time-out would let go of the robot on a slope.
TEST_P(CanVelocity, IsHeldOnByADriverThatNeverHeardItWhereItHeld) {
  CanBench before(GetParam());
  if (before.actuator->stop_recipe().ends != StopEnds::holds)
    return;  // nothing of it holds without being measured
  before.run(milliseconds(500), kRest);
  before.run(milliseconds(1000), kRun, 0.0);
  before.load_Nm = 4;
  before.run(milliseconds(1000), kRest);
  ASSERT_TRUE(before.twin->set_fault("silent", before.now));
  for (const bool held : {true, false}) {
    CanBench bench(GetParam());
    bench.twin = std::move(before.twin);
    for (std::size_t i = 0; i < bench.shafts.size(); ++i) bench.shafts[i] = before.shafts[i];
    bench.now = before.now;
    bench.load_Nm = 4;
    bench.held = held;
    bench.device->on_link_up(bench.now);
    bench.run(milliseconds(2000), kRest);
    const auto stops = std::count_if(bench.sent.begin(), bench.sent.end(), [&](const auto& frame) {
      return bench.effect_of(frame) == FrameEffect::stop;
    });
    for (const CanFrame& frame : bench.sent)
      EXPECT_NE(bench.effect_of(frame), FrameEffect::motion) << describe(frame);
    if (held) {
      EXPECT_TRUE(bench.shaft.energized);
      EXPECT_NEAR(bench.shaft.velocity_radps, 0.0, 0.02);
      EXPECT_GT(stops, 0);
      bench.run(milliseconds(1500), AxisRequest::idle);
      bench.sent.clear();
      bench.run(milliseconds(500), AxisRequest::idle);
      for (const CanFrame& frame : bench.sent)
        EXPECT_EQ(bench.effect_of(frame), FrameEffect::harmless) << describe(frame);
    } else {
      EXPECT_EQ(stops, 0) << "nobody knows that it held";
    }
    before.twin = std::move(bench.twin);
    before.now = bench.now;
    for (std::size_t i = 0; i < bench.shafts.size(); ++i) before.shafts[i] = bench.shafts[i];
  }
}

TEST_P(CanConformance, GoesStaleWhenItsDeviceFallsSilent) {
  CanBench bench(GetParam());
  bench.run(milliseconds(500), kRest);
  bench.run(milliseconds(1000), kRun, 1.0);
  ASSERT_EQ(bench.device->health(bench.now).state, SourceState::fresh);
  EXPECT_TRUE(bench.device->health(bench.now).reason.empty());
  bench.twin->set_power(false, bench.now);
  bench.run(milliseconds(105), kRun, 1.0);
  EXPECT_EQ(bench.device->health(bench.now).state, SourceState::stale);
  EXPECT_FALSE(bench.device->health(bench.now).reason.empty());
  bench.run(milliseconds(400), kRun, 1.0);
  EXPECT_EQ(bench.status.state, AxisState::unknown);
  bench.moving.clear();
  bench.run(milliseconds(100), kRun, 1.0);
  for (const CanFrame& frame : bench.moving) ADD_FAILURE() << describe(frame);
}

TEST_P(CanConformance, ArmsAfterAPowerCycleOnlyByANewRequest) {
  CanBench bench(GetParam());
  bench.run(milliseconds(500), kRest);
  bench.run(milliseconds(1000), kRun, 1.0);
  bench.twin->set_power(false, bench.now);
  bench.run(milliseconds(600), kRun, 1.0);
  bench.twin->set_power(true, bench.now);
  bench.moving.clear();
  bench.run(milliseconds(3000), kRun, 1.0);
  EXPECT_NE(bench.status.state, AxisState::running);
  EXPECT_EQ(bench.shaft.torque_Nm, 0.0);
  for (const CanFrame& frame : bench.moving) ADD_FAILURE() << describe(frame);
  bench.run(milliseconds(100), kRest);
  bench.run(milliseconds(2000), kRun, 1.0);
  EXPECT_EQ(bench.status.state, AxisState::running) << bench.status.reason.view();
  EXPECT_NEAR(bench.shaft.velocity_radps, 1.0, 0.1);
  expect_decent(bench);
}

TEST_P(CanConformance, ArmsAfterANewLinkOnlyByANewRequest) {
  CanBench bench(GetParam());
  bench.run(milliseconds(500), kRest);
  bench.run(milliseconds(1000), kRun, 1.0);
  bench.device->on_link_up(bench.now);
  bench.moving.clear();
  bench.run(milliseconds(1000), kRun, 1.0);
  for (const CanFrame& frame : bench.moving) ADD_FAILURE() << describe(frame);
  bench.run(milliseconds(50), kRest);
  bench.run(milliseconds(1500), kRun, 1.0);
  EXPECT_EQ(bench.status.state, AxisState::running) << bench.status.reason.view();
}

/// Somebody who knows only the recipe has the bus from here on; without one nobody has. Returns
/// when the first shaft was at rest for good.
Duration play(CanBench& bench, const StopRecipe* recipe, Duration lasts) {
  bench.driver_alive = false;
  const Time begin = bench.now;
  Time moved = begin;
  Time next = begin;
  for (std::size_t rounds = 0; bench.now - begin < lasts;) {
    for (; recipe != nullptr && next <= bench.now; next += recipe->period, ++rounds)
      for (const CanFrame& frame : recipe->rounds[rounds % recipe->rounds.size()].frames)
        bench.send(frame);
    bench.step({});
    if (std::abs(bench.shaft.velocity_radps) > 0.05) moved = bench.now;
  }
  return moved - begin;
}

TEST_P(CanConformance, SaysHowItStopsAndTheRecipeStopsIt) {
  CanBench bench(GetParam());
  const StopRecipe recipe = bench.actuator->stop_recipe();
  ASSERT_FALSE(recipe.rounds.empty());
  EXPECT_GT(recipe.period, Duration{});
  EXPECT_LE(recipe.period, milliseconds(50));
  for (const StopRound& round : recipe.rounds) {
    EXPECT_FALSE(round.frames.empty());
    EXPECT_TRUE(round.packets.empty());
    for (const CanFrame& frame : round.frames) {
      EXPECT_TRUE(on_list(bench.actuator->rules(), frame)) << describe(frame);
      EXPECT_EQ(bench.effect_of(frame), FrameEffect::stop) << describe(frame);
    }
  }
  EXPECT_FALSE(bench.actuator->silence().text.empty());
  EXPECT_EQ(bench.actuator->silence().stops, bench.actuator->silence().after > Duration{});

  bench.run(milliseconds(500), kRest);
  bench.run(milliseconds(2000), kRun, 3.0);
  ASSERT_NEAR(bench.shaft.velocity_radps, 3.0, 0.3);
  // What lets go is left to friction, and to nothing else.
  const bool coasts = recipe.ends == StopEnds::coasts;
  const Duration within = milliseconds(coasts ? 10000 : 1000);
  const Duration by_recipe = play(bench, &recipe, within);
  EXPECT_LT(by_recipe, within);
  if (coasts) {
    EXPECT_EQ(bench.shaft.torque_Nm, 0.0);
  }

  CanBench alone(GetParam());
  alone.run(milliseconds(500), kRest);
  alone.run(milliseconds(2000), kRun, 3.0);
  EXPECT_LT(by_recipe, play(alone, nullptr, 2 * within)) << "it stops without the recipe";
  if (recipe.ends != StopEnds::holds) return;
  const double before_rad = bench.shaft.position_rad;
  bench.load_Nm = 4;
  play(bench, &recipe, milliseconds(2000));
  EXPECT_NEAR(bench.shaft.position_rad, before_rad, 0.05 / 0.165) << "let go instead of holding";
}

/// A frame that comes all the time, and without which it does not begin, is one without which it
/// does not go on: a speed that still comes says nothing of a fault.
TEST_P(CanConformance, GoesStaleWhenOneOfTheFramesThatItNeedsCeases) {
  const auto drive = [](CanBench& bench) {
    bench.run(milliseconds(1000), kRest);
    bench.run(milliseconds(1000), kRun, 3.0);
  };
  CanBench whole(GetParam());
  drive(whole);
  ASSERT_EQ(whole.status.state, AxisState::running);
  whole.ids.clear();
  whole.run(milliseconds(300), kRun, 3.0);
  for (const std::uint32_t id : whole.ids) {
    SCOPED_TRACE("frame " + std::to_string(id));
    CanBench without(GetParam());
    without.lost = id;
    drive(without);
    if (without.status.state == AxisState::running) continue;
    CanBench bench(GetParam());
    drive(bench);
    bench.lost = id;
    bench.run(milliseconds(600), kRun, 3.0);
    EXPECT_EQ(bench.device->health(bench.now).state, SourceState::stale);
    EXPECT_FALSE(bench.device->health(bench.now).reason.empty());
    EXPECT_NE(bench.status.state, AxisState::running);
    EXPECT_FALSE(bench.status.reason.empty());
    bench.moving.clear();
    bench.run(milliseconds(100), kRun, 3.0);
    for (const CanFrame& frame : bench.moving) ADD_FAILURE() << describe(frame);
  }
}

TEST_P(CanConformance, JudgesEveryRandomFrameWithoutCallingItAStopThatMoves) {
  // A frame that the driver calls stop, on its list, never makes the twin push.
  std::mt19937 random(7);
  CanBench bench(GetParam());
  bench.run(milliseconds(500), kRest);
  bench.run(milliseconds(2000), kRun, 0.0);
  std::vector<CanFrame> like = bench.sent;
  bench.driver_alive = false;
  for (int i = 0; i < 20000; ++i) {
    const CanFrame frame = random_frame(random, like);
    if (!on_list(bench.actuator->rules(), frame)) continue;
    const FrameEffect effect = bench.effect_of(frame);
    if (effect == FrameEffect::motion || effect == FrameEffect::forbidden) continue;
    bench.send(frame);
    bench.step({});
    ASSERT_LT(std::abs(bench.shaft.velocity_radps), 0.05) << describe(frame);
  }
}

TEST_P(CanConformance, StaysDecentThroughRandomHistories) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937 random(seed);
    CanBench bench(GetParam());
    Setpoint command = bench.wish(kRest);
    for (int i = 0; i < 600; ++i) {
      if (random() % 40 == 0) command.request = static_cast<AxisRequest>(random() % 4);
      if (random() % 20 == 0) command.velocity_radps = static_cast<double>(random() % 11) - 5.0;
      if (random() % 200 == 0) command.velocity_radps = kAbsent;
      if (random() % 100 == 0) bench.twin->set_power(random() % 2 == 0, bench.now);
      if (random() % 300 == 0) bench.device->on_link_up(bench.now);
      if (random() % 100 == 0) bench.twin->set_fault(random() % 2 ? "silent" : "", bench.now);
      bench.step(command);
    }
    expect_decent(bench);
  }
}

TEST_P(CanConformance, GivesTheSameForTheSame) {
  std::string texts[2];
  for (std::string& text : texts) {
    CanBench bench(GetParam());
    bench.run(milliseconds(300), kRest);
    for (int i = 0; i < 400; ++i) {
      bench.step(bench.wish(kRun, 0.01 * i));
      text += describe(bench.out, *bench.made.device);
      for (const CanFrame& frame : bench.out.frames) text += describe(frame);
    }
  }
  EXPECT_EQ(texts[0], texts[1]);
}

std::vector<Subject> joints() {
  std::vector<Subject> all = told(ChannelMode::velocity, movers());
  for (Subject& subject : told(ChannelMode::impedance, movers())) all.push_back(subject);
  return all;
}

INSTANTIATE_TEST_SUITE_P(Registry, CanConformance, ::testing::ValuesIn(joints()), label_of);
INSTANTIATE_TEST_SUITE_P(Registry, CanVelocity,
                         ::testing::ValuesIn(told(ChannelMode::velocity, movers())), label_of);

}  // namespace
}  // namespace drover::test
