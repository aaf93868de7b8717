// What every CAN drive of joints must do, whoever made it and however it is told, and what
// everything on CAN that moves must. What is told an impedance has more: impedance_test.cpp.
#include <gtest/gtest.h>

#include "support/describe.h"
#include "unit/drivers/conformance/harness.h"

namespace drover::test {
namespace {

class CanConformance : public ::testing::TestWithParam<Subject> {
 protected:
  void expect_decent(const CanBench& bench) {
    EXPECT_EQ(bench.off_list, 0) << "sent outside its own allow-list";
    EXPECT_EQ(bench.forbidden, 0) << "sent what it calls forbidden itself";
    EXPECT_EQ(bench.motion_at_rest, 0) << "sent motion while asked to rest";
    EXPECT_EQ(bench.allocations, 0U) << "allocated memory in on_frame, on_setpoints or on_tick";
    EXPECT_EQ(bench.overflows, 0U);
  }
};

/// Told a velocity alone.
class CanVelocity : public CanConformance {};

/// Whatever it is told.
class CanWire : public CanConformance {};

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

TEST_P(CanWire, NamesTheChannelsThatItsEntryNames) {
  CanBench bench(GetParam());
  const auto made = bench.actuator->channels();
  const auto named = GetParam().entry->channels;
  ASSERT_EQ(made.size(), named.size());
  ASSERT_FALSE(made.empty());
  for (std::size_t i = 0; i < made.size(); ++i) {
    EXPECT_EQ(made[i].name, named[i].name);
    EXPECT_EQ(made[i].mode, named[i].mode);
  }
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

TEST_P(CanWire, IgnoresItsFramesUnderAForeignFlag) {
  CanBench bench(GetParam());
  for (CanFrame frame : golden_frames(*GetParam().entry)) {
    for (int i = 0; i < 3; ++i) {
      CanFrame foreign = frame;
      if (i == 0) foreign.extended = !foreign.extended;
      if (i == 1) foreign.fd = true;
      if (i == 2) foreign.error = true;
      if (foreign == frame) continue;
      const bool was_not_its_own = i == 0 && frame.extended;
      if (was_not_its_own) continue;
      bench.inject(foreign);
      EXPECT_TRUE(bench.out.measurements.empty()) << describe(foreign);
    }
  }
  EXPECT_EQ(bench.device->health(bench.now).good, 0U);
  EXPECT_EQ(bench.device->health(bench.now).bad, 0U);
}

bool listens_to(const FrameFace& frames, const CanFrame& frame) {
  const auto filters = frames.listens();
  return std::any_of(filters.begin(), filters.end(),
                     [&](const FrameFilter& filter) { return filter.matches(frame); });
}

/// Else nobody would notice who else commands it.
TEST_P(CanWire, ListensToTheFramesThatItIsCommandedBy) {
  CanBench bench(GetParam());
  for (const FrameRule& rule : bench.actuator->rules()) {
    CanFrame frame;
    frame.id = rule.id;
    frame.extended = rule.extended;
    EXPECT_TRUE(listens_to(*bench.frames, frame)) << describe(frame);
  }
}

TEST_P(CanWire, LosesNothingByHearingOnlyWhatItListensTo) {
  const auto like = golden_frames(*GetParam().entry);
  std::mt19937 random(11);
  CanBench bench(GetParam());
  bench.run(milliseconds(500), kRest);
  const SourceHealth before = bench.device->health(bench.now);
  for (int i = 0; i < 20000; ++i) {
    const CanFrame frame = random_frame(random, like);
    if (listens_to(*bench.frames, frame)) continue;
    bench.inject(frame);
    ASSERT_TRUE(bench.out.measurements.empty()) << describe(frame);
    ASSERT_TRUE(bench.out.frames.empty()) << describe(frame);
  }
  const SourceHealth after = bench.device->health(bench.now);
  EXPECT_EQ(after.good, before.good);
  EXPECT_EQ(after.bad, before.bad);
}

TEST_P(CanWire, SurvivesEveryTruncation) {
  CanBench bench(GetParam());
  for (CanFrame frame : golden_frames(*GetParam().entry)) {
    for (std::uint8_t len = 0; len <= frame.len; ++len) {
      CanFrame cut = frame;
      cut.len = len;
      bench.inject(cut);
      bench.step({kRest, 0});
    }
  }
  expect_decent(bench);
}

TEST_P(CanWire, SurvivesAHundredThousandRandomFrames) {
  const auto like = golden_frames(*GetParam().entry);
  std::mt19937 random(20250101);
  CanBench bench(GetParam());
  for (int i = 0; i < 100000; ++i) {
    bench.inject(random_frame(random, like));
    if (i % 16 == 0) {
      bench.now += milliseconds(5);
      bench.out.clear();
      bench.actuator->on_setpoints(bench.to_all({i % 4096 < 2048 ? kRest : kRun, 1.0}), bench.now,
                                   bench.out);
      bench.device->on_tick(bench.now, bench.out);
      for (const CanFrame& frame : bench.out.frames) {
        ASSERT_TRUE(on_list(bench.actuator->rules(), frame)) << describe(frame);
        ASSERT_NE(bench.effect_of(frame), FrameEffect::forbidden) << describe(frame);
        if (i % 4096 < 2048) {
          ASSERT_NE(bench.effect_of(frame), FrameEffect::motion) << describe(frame);
        }
      }
    }
  }
  expect_decent(bench);
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

std::vector<Subject> movers() {
  return subjects_with_twin<MakeCanTwin>(&Made::actuator);
}

std::vector<Subject> joints() {
  std::vector<Subject> all = told(ChannelMode::velocity, movers());
  for (Subject& subject : told(ChannelMode::impedance, movers())) all.push_back(subject);
  return all;
}

INSTANTIATE_TEST_SUITE_P(Registry, CanConformance, ::testing::ValuesIn(joints()), label_of);
INSTANTIATE_TEST_SUITE_P(Registry, CanVelocity,
                         ::testing::ValuesIn(told(ChannelMode::velocity, movers())), label_of);
INSTANTIATE_TEST_SUITE_P(Registry, CanWire, ::testing::ValuesIn(movers()), label_of);

}  // namespace
}  // namespace drover::test
