// What every device that takes a twist must do, on whichever wire it hangs.
#include <gtest/gtest.h>

#include "support/describe.h"
#include "unit/drivers/conformance/seal.h"
#include "unit/drivers/conformance/twist_harness.h"

namespace drover::test {
namespace {

constexpr auto kRun = AxisRequest::run;
constexpr auto kRest = AxisRequest::rest;
constexpr double kNear_mps = 0.04;
constexpr double kStill_radps = 0.05;

class TwistConformance : public ::testing::TestWithParam<Subject> {
 protected:
  void expect_decent(const TwistBench& bench) {
    EXPECT_EQ(bench.off_list, 0) << "sent outside its own allow-list, or bytes that no gate sees";
    EXPECT_EQ(bench.forbidden, 0) << "sent what it calls forbidden itself";
    EXPECT_EQ(bench.motion_at_rest, 0) << "sent motion while asked to rest";
    EXPECT_LE(bench.most, bench.actuator->messages_per_cycle());
    EXPECT_EQ(bench.allocations, 0U);
    EXPECT_EQ(bench.overflows, 0U);
  }
  void expect_no_motion(const TwistBench& bench) {
    for (const Sent& one : bench.sent)
      EXPECT_NE(bench.effect_of(one), FrameEffect::motion) << text_of(one);
  }
  /// At half a metre a second.
  static void drive(TwistBench& bench) {
    bench.run(milliseconds(2000), kRest);
    bench.run(milliseconds(1000), kRun);
    ASSERT_EQ(bench.status.state, AxisState::running) << bench.status.reason.view();
    bench.run(milliseconds(2000), kRun, {0.5, 0});
    ASSERT_NEAR(bench.motion.twist.vx_mps, 0.5, kNear_mps);
  }
};

TEST_P(TwistConformance, NamesOneChannelAsItsEntryDoes) {
  TwistBench bench(GetParam());
  ASSERT_EQ(bench.actuator->channels().size(), 1U);
  EXPECT_EQ(bench.actuator->channels()[0].name, bench.entry.channels[0].name);
  EXPECT_EQ(bench.actuator->channels()[0].mode, ChannelMode::twist);
}

TEST_P(TwistConformance, SendsNothingThatMovesToADeviceThatWasNeverHeard) {
  TwistBench bench(GetParam());
  bench.set_power(false);
  bench.run(milliseconds(500), kRest);
  bench.run(milliseconds(500), kRun, {0.5, 0});
  for (const Sent& one : bench.sent)
    EXPECT_EQ(bench.effect_of(one), FrameEffect::harmless) << text_of(one);
  EXPECT_EQ(bench.status.state, AxisState::unknown);
  EXPECT_EQ(bench.device->health(bench.now).state, SourceState::never_heard);
  expect_decent(bench);
}

TEST_P(TwistConformance, StandsWhileNobodyAsksItToMove) {
  TwistBench bench(GetParam());
  bench.run(milliseconds(3000), kRest);
  EXPECT_TRUE(bench.status.state == AxisState::idle || bench.status.state == AxisState::running)
      << bench.status.reason.view();
  EXPECT_EQ(bench.fastest_radps(), 0);
  EXPECT_GT(bench.motions, 20);
  expect_no_motion(bench);
  expect_decent(bench);
}

/// Whether it lets go or was told zero for good: `idle` is what the power waits for.
TEST_P(TwistConformance, IsIdleWhenItIsAskedToBeAndRunsAgainWhenItIsAskedTo) {
  TwistBench bench(GetParam());
  drive(bench);
  bench.run(milliseconds(1500), kRest);
  bench.sent.clear();
  bench.run(milliseconds(1000), AxisRequest::idle);
  EXPECT_EQ(bench.status.state, AxisState::idle) << bench.status.reason.view();
  expect_no_motion(bench);
  bench.run(milliseconds(1000), kRun);
  EXPECT_EQ(bench.status.state, AxisState::running) << bench.status.reason.view();
  expect_decent(bench);
}

TEST_P(TwistConformance, FollowsTheTwistAndTellsIt) {
  TwistBench bench(GetParam());
  drive(bench);
  const std::vector<Twist> any{{0.5, 0}, {-0.4, 0}, {0, 0.5}, {0, -0.5}, {0.3, 0.3}};
  const std::vector<Twist> curves{{0.5, 0}, {-0.4, 0}, {0.4, 0.2}, {-0.4, 0.2}, {0.3, -0.15}};
  for (const Twist& twist : bench.entry.steers ? curves : any) {
    bench.run(milliseconds(2500), kRun, twist);
    EXPECT_NEAR(bench.motion.twist.vx_mps, twist.vx_mps, kNear_mps);
    EXPECT_NEAR(bench.motion.twist.wz_radps, twist.wz_radps, 0.05);
    EXPECT_TRUE(bench.motion.known);
    EXPECT_GT(bench.motion.vx_var, 0);
    EXPECT_GT(bench.motion.wz_var, 0);
    if (twist.wz_radps != 0) continue;
    for (const Shaft& shaft : bench.wheels()) EXPECT_GT(shaft.velocity_radps * twist.vx_mps, 0);
  }
  expect_decent(bench);
}

/// It turns on curves only: told a turn on the spot it stands, and its wheels stay as they were.
TEST_P(TwistConformance, StandsWhenItSteersAndIsToldToTurnOnTheSpot) {
  TwistBench bench(GetParam());
  if (!bench.entry.steers) return;
  drive(bench);
  bench.run(milliseconds(2000), kRun, {0.4, 0.2});
  const double angle_rad = bench.motion.steering_rad;
  EXPECT_GT(angle_rad, 0.1);
  bench.run(milliseconds(1500), kRun);
  bench.sent.clear();
  bench.run(milliseconds(2000), kRun, {0, 0.5});
  expect_no_motion(bench);
  EXPECT_LT(bench.fastest_radps(), kStill_radps);
  EXPECT_NEAR(bench.motion.steering_rad, angle_rad, 0.02);
  bench.run(milliseconds(2000), kRest);
  EXPECT_NEAR(bench.motion.steering_rad, angle_rad, 0.02);
}

/// The gate lets a ramp down to rest pass by what a message says.
TEST_P(TwistConformance, AsksForNoMoreThanItIsTold) {
  TwistBench bench(GetParam());
  drive(bench);
  bench.sent.clear();
  for (double speed_mps = 0.5; speed_mps > 0; speed_mps -= 0.00137) {
    const Twist asked{speed_mps, -speed_mps};
    bench.step({kRun, 0, asked});
    for (const Sent& one : bench.sent) {
      const Twist said = bench.actuator->setpoint_twist(message_of(one), 0);
      EXPECT_LE(said.vx_mps, asked.vx_mps * (1 + 1e-6)) << text_of(one);
      EXPECT_GE(said.wz_radps, asked.wz_radps * (1 + 1e-6)) << text_of(one);
      EXPECT_NEAR(said.vx_mps, asked.vx_mps, 0.01);
    }
    bench.sent.clear();
  }
}

TEST_P(TwistConformance, StopsAtOnceAndStaysAsItSays) {
  TwistBench bench(GetParam());
  drive(bench);
  bench.sent.clear();
  bench.step({kRest, 0, {}});
  ASSERT_FALSE(bench.sent.empty());
  EXPECT_EQ(bench.effect_of(bench.sent[0]), FrameEffect::stop);
  bench.run(milliseconds(1500), kRest);
  EXPECT_LT(bench.fastest_radps(), kStill_radps);
  const double before_rad = bench.shafts[0].position_rad;
  bench.load_Nm = 2;
  bench.run(milliseconds(2000), kRest);
  const double moved_rad = std::abs(bench.shafts[0].position_rad - before_rad);
  if (bench.actuator->stop_recipe().ends == StopEnds::holds) {
    EXPECT_LT(moved_rad, 0.3);
  }
  EXPECT_LT(moved_rad, 4) << "braked at least";
  expect_decent(bench);
}

TEST_P(TwistConformance, GoesStaleWhenItsDeviceFallsSilent) {
  TwistBench bench(GetParam());
  drive(bench);
  ASSERT_EQ(bench.device->health(bench.now).state, SourceState::fresh);
  EXPECT_TRUE(bench.device->health(bench.now).reason.empty());
  bench.set_power(false);
  bench.run(milliseconds(105), kRun, {0.5, 0});
  EXPECT_EQ(bench.device->health(bench.now).state, SourceState::stale);
  EXPECT_FALSE(bench.device->health(bench.now).reason.empty());
  bench.run(milliseconds(500), kRun, {0.5, 0});
  EXPECT_EQ(bench.status.state, AxisState::unknown);
  EXPECT_FALSE(bench.status.reason.empty());
  bench.sent.clear();
  bench.run(milliseconds(100), kRun, {0.5, 0});
  expect_no_motion(bench);
}

/// A frame without which it does not begin is one without which it does not go on: a motion that
/// still comes says nothing of the button that a person pressed.
TEST_P(TwistConformance, IsGivenUpWhenOneOfTheFramesThatItNeedsCeases) {
  TwistBench whole(GetParam());
  drive(whole);
  int needed = 0;
  for (const std::uint32_t id : whole.ids) {
    SCOPED_TRACE("frame " + std::to_string(id));
    TwistBench without(GetParam());
    without.lost = id;
    without.run(milliseconds(2000), kRest);
    without.run(milliseconds(1000), kRun);
    const bool fresh = without.device->health(without.now).state == SourceState::fresh;
    if (fresh && without.status.state == AxisState::running) continue;
    ++needed;
    TwistBench bench(GetParam());
    drive(bench);
    bench.lost = id;
    bench.run(milliseconds(600), kRun, {0.5, 0});
    EXPECT_EQ(bench.device->health(bench.now).state, SourceState::stale);
    EXPECT_FALSE(bench.device->health(bench.now).reason.empty());
    EXPECT_EQ(bench.status.state, AxisState::unknown);
    EXPECT_FALSE(bench.status.reason.empty());
    bench.sent.clear();
    bench.run(milliseconds(100), kRun, {0.5, 0});
    bench.lost.reset();
    bench.run(milliseconds(1500), kRun, {0.5, 0});
    expect_no_motion(bench);
    EXPECT_LT(bench.fastest_radps(), kStill_radps) << "it moves again by a new request only";
  }
  if (GetParam().entry->wire == Wire::can) {
    EXPECT_GE(needed, 1);
  }
}

TEST_P(TwistConformance, MovesAfterAPowerCycleOnlyByANewRequest) {
  TwistBench bench(GetParam());
  drive(bench);
  bench.set_power(false);
  bench.run(milliseconds(3000), kRun, {0.5, 0});
  bench.set_power(true);
  bench.sent.clear();
  bench.run(milliseconds(4000), kRun, {0.5, 0});
  EXPECT_NE(bench.status.state, AxisState::running);
  expect_no_motion(bench);
  EXPECT_LT(bench.fastest_radps(), kStill_radps);
  bench.run(milliseconds(100), kRest);
  bench.run(milliseconds(1000), kRun);
  bench.run(milliseconds(2000), kRun, {0.5, 0});
  EXPECT_EQ(bench.status.state, AxisState::running) << bench.status.reason.view();
  EXPECT_NEAR(bench.motion.twist.vx_mps, 0.5, kNear_mps);
  expect_decent(bench);
}

TEST_P(TwistConformance, MovesAfterANewLinkOnlyByANewRequest) {
  TwistBench bench(GetParam());
  drive(bench);
  bench.device->on_link_up(bench.now);
  bench.sent.clear();
  bench.run(milliseconds(1000), kRun, {0.5, 0});
  expect_no_motion(bench);
  EXPECT_LT(bench.fastest_radps(), kStill_radps) << "and what it was told last is taken back";
  bench.run(milliseconds(50), kRest);
  bench.run(milliseconds(2500), kRun, {0.5, 0});
  EXPECT_EQ(bench.status.state, AxisState::running) << bench.status.reason.view();
}

TEST_P(TwistConformance, SaysHowItStopsAndTheRecipeStopsIt) {
  TwistBench bench(GetParam());
  const StopRecipe recipe = bench.actuator->stop_recipe();
  ASSERT_FALSE(recipe.rounds.empty());
  EXPECT_GE(recipe.period, milliseconds(10));
  EXPECT_LE(recipe.period, milliseconds(50));
  drive(bench);
  bench.driver_alive = false;  // from here on somebody who knows only the recipe
  Time next = bench.now;
  std::size_t rounds = 0;
  for (int i = 0; i < 300; ++i) {
    for (; next <= bench.now; next += recipe.period, ++rounds) {
      const StopRound& round = recipe.rounds[rounds % recipe.rounds.size()];
      std::vector<Sent> all(round.frames.begin(), round.frames.end());
      all.insert(all.end(), round.packets.begin(), round.packets.end());
      ASSERT_FALSE(all.empty());
      EXPECT_EQ(round.frames.empty(), bench.entry.wire != Wire::can);
      for (const Sent& one : all) {
        EXPECT_EQ(bench.effect_of(one), FrameEffect::stop) << text_of(one);
        bench.send(one);
      }
    }
    bench.step({});
  }
  EXPECT_LT(bench.fastest_radps(), kStill_radps);
}

TEST_P(TwistConformance, DoesInSilenceWhatItSays) {
  TwistBench bench(GetParam());
  const SilenceBehaviour silence = bench.actuator->silence();
  EXPECT_FALSE(silence.text.empty());
  EXPECT_EQ(silence.stops, silence.after > Duration{});
  drive(bench);
  bench.driver_alive = false;
  bench.run(silence.after + milliseconds(2000), kRest);
  if (silence.stops) {
    EXPECT_LT(bench.fastest_radps(), kStill_radps);
  } else {
    EXPECT_GT(bench.fastest_radps(), 1) << "a simulated device is no safer than it is said to be";
  }
}

/// One byte of what it sends is another: it is no motion of something else, and no stop that moves.
TEST_P(TwistConformance, CallsNothingAStopThatMovesTheTwin) {
  TwistBench bench(GetParam());
  drive(bench);
  bench.run(milliseconds(1500), kRun);
  const std::vector<Sent> like(bench.sent.end() - 20, bench.sent.end());
  bench.driver_alive = false;
  std::mt19937 random(7);
  int sent = 0;
  int motions = 0;
  for (int i = 0; i < 20000; ++i) {
    Sent one = like[random() % like.size()];
    if (auto* frame = std::get_if<CanFrame>(&one)) {
      frame->data[random() % 8] = static_cast<std::uint8_t>(random());
    } else {
      Packet& packet = std::get<Packet>(one);
      packet[random() % packet.size()] = static_cast<std::uint8_t>(random());
      ASSERT_TRUE(seal(bench.entry, packet)) << "seal.h has to know how its packets end";
    }
    const FrameEffect effect = bench.effect_of(one);
    motions += effect == FrameEffect::motion ? 1 : 0;
    if (effect == FrameEffect::motion || effect == FrameEffect::forbidden) continue;
    ++sent;
    bench.send(one);
    bench.step({});
    ASSERT_LT(bench.fastest_radps(), kStill_radps) << text_of(one);
  }
  EXPECT_GT(sent, 50);
  EXPECT_GT(motions, 1000) << "else no mutant was whole enough to be judged";
}

TEST_P(TwistConformance, StaysDecentThroughRandomHistories) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937 random(seed);
    TwistBench bench(GetParam());
    Setpoint command;
    std::array<std::uint8_t, 16> noise{};
    for (int i = 0; i < 1000; ++i) {
      if (random() % 40 == 0) command.request = static_cast<AxisRequest>(random() % 4);
      if (random() % 20 == 0)
        command.twist = {static_cast<double>(random() % 11) / 5 - 1,
                         static_cast<double>(random() % 11) / 5 - 1};
      if (random() % 200 == 0) command.twist.wz_radps = kAbsent;
      if (random() % 200 == 0) bench.set_power(random() % 2 == 0);
      if (random() % 300 == 0) bench.device->on_link_up(bench.now);
      if (random() % 100 == 0) bench.set_fault(random() % 2 ? "silent" : "");
      if (random() % 30 == 0) {
        for (auto& byte : noise) byte = static_cast<std::uint8_t>(random());
        bench.inject(noise);
      }
      bench.step(command);
    }
    expect_decent(bench);
  }
}

TEST_P(TwistConformance, GivesTheSameForTheSame) {
  std::string texts[2];
  for (std::string& text : texts) {
    TwistBench bench(GetParam());
    bench.run(milliseconds(2000), kRest);
    for (int i = 0; i < 400; ++i) {
      bench.step({kRun, 0, {0.001 * i, -0.001 * i}});
      text += describe(bench.out, *bench.made.device);
    }
    for (const Sent& one : bench.sent) text += text_of(one);
  }
  EXPECT_EQ(texts[0], texts[1]);
}

INSTANTIATE_TEST_SUITE_P(Registry, TwistConformance,
                         ::testing::ValuesIn(told(ChannelMode::twist, subjects(&Made::actuator))),
                         label_of);

}  // namespace
}  // namespace drover::test
