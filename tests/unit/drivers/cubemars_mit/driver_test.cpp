// A CubeMars motor beside its twin: what is believed of a motor that never says whether it is on,
// and how it is lost and taken back.
#include "drivers/cubemars_mit/driver.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "drivers/cubemars_mit/entry.h"
#include "support/describe.h"
#include "unit/drivers/conformance/harness.h"
#include "unit/drivers/mit/unheard_motor.h"

namespace drover::cubemars_mit {
namespace {

using mit::test::expect_damped;
using std::chrono::milliseconds;
using test::CanBench;

test::Subject subject(std::initializer_list<std::pair<std::string_view, OptionValue>> more = {}) {
  Options options = test::example_options(kCubemarsMitEntry);
  options.set("id", 1.0).set("model", std::string("AK80-9"));
  for (const auto& [name, value] : more) options.set(name, value);
  return {&kCubemarsMitEntry, options, "cubemars_mit"};
}

const CanFrame kEnable = encode_special(1, Special::enable);
const CanFrame kLeave = encode_special(1, Special::disable);

std::ptrdiff_t count(const std::vector<CanFrame>& frames, const CanFrame& frame) {
  return std::count(frames.begin(), frames.end(), frame);
}

void arm(CanBench& bench) {
  bench.run(milliseconds(500), AxisRequest::rest);
  bench.run(milliseconds(1000), AxisRequest::run);
  ASSERT_EQ(bench.status.state, AxisState::running) << bench.status.reason.view();
}

void expect_no_motion(CanBench& bench, Duration time) {
  bench.sent.clear();
  bench.run(time, AxisRequest::run, 1.0);
  EXPECT_EQ(count(bench.sent, kEnable), 0);
  for (const CanFrame& frame : bench.sent)
    EXPECT_NE(bench.effect_of(frame), FrameEffect::motion) << test::describe(frame);
}

/// The manual's way to ask a motor for its state enables it.
TEST(Cubemars, IsNeverEnabledByAQuestion) {
  CanBench bench(subject());
  bench.run(milliseconds(3000), AxisRequest::rest);
  EXPECT_EQ(bench.status.state, AxisState::idle);
  EXPECT_EQ(count(bench.sent, kEnable), 0);
  const CanFrame damp = bench.actuator->stop_recipe().rounds[0].frames[0];
  const auto asked = std::find(bench.sent.begin(), bench.sent.end(), kLeave);
  ASSERT_NE(asked, bench.sent.end());
  EXPECT_LE(asked - bench.sent.begin(), 20) << "one each 10 ms while it listens";
  EXPECT_EQ(std::count(bench.sent.begin(), asked, damp), asked - bench.sent.begin());
  EXPECT_EQ(std::count(asked, bench.sent.end(), kLeave), bench.sent.end() - asked);
}

TEST(Cubemars, FollowsDampingFirstWhenItIsEnabled) {
  CanBench bench(subject());
  bench.run(milliseconds(1000), AxisRequest::rest);
  bench.sent.clear();
  bench.law = {.position_rad = 1, .effort_Nm = 1, .stiffness_Nmprad = 50, .damping_Nmsprad = 1};
  while (bench.status.state != AxisState::running && bench.now < Time{milliseconds(4000)})
    bench.run(milliseconds(5), AxisRequest::run);
  const auto enabled = std::find(bench.sent.begin(), bench.sent.end(), kEnable);
  ASSERT_NE(enabled, bench.sent.end());
  ASSERT_NE(enabled, bench.sent.begin());
  const CanFrame damp = bench.actuator->stop_recipe().rounds[0].frames[0];
  EXPECT_EQ(*(enabled - 1), damp);
  EXPECT_EQ(count(bench.sent, kEnable), 3) << "no answer tells whether one was heard";
  for (auto frame = enabled; frame != bench.sent.end(); ++frame)
    EXPECT_TRUE(*frame == damp || *frame == kEnable) << test::describe(*frame);
}

/// The guard made it damp while nobody else was there: to ask it would drop what it carries.
TEST(Cubemars, IsNotLetGoOfWhileSomebodyElseMakesItDamp) {
  CanBench before(subject());
  arm(before);
  CanBench bench(subject());
  mit::test::take_motor(bench, before);
  const StopRecipe recipe = bench.actuator->stop_recipe();
  for (int i = 0; i < 20; ++i) {
    bench.send(recipe.rounds[0].frames[0]);
    bench.run(milliseconds(10), AxisRequest::rest);
  }
  bench.run(milliseconds(2000), AxisRequest::rest);
  EXPECT_EQ(count(bench.sent, kLeave), 0);
  EXPECT_TRUE(bench.shaft.energized);
  EXPECT_EQ(bench.status.state, AxisState::unknown);
  EXPECT_EQ(bench.status.reason,
            "it does not tell whether it is on: it damps until it is asked to run or idle");
  bench.run(milliseconds(1000), AxisRequest::run);
  EXPECT_EQ(bench.status.state, AxisState::running) << bench.status.reason.view();
  bench.run(milliseconds(1500), AxisRequest::idle);
  EXPECT_EQ(bench.status.state, AxisState::idle);
  EXPECT_FALSE(bench.shaft.energized);
}

/// A motor that holds a weight, of which nothing is heard, and a driver that never heard it; the
/// guard made it damp meanwhile, and for a moment more.
void begin_anew_beside_the_guard(CanBench& bench, AxisRequest request) {
  CanBench before(subject());
  arm(before);
  mit::test::begin_anew(bench, before);
  const CanFrame damp = bench.actuator->stop_recipe().rounds[0].frames[0];
  for (int i = 0; i < 50; ++i) {
    bench.send(damp);
    bench.inject(damp);
    bench.run(milliseconds(10), request);
  }
}

/// It may obey, and only its answers be lost: to ask it would drop what it carries.
TEST(Cubemars, IsMadeToDampByADriverThatNeverHeardItWhereTheGuardDidSo) {
  CanBench bench(subject());
  begin_anew_beside_the_guard(bench, AxisRequest::rest);
  EXPECT_TRUE(bench.sent.empty()) << "the guard's are enough";
  bench.run(milliseconds(2000), AxisRequest::rest);
  expect_damped(bench);
  EXPECT_EQ(count(bench.sent, kLeave), 0);
  EXPECT_EQ(count(bench.sent, kEnable), 0);
  bench.run(milliseconds(1500), AxisRequest::rest);
  EXPECT_GT(count(bench.sent, kLeave), 0) << "given up after 3 s, as any that falls silent";
}

/// The guard hangs, or was never there: to ask it by letting it go would drop what it carries.
TEST(Cubemars, IsMadeToDampByADriverThatBeginsWhereNobodyElseDoesSo) {
  CanBench before(subject());
  arm(before);
  for (const bool carries : {true, false}) {
    CanBench bench(subject());
    bench.twin = std::move(before.twin);
    bench.now = before.now;
    bench.shaft.energized = true;
    bench.device->on_link_up(bench.now);
    bench.load_Nm = carries ? 1 : 0;
    bench.run(milliseconds(2000), AxisRequest::rest);
    if (carries) {
      expect_damped(bench);
      EXPECT_EQ(count(bench.sent, kLeave), 0);
      EXPECT_EQ(bench.status.state, AxisState::unknown);
    } else {
      EXPECT_EQ(bench.status.state, AxisState::idle) << "what carries nothing is asked";
    }
    EXPECT_EQ(count(bench.sent, kEnable), 0);
    before.twin = std::move(bench.twin);
    before.now = bench.now;
  }
}

/// Its bus was down when droverd began, or a guard that hangs was waited for.
TEST(Cubemars, IsMadeToDampOnALinkThatComesLateToo) {
  CanBench before(subject());
  arm(before);
  CanBench bench(subject());
  bench.now = before.now;
  bench.twin->set_power(false, bench.now);
  bench.run(milliseconds(500), AxisRequest::rest);
  bench.sent.clear();
  bench.twin = std::move(before.twin);
  bench.shaft.energized = true;
  bench.device->on_link_up(bench.now);
  bench.load_Nm = 1;
  bench.run(milliseconds(2000), AxisRequest::rest);
  expect_damped(bench);
  EXPECT_EQ(count(bench.sent, kLeave), 0);
}

TEST(Cubemars, IsLetGoThoughItWasNeverHeardWhenThatIsAsked) {
  CanBench bench(subject());
  begin_anew_beside_the_guard(bench, AxisRequest::idle);
  bench.run(milliseconds(1500), AxisRequest::idle);
  EXPECT_FALSE(bench.shaft.energized);
}

TEST(Cubemars, IsMadeToDampAfterANewLinkWhenNobodyHearsIt) {
  CanBench bench(subject());
  arm(bench);
  bench.load_Nm = 1;
  bench.twin->set_fault("silent", bench.now);
  bench.run(milliseconds(200), AxisRequest::run);
  bench.device->on_link_up(bench.now);
  bench.run(milliseconds(2000), AxisRequest::run);
  expect_damped(bench);
}

TEST(Cubemars, IsCalledOffOnlyWhenItAnswersToLettingGo) {
  CanBench bench(subject());
  arm(bench);
  bench.twin->set_fault("silent", bench.now);
  bench.run(milliseconds(2500), AxisRequest::idle);
  EXPECT_EQ(bench.status.state, AxisState::unknown);
  EXPECT_FALSE(bench.shaft.energized) << "it heard it all the same";
  bench.twin->set_fault("", bench.now);
  bench.run(milliseconds(300), AxisRequest::idle);
  EXPECT_EQ(bench.status.state, AxisState::idle);
}

TEST(Cubemars, TellsEachErrorAndArmsOnlyByANewRequestWhenItIsGone) {
  const std::pair<const char*, const char*> cases[] = {
      {"over_temperature", "over temperature"},
      {"over_current", "over current"},
      {"over_voltage", "supply over voltage"},
      {"under_voltage", "supply under voltage"},
      {"encoder", "encoder"},
      {"phase_imbalance", "phases out of balance"},
  };
  for (const auto& [fault, words] : cases) {
    SCOPED_TRACE(fault);
    CanBench bench(subject());
    arm(bench);
    ASSERT_TRUE(bench.twin->set_fault(fault, bench.now));
    bench.run(milliseconds(50), AxisRequest::run, 1.0);
    expect_no_motion(bench, milliseconds(1000));
    EXPECT_EQ(bench.status.state, AxisState::fault);
    EXPECT_EQ(bench.status.reason.view(), std::string("it reports an error: ") + words);
    EXPECT_TRUE(bench.status.powered) << "it may be";
    bench.run(milliseconds(100), AxisRequest::rest);
    EXPECT_EQ(bench.status.reason.view(), words);
    expect_no_motion(bench, milliseconds(1000));
    EXPECT_EQ(bench.status.reason.view(), std::string("its error stays: ") + words);
    bench.twin->set_fault("", bench.now);
    expect_no_motion(bench, milliseconds(1000));
    bench.run(milliseconds(100), AxisRequest::rest);
    bench.run(milliseconds(1000), AxisRequest::run, 1.0);
    EXPECT_EQ(bench.status.state, AxisState::running) << bench.status.reason.view();
  }
}

TEST(Cubemars, CallsAnErrorThatNobodyDocumentedAnError) {
  CanBench bench(subject());
  arm(bench);
  bench.inject(make_frame(1, {0x01, 0x7F, 0xFF, 0x7F, 0xF7, 0xFF, 0x19, 0x2A}));
  EXPECT_EQ(bench.status.state, AxisState::fault);
  EXPECT_EQ(bench.status.reason,
            "it reports an error: error 42, which its maker does not document");
}

/// Its answers are lost, not its ears: one that is asked lets go of what it carries.
TEST(Cubemars, IsMadeToDampWhenNobodyHearsIt) {
  CanBench bench(subject());
  arm(bench);
  bench.law = {.effort_Nm = 1};
  bench.run(milliseconds(50), AxisRequest::run);
  bench.twin->set_fault("silent", bench.now);
  bench.run(milliseconds(1000), AxisRequest::run);
  EXPECT_EQ(bench.status.state, AxisState::unknown);
  EXPECT_EQ(bench.status.reason, "no answer for more than 0.1 s");
  EXPECT_NEAR(bench.shaft.velocity_radps, 0, 0.02);
  EXPECT_TRUE(bench.shaft.energized);
  bench.twin->set_fault("", bench.now);
  expect_no_motion(bench, milliseconds(1000));
}

/// Whether a motor that is off answers a damping frame is nowhere said.
TEST(Cubemars, IsFoundAgainThoughItIsMuteWhileItIsOff) {
  CanBench bench(subject({{"mute_while_off", true}}));
  arm(bench);
  bench.twin->set_power(false, bench.now);
  bench.run(milliseconds(500), AxisRequest::rest);
  bench.twin->set_power(true, bench.now);
  bench.run(milliseconds(2000), AxisRequest::rest);
  EXPECT_EQ(count(bench.sent, kEnable), 3) << "when it was armed";
  EXPECT_EQ(bench.status.state, AxisState::unknown);
  bench.run(milliseconds(2000), AxisRequest::rest);
  EXPECT_EQ(bench.status.state, AxisState::idle);
  bench.run(milliseconds(1000), AxisRequest::run, 1.0);
  EXPECT_EQ(bench.status.state, AxisState::running) << bench.status.reason.view();
}

/// What no answer tells: it follows nothing, and is enabled by nothing but a new request.
TEST(Cubemars, DoesNotNoticeThatItLetGoByItself) {
  CanBench bench(subject());
  arm(bench);
  ASSERT_TRUE(bench.twin->set_fault("leaves_closed_loop", bench.now));
  bench.sent.clear();
  bench.run(milliseconds(1000), AxisRequest::run, 1.0);
  EXPECT_EQ(bench.status.state, AxisState::running);
  EXPECT_EQ(bench.shaft.torque_Nm, 0);
  EXPECT_EQ(count(bench.sent, kEnable), 0);
}

TEST(Cubemars, IsGivenUpWhenSomebodyElseCommandsIt) {
  for (const CanFrame& frame : {mit::encode_mit(1, {0, 1, 0, 1, 0}, {}), kEnable, kLeave,
                                encode_special(1, Special::set_zero)}) {
    CanBench bench(subject());
    arm(bench);
    bench.inject(frame);
    expect_no_motion(bench, milliseconds(200));
    EXPECT_EQ(bench.status.state, AxisState::fault) << test::describe(frame);
    EXPECT_EQ(bench.status.reason, "somebody else commands it: id 0x001 on the bus");
  }
  CanBench bench(subject());
  arm(bench);
  bench.inject(bench.actuator->stop_recipe().rounds[0].frames[0]);
  bench.run(milliseconds(200), AxisRequest::run);
  EXPECT_EQ(bench.status.state, AxisState::running) << "the guard is welcome";
}

/// It stays on, and would follow the next frame without being armed.
TEST(Cubemars, IsLockedWhenItWasLeftAloneForLongerThanItsTimeOut) {
  CanBench bench(subject({{"timeout_ms", 40.0}}));
  EXPECT_TRUE(bench.actuator->silence().stops);
  EXPECT_EQ(bench.actuator->silence().after, milliseconds(40));
  EXPECT_EQ(bench.actuator->silence().ends, StopEnds::coasts);
  EXPECT_EQ(bench.actuator->silence().text,
            "goes limp after 0.040 s (its time-out, as it was set in the motor)");
  arm(bench);
  bench.law = {.effort_Nm = 0.5};
  bench.run(milliseconds(50), AxisRequest::run);
  bench.driver_alive = false;
  for (int i = 0; i < 10; ++i) bench.step({});
  EXPECT_TRUE(bench.shaft.energized) << "it stays on";
  EXPECT_NEAR(bench.shaft.torque_Nm, 0, 1e-3) << "and is limp";
  bench.driver_alive = true;
  expect_no_motion(bench, milliseconds(500));
  EXPECT_EQ(bench.status.state, AxisState::fault);
  EXPECT_EQ(bench.status.reason, "nothing was sent to it for so long that it may have let go");
}

TEST(Cubemars, WithoutAKnownTimeOutSaysThatItMayGoOn) {
  CanBench bench(subject());
  EXPECT_FALSE(bench.actuator->silence().stops);
  EXPECT_EQ(bench.actuator->silence().text,
            "may follow its last command for ever: its time-out is not known");
  arm(bench);
  bench.law = {.effort_Nm = 0.5};
  bench.run(milliseconds(50), AxisRequest::run);
  bench.driver_alive = false;
  for (int i = 0; i < 200; ++i) bench.step({});
  EXPECT_NEAR(bench.shaft.torque_Nm, 0.5, 0.02);
  bench.driver_alive = true;
  expect_no_motion(bench, milliseconds(500));
  EXPECT_EQ(bench.status.reason, "its answers ceased while armed");
}

/// As the open firmware has it: six bytes under the master id 0.
TEST(Cubemars, RunsWithShortAnswersUnderTheMasterId) {
  CanBench bench(subject({{"id", 3.0}, {"master_id", 0.0}, {"short_answers", true}}));
  arm(bench);
  bench.run(milliseconds(1500), AxisRequest::run, 2.0);
  EXPECT_NEAR(bench.motion.velocity_radps, 2.0, 0.2);
  EXPECT_EQ(bench.ids, std::set<std::uint32_t>{0});
  for (const CanFrame& frame : bench.sent) EXPECT_EQ(frame.id, 3U);
  CanFrame start_all = make_frame(0, {0x01, 0x00, 0, 0, 0, 0, 0, 0});
  EXPECT_EQ(bench.effect_of(start_all), FrameEffect::forbidden) << "an NMT command";
}

TEST(Cubemars, SendsNoMoreInACycleThanItSays) {
  CanBench bench(subject());
  bench.run(milliseconds(500), AxisRequest::rest);
  bench.run(milliseconds(2000), AxisRequest::run, 1.0);
  bench.twin->set_fault("over_current", bench.now);
  bench.run(milliseconds(500), AxisRequest::rest);
  bench.run(milliseconds(1000), AxisRequest::run, 1.0);
  bench.run(milliseconds(2000), AxisRequest::idle);
  EXPECT_LE(bench.most_frames, bench.actuator->messages_per_cycle());
}

TEST(Cubemars, TellsPlaceSpeedAndEffortOfTheJoint) {
  CanBench bench(subject({{"reversed", true}, {"zero_rad", 0.7}}));
  arm(bench);
  bench.law = {.position_rad = 0.3, .stiffness_Nmprad = 40, .damping_Nmsprad = 2};
  bench.load_Nm = -1;
  bench.run(milliseconds(2000), AxisRequest::run);
  EXPECT_NEAR(bench.shaft.position_rad, 0.3 - 1.0 / 40, 0.002);
  EXPECT_NEAR(bench.motion.position_rad, bench.shaft.position_rad, 0.001);
  EXPECT_NEAR(bench.motion.effort_Nm, 1, 0.02);
}

TEST(Cubemars, StandsAtTheEndOfARangeAndCountsIt) {
  CanBench bench(subject({{"max_effort_Nm", 2.0}}));
  arm(bench);
  const std::uint64_t bad = bench.device->health(bench.now).bad;
  bench.law = {.effort_Nm = 3, .damping_Nmsprad = 1};
  bench.run(milliseconds(5), AxisRequest::run);
  EXPECT_EQ(bench.device->health(bench.now).bad, bad + 1);
  EXPECT_EQ(bench.sent.back(), mit::encode_mit(1, {0, 0, 0, 1, 2}, {12.5, 50, 18}));
}

std::string refusal(std::initializer_list<std::pair<std::string_view, OptionValue>> options) {
  try {
    test::made_of(kCubemarsMitEntry, subject(options).options);
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "";
}

/// Of an AK80-6 a step is 0.037 rad/s; rounded down, slow speeds would be a tenth too slow.
TEST(Cubemars, IsToldTheNearestSpeedThatAFrameHolds) {
  CanBench bench(subject({{"model", std::string("AK80-6")}}));
  arm(bench);
  for (const double told_radps : {0.5, 0.1, -0.1, -3.0, 76.0}) {
    bench.sent.clear();
    bench.run(milliseconds(10), AxisRequest::run, told_radps);
    ASSERT_FALSE(bench.sent.empty());
    EXPECT_NEAR(bench.actuator->setpoint_radps(bench.sent.back(), 0), told_radps, 76.0 / 4095);
  }
}

TEST(Cubemars, RefusesIdsThatAreAnothersAndWhatItsRangesDoNotHold) {
  EXPECT_TRUE(refusal({{"master_id", 3.0}}).starts_with("master_id: "));
  EXPECT_TRUE(refusal({{"id", 127.0}}).starts_with("id "));
  EXPECT_TRUE(refusal({{"timeout_ms", 10.0}}).starts_with("timeout_ms: "));
  EXPECT_TRUE(refusal({{"zero_rad", 13.0}}).starts_with("zero_rad: "));
  EXPECT_TRUE(refusal({{"max_effort_Nm", 19.0}}).starts_with("max_effort_Nm: "));
  EXPECT_TRUE(refusal({{"model", std::string("AK00")}}).starts_with("model "));
  for (const double id : {1.0, 0.0, 200.0}) EXPECT_EQ(refusal({{"master_id", id}}), "") << id;
  EXPECT_EQ(refusal({{"max_effort_Nm", 19.0}, {"t_max_Nm", 20.0}}), "") << "another firmware";
}

TEST(Cubemars, HasNoModelBeforeItIsToldOne) {
  Options options(kCubemarsMitEntry.options);
  options.set("id", 1.0);
  EXPECT_THROW(test::made_of(kCubemarsMitEntry, options), std::runtime_error);
}

}  // namespace
}  // namespace drover::cubemars_mit
