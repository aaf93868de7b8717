// Four motors beside their twin: how they are given up, taken back and let go.
#include "drivers/robomaster_c620/driver.h"

#include <gtest/gtest.h>

#include "drivers/robomaster_c620/entry.h"
#include "support/describe.h"
#include "unit/drivers/conformance/harness.h"

namespace drover::robomaster {
namespace {

using std::chrono::milliseconds;
using test::CanBench;

test::Subject subject(std::initializer_list<std::pair<std::string_view, OptionValue>> more = {}) {
  Options options = test::example_options(kRobomasterC620Entry);
  for (const auto& [name, value] : more) options.set(name, value);
  return {&kRobomasterC620Entry, options, "robomaster_c620"};
}

void drive(CanBench& bench, double velocity_radps = 3) {
  bench.run(milliseconds(300), AxisRequest::rest);
  bench.run(milliseconds(1500), AxisRequest::run, velocity_radps);
  ASSERT_EQ(bench.status.state, AxisState::running) << bench.status.reason.view();
}

/// Of the last command.
Currents last_of(const CanBench& bench) {
  return *decode_currents(bench.sent.back(), kCommandFirst);
}

TEST(RobomasterCodec, ReadsAndWritesTheDocumentedFrames) {
  const Currents two_amperes{1638, -1638, 0, 0};
  EXPECT_EQ(test::describe(encode_currents(kCommandFirst, two_amperes)), "200#0666F99A00000000");
  const Currents one_ampere{1000, 0, 0, 0};  // of a C610
  EXPECT_EQ(test::describe(encode_currents(kCommandSecond, one_ampere)), "1FF#03E8000000000000");
  const CanFrame frame = encode_feedback(1, {4096, -500, 500, 42});
  EXPECT_EQ(test::describe(frame), "201#1000FE0C01F42A00");
  const auto feedback = decode_feedback(frame, 1);
  ASSERT_TRUE(feedback);
  EXPECT_EQ(feedback->angle, 4096);
  EXPECT_EQ(feedback->rpm, -500);
  EXPECT_EQ(feedback->current, 500);
  EXPECT_EQ(feedback->degC, 42);
}

TEST(Robomaster, IsFedInEveryCycleOnceItWasHeard) {
  CanBench bench(subject());
  bench.run(milliseconds(100), AxisRequest::rest);
  bench.sent.clear();
  for (const AxisRequest request : {AxisRequest::rest, AxisRequest::run, AxisRequest::idle})
    bench.run(milliseconds(100), request, 0.0);
  EXPECT_EQ(bench.sent.size(), 60U);
  EXPECT_EQ(bench.most_frames, 1U);
}

TEST(Robomaster, SendsNothingButItsCommand) {
  CanBench bench(subject());
  drive(bench);
  for (const CanFrame& frame : bench.sent) EXPECT_EQ(frame.id, kCommandFirst);
  const auto effect = [&](std::uint32_t id, std::uint8_t len) {
    CanFrame frame = make_frame(id);
    frame.len = len;
    return bench.effect_of(frame);
  };
  EXPECT_EQ(effect(0x700, 8), FrameEffect::forbidden) << "the setting of numbers";
  EXPECT_EQ(effect(0x1FF, 8), FrameEffect::forbidden);
  EXPECT_EQ(effect(0x200, 7), FrameEffect::forbidden);
  EXPECT_EQ(effect(0x200, 8), FrameEffect::stop);
}

TEST(Robomaster, NamesTheMotorsThatACurrentMoves) {
  CanBench bench(subject());
  drive(bench);
  const CanFrame frame = encode_currents(kCommandFirst, {0, 2000, 0, -16000});
  const Effect effect = bench.actuator->effect(Message(frame), bench.now);
  EXPECT_EQ(effect.kind, FrameEffect::motion);
  EXPECT_EQ(effect.moves, channel_bit(1) | channel_bit(3)) << "the fourth would turn back";
}

TEST(Robomaster, OfWhichOneIsSilentGivesItNoCurrentAndBrakesTheOthers) {
  CanBench bench(subject());
  drive(bench);
  ASSERT_TRUE(bench.twin->set_fault("silent:2", bench.now));
  bench.run(milliseconds(60), AxisRequest::run, 3.0);
  EXPECT_EQ(last_of(bench)[1], 0) << "nobody sees what it does";
  EXPECT_EQ(bench.shafts[1].torque_Nm, 0.0);
  bench.moving.clear();
  bench.run(milliseconds(100), AxisRequest::run, 3.0);
  EXPECT_EQ(bench.device->health(bench.now).state, SourceState::stale);
  EXPECT_EQ(bench.device->health(bench.now).reason.view(), "motor 2 (202) is silent");
  EXPECT_EQ(bench.status.state, AxisState::fault);
  EXPECT_EQ(bench.status.reason.view(), "motor 2 (202) is silent");
  bench.moving.clear();
  bench.run(milliseconds(1000), AxisRequest::run, 3.0);
  EXPECT_TRUE(bench.moving.empty());
  EXPECT_NEAR(bench.shafts[0].velocity_radps, 0, 0.05);
  EXPECT_NEAR(bench.shafts[3].velocity_radps, 0, 0.05);
  EXPECT_GT(bench.shafts[1].velocity_radps, 1.0) << "it coasts";
  EXPECT_EQ(bench.status.state, AxisState::unknown) << "of the silent one";
  EXPECT_EQ(bench.status.axis, 1);
  EXPECT_EQ(bench.status.reason.view(), "nothing heard for more than 0.3 s");

  // Heard again it stays at rest until it is asked anew; what braked lets go then.
  bench.twin->set_fault("", bench.now);
  bench.run(milliseconds(500), AxisRequest::run, 3.0);
  EXPECT_EQ(bench.status.state, AxisState::fault);
  bench.run(milliseconds(1500), AxisRequest::rest);
  EXPECT_EQ(bench.status.state, AxisState::idle);
  bench.run(milliseconds(1500), AxisRequest::run, 3.0);
  EXPECT_EQ(bench.status.state, AxisState::running);
  EXPECT_NEAR(bench.shafts[1].velocity_radps, 3.0, 0.3);
}

TEST(Robomaster, KeepsThemFromCreepingOnASlopeWhileItRuns) {
  CanBench bench(subject());
  drive(bench);
  bench.load_Nm = 2;
  bench.run(milliseconds(1500), AxisRequest::run, 0.0);
  const double before_rad = bench.shaft.position_rad;
  bench.run(milliseconds(2000), AxisRequest::run, 0.0);
  EXPECT_NEAR(bench.shaft.position_rad, before_rad, 0.01);
}

/// In a cycle in which no wheel is to move no motion is permitted, and what the gate refuses leaves
/// the last current standing.
TEST(Robomaster, SendsOnlyStopsWhenItIsToldToStand) {
  for (const AxisRequest request : {AxisRequest::run, AxisRequest::hold, AxisRequest::rest}) {
    CanBench bench(subject());
    drive(bench);
    bench.moving.clear();
    bench.run(milliseconds(1500), request, 0.0);
    EXPECT_TRUE(bench.moving.empty()) << static_cast<int>(request);
    EXPECT_NEAR(bench.shaft.velocity_radps, 0, 0.02);
  }
}

/// As drives are taken back that roll: armed at their speed, and down a ramp.
TEST(Robomaster, CatchesWheelsThatRoll) {
  CanBench bench(subject());
  bench.run(milliseconds(300), AxisRequest::rest);
  for (Shaft& shaft : bench.shafts) shaft.velocity_radps = 4;
  double hold_radps = 4;
  for (int i = 0; i < 400; ++i) {
    hold_radps = std::max(0.0, std::min(hold_radps - 0.02, bench.shaft.velocity_radps));
    bench.run(milliseconds(5), AxisRequest::hold, hold_radps);
    EXPECT_GT(bench.shaft.velocity_radps, -0.1);
  }
  EXPECT_EQ(bench.status.state, AxisState::running);
  EXPECT_NEAR(bench.shaft.velocity_radps, 0, 0.05);
  EXPECT_TRUE(bench.moving.empty()) << test::describe(bench.moving.front());
}

TEST(Robomaster, LetsGoWhenItIsAskedToBeIdle) {
  CanBench bench(subject());
  drive(bench);
  bench.run(milliseconds(2000), AxisRequest::idle);
  EXPECT_EQ(bench.status.state, AxisState::idle);
  EXPECT_NEAR(bench.shaft.velocity_radps, 0, 0.1);
  bench.load_Nm = 1;
  bench.run(milliseconds(500), AxisRequest::idle);
  EXPECT_EQ(bench.shaft.torque_Nm, 0.0);
  EXPECT_GT(bench.shaft.velocity_radps, 0.5);
}

TEST(Robomaster, GivesUpWhenAMotorIsTooHotAndStartsWhenItIsCooler) {
  CanBench bench(subject());
  drive(bench);
  bench.twin->set_fault("over_temperature:4", bench.now);
  bench.run(milliseconds(1500), AxisRequest::run, 3.0);
  EXPECT_EQ(bench.status.state, AxisState::fault);
  EXPECT_EQ(bench.status.reason.view(), "motor 4 (204) is too hot: 95 °C");
  EXPECT_NEAR(bench.shaft.velocity_radps, 0, 0.05);
  bench.run(milliseconds(100), AxisRequest::rest);
  bench.run(milliseconds(500), AxisRequest::run, 3.0);
  EXPECT_EQ(bench.status.state, AxisState::fault);
  bench.twin->set_fault("", bench.now);
  bench.run(milliseconds(100), AxisRequest::rest);
  bench.run(milliseconds(500), AxisRequest::run, 3.0);
  EXPECT_EQ(bench.status.state, AxisState::running);
}

TEST(Robomaster, GivesUpWhenAMotorSeemsToStandHoweverHardItIsPushed) {
  CanBench bench(subject());
  drive(bench);
  bench.twin->set_fault("stuck_encoder:2", bench.now);
  bench.run(milliseconds(250), AxisRequest::run, 3.0);
  EXPECT_EQ(bench.status.state, AxisState::fault);
  EXPECT_EQ(bench.status.reason.view(),
            "motor 2 (202) tells the same angle however hard it is pushed: its sensor, or its "
            "wheel, is stuck");
  EXPECT_EQ(last_of(bench)[1], 0) << "nobody sees what a current does to it";
  bench.twin->set_fault("", bench.now);
  bench.run(milliseconds(100), AxisRequest::rest);
  bench.run(milliseconds(500), AxisRequest::run, 3.0);
  EXPECT_EQ(bench.status.state, AxisState::running);
}

const char* const kTorn =
    "motor 2 (202) has no current however much it is asked for: is a line to it torn?";

TEST(Robomaster, GivesUpWhenAMotorHasNoCurrentHoweverMuchItIsAskedFor) {
  CanBench bench(subject());
  drive(bench);
  bench.twin->set_fault("no_torque:2", bench.now);
  bench.run(milliseconds(800), AxisRequest::run, 3.0);
  EXPECT_EQ(bench.status.state, AxisState::fault);
  EXPECT_EQ(bench.status.reason.view(), kTorn);
  EXPECT_EQ(last_of(bench)[1], 0) << "it would turn as soon as its line has contact again";
  bench.run(milliseconds(1500), AxisRequest::run, 3.0);
  EXPECT_NEAR(bench.shaft.velocity_radps, 0, 0.05);
  bench.twin->set_fault("", bench.now);
  bench.run(milliseconds(100), AxisRequest::rest);
  bench.run(milliseconds(1500), AxisRequest::run, 3.0);
  EXPECT_EQ(bench.status.state, AxisState::running);
  EXPECT_NEAR(bench.shafts[1].velocity_radps, 3, 0.3);
}

/// The three others tell theirs.
TEST(Robomaster, FindsAMotorThatNeverHadACurrent) {
  CanBench bench(subject());
  bench.twin->set_fault("no_torque:2", bench.now);
  bench.run(milliseconds(300), AxisRequest::rest);
  bench.run(milliseconds(800), AxisRequest::run, 3.0);
  EXPECT_EQ(bench.status.state, AxisState::fault);
  EXPECT_EQ(bench.status.reason.view(), kTorn);
}

/// A slope would roll away what holds it.
TEST(Robomaster, FindsATornMotorThatIsToHold) {
  CanBench bench(subject());
  drive(bench);
  bench.load_Nm = 1;
  bench.run(milliseconds(1500), AxisRequest::run, 0.0);
  ASSERT_EQ(bench.status.state, AxisState::running);
  bench.twin->set_fault("no_torque:2", bench.now);
  bench.run(milliseconds(500), AxisRequest::run, 0.0);
  EXPECT_EQ(bench.status.state, AxisState::fault);
  EXPECT_EQ(bench.status.reason.view(), kTorn);
  EXPECT_EQ(last_of(bench)[1], 0);
  EXPECT_NEAR(bench.shafts[0].velocity_radps, 0, 0.05) << "the others hold on";
}

/// A wheel that the three others drag along needs little more than friction.
TEST(Robomaster, FindsATornMotorWhoseWheelTurnsAsItShould) {
  for (const double radps : {0.66, 3.5, -3.5}) {
    CanBench bench(subject());
    drive(bench, radps);
    bench.twin->set_fault("no_torque:2", bench.now);
    for (int i = 0; i < 100; ++i) {
      bench.run(milliseconds(5), AxisRequest::run, radps);
      bench.shafts[1].velocity_radps = 0.99 * radps;
    }
    EXPECT_EQ(bench.status.reason.view(), kTorn) << radps;
  }
}

/// Up and down: the others carry more and less. With a gain as for a wheel without load.
TEST(Robomaster, FindsAWheelThatIsLooseOnItsShaft) {
  CanBench bench(subject({{"velocity_gain_Nms_per_rad", 0.3}}));
  bench.twin->set_fault("loose:2", bench.now);
  drive(bench);
  for (int i = 0; i < 8 && bench.status.state == AxisState::running; ++i) {
    bench.load_Nm = i % 2 == 0 ? 0.5 : 1.5;
    bench.run(milliseconds(1000), AxisRequest::run, 3.0);
  }
  EXPECT_EQ(bench.status.state, AxisState::fault);
  EXPECT_EQ(bench.status.reason.view(),
            "motor 2 (202) turns as if nothing hung on it, whatever the others carry: is its wheel "
            "loose on the shaft, or in the air?");
  EXPECT_NE(bench.statuses[1].error_code, 0U);
  bench.run(milliseconds(1000), AxisRequest::rest);
  bench.twin->set_fault("", bench.now);
  bench.load_Nm = 0.5;
  bench.run(milliseconds(1000), AxisRequest::run, 3.0);
  EXPECT_EQ(bench.status.state, AxisState::running) << "mended, and asked anew";
}

TEST(Robomaster, TakesNoHealthyWheelForALooseOne) {
  CanBench bench(subject({{"velocity_gain_Nms_per_rad", 0.3}}));
  drive(bench);
  for (int i = 0; i < 20; ++i) {
    bench.load_Nm = i % 2 == 0 ? 0.0 : 1.5;
    bench.run(milliseconds(700), AxisRequest::run, i % 5 == 0 ? -3.0 : 3.0);
  }
  EXPECT_EQ(bench.status.state, AxisState::running) << bench.status.reason.view();
}

/// What none of them does is not one motor's: they hear nothing, or have no supply.
TEST(Robomaster, NamesNoMotorWhenNoneHasACurrent) {
  CanBench bench(subject());
  drive(bench);
  bench.run(milliseconds(1500), AxisRequest::run, 0.0);
  for (const char* fault : {"no_torque:1", "no_torque:2", "no_torque:3", "no_torque:4"})
    bench.twin->set_fault(fault, bench.now);
  bench.run(milliseconds(800), AxisRequest::run, 3.0);
  EXPECT_EQ(bench.status.state, AxisState::fault);
  EXPECT_EQ(bench.status.reason.view(),
            "no motor has a current however much is asked for: do they hear what they are told?");
  for (const auto& status : bench.statuses) EXPECT_EQ(status.error_code, 0U);
}

/// They stop together: each says which it is, and that one that it is.
TEST(Robomaster, TellsOfWhichMotorTheFaultIs) {
  for (const auto& [fault, motor] :
       {std::pair{"stuck_encoder:2", 1U}, {"over_temperature:4", 3U}, {"no_torque:3", 2U}}) {
    CanBench bench(subject());
    drive(bench);
    ASSERT_TRUE(bench.twin->set_fault(fault, bench.now));
    bench.run(milliseconds(1500), AxisRequest::run, 3.0);
    for (std::size_t i = 0; i < kMotors; ++i) {
      ASSERT_EQ(bench.statuses[i].state, AxisState::fault) << fault;
      EXPECT_EQ(bench.statuses[i].error_code != 0, i == motor) << fault << " of " << i + 1;
      EXPECT_EQ(bench.statuses[i].reason, bench.statuses[0].reason);
    }
    bench.twin->set_fault("", bench.now);
    bench.run(milliseconds(100), AxisRequest::rest);
    bench.run(milliseconds(500), AxisRequest::run, 3.0);
    for (std::size_t i = 0; i < kMotors; ++i) EXPECT_EQ(bench.statuses[i].error_code, 0U) << fault;
  }
}

/// A line that has contact again would turn the wheel by all that stood there.
TEST(Robomaster, TellsNoCurrentToAMotorAtRestThatHasNone) {
  CanBench bench(subject());
  drive(bench);
  bench.twin->set_fault("no_torque:2", bench.now);
  bench.run(milliseconds(1000), AxisRequest::rest);
  bench.load_Nm = 1;
  bench.run(milliseconds(1000), AxisRequest::rest);
  EXPECT_GT(bench.shafts[1].velocity_radps, 1) << "nothing holds it";
  EXPECT_EQ(last_of(bench)[1], 0);
  EXPECT_NE(last_of(bench)[0], 0) << "the others are held";
  EXPECT_NEAR(bench.shafts[0].velocity_radps, 0, 0.05);
  // Who begins anew is told anew.
  bench.twin->set_fault("", bench.now);
  bench.run(milliseconds(500), AxisRequest::run, 3.0);
  EXPECT_NEAR(bench.shafts[1].velocity_radps, 3, 0.3);
  bench.run(milliseconds(1500), AxisRequest::rest);
  EXPECT_NEAR(bench.shafts[1].velocity_radps, 0, 0.05);
}

TEST(Robomaster, StopsWhenSomebodyElseCommandsIt) {
  CanBench bench(subject());
  drive(bench);
  bench.inject(encode_currents(kCommandFirst, {}));  // the guard's
  bench.run(milliseconds(50), AxisRequest::run, 3.0);
  EXPECT_EQ(bench.status.state, AxisState::running);
  bench.inject(encode_currents(kCommandFirst, {100, 0, 0, 0}));
  bench.run(milliseconds(50), AxisRequest::run, 3.0);
  EXPECT_EQ(bench.status.state, AxisState::fault);
  EXPECT_EQ(bench.status.reason.view(), "somebody else commands it: id 0x200 on the bus");
}

TEST(Robomaster, SaysThatNothingHoldsItAndThatItGoesOnInSilence) {
  CanBench bench(subject());
  EXPECT_EQ(bench.actuator->stop_recipe().ends, StopEnds::coasts);
  EXPECT_FALSE(bench.actuator->silence().stops);
}

TEST(RobomasterTwin, KeepsItsLastCurrentOrDropsItAsItIsBuilt) {
  for (const double silence_s : {0.0, 0.1}) {
    CanBench bench(subject({{"silence_s", silence_s}}));
    bench.run(milliseconds(300), AxisRequest::rest);
    bench.driver_alive = false;
    bench.send(encode_currents(kCommandFirst, {819, 0, 0, 0}));
    bench.run(milliseconds(500), AxisRequest::rest);
    if (silence_s == 0) {
      EXPECT_NEAR(bench.shaft.torque_Nm, 0.3, 0.001);
    } else {
      EXPECT_EQ(bench.shaft.torque_Nm, 0);
    }
  }
}

/// 20 A in 0.17 ohm are 68 W: 1.8 K in 4 s.
TEST(RobomasterTwin, HeatsByItsCurrent) {
  CanBench bench(subject());
  bench.run(milliseconds(300), AxisRequest::rest);
  bench.driver_alive = false;
  bench.send(encode_currents(kCommandFirst, {16384, 0, 0, 0}));
  bench.run(milliseconds(4000), AxisRequest::rest);
  bench.twin_frames.clear();
  bench.twin->on_tick(bench.now + milliseconds(3), {bench.shafts.data(), kMotors},
                      bench.twin_frames);
  ASSERT_EQ(bench.twin_frames.size(), kMotors);
  EXPECT_EQ(decode_feedback(bench.twin_frames[0], 1)->degC, 26);
  EXPECT_EQ(decode_feedback(bench.twin_frames[1], 2)->degC, 25);
}

}  // namespace
}  // namespace drover::robomaster
