// A DAMIAO motor beside its twin: what it must be found to be before it is enabled, and how it is
// lost and taken back.
#include "drivers/damiao/driver.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "drivers/damiao/entry.h"
#include "support/describe.h"
#include "unit/drivers/conformance/harness.h"
#include "unit/drivers/mit/unheard_motor.h"

namespace drover::damiao {
namespace {

using mit::test::expect_damped;
using std::chrono::milliseconds;
using test::CanBench;

test::Subject subject(std::initializer_list<std::pair<std::string_view, OptionValue>> more = {}) {
  Options options = test::example_options(kDamiaoEntry);
  options.set("id", 1.0);
  for (const auto& [name, value] : more) options.set(name, value);
  return {&kDamiaoEntry, options, "damiao"};
}

bool has(const std::vector<CanFrame>& frames, const CanFrame& frame) {
  return std::find(frames.begin(), frames.end(), frame) != frames.end();
}
const CanFrame kEnable = encode_special(1, Special::enable);
const CanFrame kClear = encode_special(1, Special::clear_error);

void arm(CanBench& bench) {
  bench.run(milliseconds(500), AxisRequest::rest);
  bench.run(milliseconds(1500), AxisRequest::run);
  ASSERT_EQ(bench.status.state, AxisState::running) << bench.status.reason.view();
}

void expect_refused(const test::Subject& subject, std::string_view words) {
  CanBench bench(subject);
  bench.run(milliseconds(1000), AxisRequest::rest);
  EXPECT_EQ(bench.status.state, AxisState::fault);
  EXPECT_EQ(bench.status.reason.view(), words);
  bench.run(milliseconds(3000), AxisRequest::run, 1.0);
  EXPECT_EQ(bench.status.state, AxisState::fault);
  EXPECT_EQ(bench.status.reason.view(), words);
  EXPECT_FALSE(has(bench.sent, kEnable));
  EXPECT_EQ(bench.shaft.torque_Nm, 0);
}

TEST(Damiao, IsNotEnabledWhenItsRangesAreOthers) {
  expect_refused(subject({{"saved_p_max_rad", 3.1416}}),
                 "its position range is 3.142 rad, configured is 12.5");
  expect_refused(subject({{"saved_v_max_radps", 8.0}, {"model", std::string("DM4340")}}),
                 "its velocity range is 8 rad/s, configured is 10");
  expect_refused(subject({{"saved_t_max_Nm", 28.0}}),
                 "its torque range is 28 Nm, configured is 10");
}

TEST(Damiao, IsNotEnabledInAnotherMode) {
  expect_refused(subject({{"saved_mode", 3.0}}),
                 "it is in control mode 3, not in 1 (MIT): set register 10");
}

TEST(Damiao, SetsTheTimeOutOnlyWhereItDiffersAndOnlyInMemory) {
  const CanFrame write = encode_write(1, reg::kTimeout, 2000);
  CanBench bench(subject());
  arm(bench);
  EXPECT_TRUE(has(bench.sent, write));
  CanBench saved(subject({{"saved_timeout_ms", 100.0}}));
  arm(saved);
  EXPECT_FALSE(has(saved.sent, write));
  for (const CanFrame& frame : bench.sent)
    if (frame.id == kRequestId) {
      EXPECT_NE(frame.data[2], 0xAA);
    }
}

/// With what it lost, though nobody noticed that it was away.
TEST(Damiao, SetsTheTimeOutAnewAtEachArming) {
  CanBench bench(subject());
  arm(bench);
  bench.run(milliseconds(2500), AxisRequest::idle);
  bench.send(encode_write(1, reg::kTimeout, 0));
  bench.sent.clear();
  bench.run(milliseconds(500), AxisRequest::run);
  EXPECT_EQ(bench.status.state, AxisState::running);
  EXPECT_TRUE(has(bench.sent, encode_write(1, reg::kTimeout, 2000)));
}

TEST(Damiao, LeavesItATimeAfterItsSupplyCame) {
  CanBench bench(subject());
  bench.twin->set_power(false, bench.now);
  bench.run(milliseconds(500), AxisRequest::rest);
  bench.twin->set_power(true, bench.now);
  bench.run(milliseconds(500), AxisRequest::rest);
  bench.run(milliseconds(700), AxisRequest::run);
  EXPECT_FALSE(has(bench.sent, kEnable)) << "0.9 s after it was heard";
  EXPECT_EQ(bench.status.state, AxisState::arming);
  bench.run(milliseconds(300), AxisRequest::run);
  EXPECT_EQ(bench.status.state, AxisState::running);
}

TEST(Damiao, TellsEachErrorAndClearsItOnlyForANewRequest) {
  const std::pair<const char*, const char*> cases[] = {
      {"over_current", "it reports an error: over current"},
      {"over_voltage", "it reports an error: supply over voltage"},
      {"under_voltage", "it reports an error: supply under voltage"},
      {"overload", "it reports an error: overload"},
      {"lost_comm", "it reports an error: no command came within its time-out"},
      {"leaves_closed_loop", "it let go by itself"},
  };
  for (const auto& [fault, words] : cases) {
    SCOPED_TRACE(fault);
    CanBench bench(subject());
    arm(bench);
    ASSERT_TRUE(bench.twin->set_fault(fault, bench.now));
    bench.sent.clear();
    bench.run(milliseconds(2000), AxisRequest::run, 1.0);
    EXPECT_EQ(bench.status.state, AxisState::fault);
    EXPECT_EQ(bench.status.reason.view(), words);
    EXPECT_FALSE(bench.status.powered);
    EXPECT_FALSE(has(bench.sent, kEnable));
    EXPECT_FALSE(has(bench.sent, kClear));
    bench.run(milliseconds(100), AxisRequest::rest);
    bench.run(milliseconds(500), AxisRequest::run, 1.0);
    EXPECT_EQ(bench.status.state, AxisState::running) << bench.status.reason.view();
  }
}

TEST(Damiao, GivesUpAnErrorThatStays) {
  CanBench bench(subject());
  arm(bench);
  bench.twin->set_fault("over_temperature", bench.now);
  bench.run(milliseconds(100), AxisRequest::rest);
  EXPECT_EQ(bench.status.reason, "motor over temperature");
  EXPECT_EQ(bench.status.error_code, 0xCU);
  bench.sent.clear();
  bench.run(milliseconds(2000), AxisRequest::run);
  EXPECT_EQ(bench.status.reason, "its error does not clear: motor over temperature");
  EXPECT_EQ(std::count(bench.sent.begin(), bench.sent.end(), kClear), 1);
  EXPECT_FALSE(has(bench.sent, kEnable));
}

/// Its own time-out, while this gateway was not there.
TEST(Damiao, CallsAMotorThatNobodyFedSound) {
  CanBench bench(subject());
  arm(bench);
  bench.driver_alive = false;
  for (int i = 0; i < 60; ++i) bench.step({});
  EXPECT_FALSE(bench.shaft.energized) << "limp after 0.1 s";
  CanBench after(subject());
  after.twin = std::move(bench.twin);
  after.now = bench.now;
  after.run(milliseconds(200), AxisRequest::rest);
  EXPECT_EQ(after.status.state, AxisState::idle);
  EXPECT_EQ(after.status.reason,
            "its time-out ran out while nobody fed it: cleared at the next start");
  after.run(milliseconds(2000), AxisRequest::run);
  EXPECT_EQ(after.status.state, AxisState::running) << after.status.reason.view();
}

/// Its answers are lost, not its ears: a question would leave it at its last command.
TEST(Damiao, IsMadeToDampWhenNobodyHearsIt) {
  CanBench bench(subject());
  arm(bench);
  bench.law = {.effort_Nm = 1};
  bench.run(milliseconds(50), AxisRequest::run);
  bench.twin->set_fault("silent", bench.now);
  bench.run(milliseconds(1000), AxisRequest::run);
  EXPECT_EQ(bench.status.state, AxisState::unknown);
  EXPECT_EQ(bench.status.reason, "no answer for more than 0.1 s");
  EXPECT_NEAR(bench.shaft.velocity_radps, 0, 0.02);
}

/// A motor that holds a weight, of which nothing is heard, and a driver that never heard it.
void begin_anew(CanBench& bench) {
  CanBench before(subject());
  arm(before);
  mit::test::begin_anew(bench, before);
}

/// Its time-out would let go of what only obeys and is not heard.
TEST(Damiao, IsMadeToDampByADriverThatNeverHeardIt) {
  CanBench bench(subject());
  begin_anew(bench);
  bench.run(milliseconds(5), AxisRequest::rest);
  const CanFrame damp = bench.actuator->stop_recipe().rounds[0].frames[0];
  EXPECT_TRUE(has(bench.sent, damp)) << "from the first cycle on";
  bench.sent.clear();
  bench.run(milliseconds(2000), AxisRequest::rest);
  expect_damped(bench);
  EXPECT_TRUE(has(bench.sent, encode_request(1))) << "one in another mode answers to that alone";
  EXPECT_LE(bench.sent.size(), 220U) << "100 a second to damp, and 10 questions";
  EXPECT_EQ(bench.status.state, AxisState::unknown);
}

TEST(Damiao, IsMadeToDampAfterANewLinkWhenNobodyHearsIt) {
  for (const AxisRequest request : {AxisRequest::run, AxisRequest::hold, AxisRequest::rest}) {
    CanBench bench(subject());
    arm(bench);
    bench.load_Nm = 1;
    bench.twin->set_fault("silent", bench.now);
    bench.run(milliseconds(200), request);
    bench.device->on_link_up(bench.now);
    bench.run(milliseconds(2000), request);
    expect_damped(bench);
    bench.twin->set_fault("", bench.now);
    bench.run(milliseconds(2000), request);
    expect_damped(bench);
    EXPECT_TRUE(bench.moving.empty() || request == AxisRequest::run);
  }
}

/// Who wants it let go gets that: it is only asked, and its own time-out does it.
TEST(Damiao, IsNotMadeToDampByADriverThatNeverHeardItWhenItIsLetGo) {
  CanBench bench(subject());
  begin_anew(bench);
  bench.run(milliseconds(1000), AxisRequest::idle);
  EXPECT_FALSE(bench.shaft.energized);
  for (const CanFrame& frame : bench.sent) EXPECT_EQ(frame, encode_request(1));
}

/// What is off stays off: damping enables nothing.
TEST(Damiao, StaysOffWhenItIsMadeToDampBeforeItIsHeard) {
  CanBench bench(subject());
  bench.twin->set_fault("silent", bench.now);
  bench.run(milliseconds(1000), AxisRequest::rest);
  EXPECT_FALSE(bench.shaft.energized);
  bench.twin->set_fault("", bench.now);
  bench.run(milliseconds(300), AxisRequest::rest);
  EXPECT_EQ(bench.status.state, AxisState::idle);
  bench.sent.clear();
  bench.run(milliseconds(300), AxisRequest::rest);
  EXPECT_FALSE(has(bench.sent, bench.actuator->stop_recipe().rounds[0].frames[0]));
}

/// The guard's frames are enough: two programs need not say the same.
TEST(Damiao, LeavesItToTheGuardWhileThatMakesItDamp) {
  CanBench bench(subject());
  begin_anew(bench);
  const CanFrame damp = bench.actuator->stop_recipe().rounds[0].frames[0];
  bench.inject(damp);
  for (int i = 0; i < 50; ++i) {
    bench.run(milliseconds(10), AxisRequest::rest);
    bench.send(damp);
    bench.inject(damp);
  }
  EXPECT_FALSE(has(bench.sent, damp));
  expect_damped(bench);
  bench.run(milliseconds(2000), AxisRequest::rest);
  EXPECT_TRUE(has(bench.sent, damp));
  expect_damped(bench);
}

TEST(Damiao, TakesNoRegisterForAFeedback) {
  CanBench bench(subject());
  arm(bench);
  const double before_rad = bench.motion.position_rad;
  bench.inject(encode_reply(0x11, 1, {Verb::read, reg::kPMax, 0x41480000}));
  EXPECT_TRUE(bench.out.measurements.empty());
  bench.run(milliseconds(50), AxisRequest::run);
  EXPECT_EQ(bench.motion.position_rad, before_rad);
  EXPECT_EQ(bench.status.state, AxisState::running);
}

TEST(Damiao, AnUndocumentedStatusIsNotEnabled) {
  CanBench bench(subject());
  arm(bench);
  bench.twin->set_power(false, bench.now);
  bench.inject(make_frame(0x11, {0x31, 0x7F, 0xFF, 0x7F, 0xF7, 0xFF, 0x19, 0x19}));
  EXPECT_EQ(bench.status.state, AxisState::fault);
  EXPECT_EQ(bench.status.reason,
            "it let go by itself: status 3, which its maker does not document");
}

/// Its motor may be on, whatever that status says: asked alone, its time-out would let go.
TEST(Damiao, IsMadeToDampInAStatusThatNobodyHasDocumented) {
  for (const std::uint8_t status : {2, 3, 4, 5, 6, 7, 0xF}) {
    CanBench bench(subject());
    arm(bench);
    const auto first = static_cast<std::uint8_t>(status << 4 | 1);
    bench.twin->set_power(false, bench.now);
    const CanFrame damp = bench.actuator->stop_recipe().rounds[0].frames[0];
    for (int i = 0; i < 20; ++i) {
      bench.inject(make_frame(0x11, {first, 0x7F, 0xFF, 0x7F, 0xF7, 0xFF, 0x19, 0x19}));
      bench.sent.clear();
      bench.run(milliseconds(10), AxisRequest::run);
      EXPECT_TRUE(has(bench.sent, damp)) << "status " << int{status};
    }
    EXPECT_EQ(bench.status.state, AxisState::fault);
  }
}

TEST(Damiao, IsGivenUpWhenSomebodyElseCommandsIt) {
  for (const CanFrame& frame :
       {encode_mit(1, {0, 1, 0, 1, 0}, {}), kEnable, encode_write(1, reg::kTimeout, 0),
        encode_special(1, Special::disable)}) {
    CanBench bench(subject());
    arm(bench);
    bench.inject(frame);
    bench.sent.clear();
    bench.run(milliseconds(200), AxisRequest::run, 1.0);
    EXPECT_EQ(bench.status.state, AxisState::fault) << test::describe(frame);
    for (const CanFrame& sent : bench.sent)
      EXPECT_NE(bench.effect_of(sent), FrameEffect::motion) << test::describe(sent);
  }
  // The guard, and who only reads.
  CanBench bench(subject());
  arm(bench);
  bench.inject(bench.actuator->stop_recipe().rounds[0].frames[0]);
  bench.inject(encode_read(1, 14));
  bench.inject(encode_write(2, reg::kTimeout, 0));
  bench.run(milliseconds(200), AxisRequest::run);
  EXPECT_EQ(bench.status.state, AxisState::running);
}

TEST(Damiao, SendsNoMoreInACycleThanItSays) {
  CanBench bench(subject());
  bench.run(milliseconds(500), AxisRequest::rest);
  bench.run(milliseconds(2000), AxisRequest::run, 1.0);
  bench.twin->set_fault("over_current", bench.now);
  bench.run(milliseconds(500), AxisRequest::rest);
  bench.run(milliseconds(1000), AxisRequest::run, 1.0);
  bench.run(milliseconds(2000), AxisRequest::idle);
  EXPECT_LE(bench.most_frames, bench.actuator->messages_per_cycle());
}

TEST(Damiao, TellsPlaceSpeedAndEffortOfTheJoint) {
  CanBench bench(subject({{"reversed", true}, {"zero_rad", 0.7}}));
  arm(bench);
  bench.law = {.position_rad = 0.3, .stiffness_Nmprad = 40, .damping_Nmsprad = 2};
  bench.load_Nm = -1;
  bench.run(milliseconds(2000), AxisRequest::run);
  EXPECT_NEAR(bench.shaft.position_rad, 0.3 - 1.0 / 40, 0.002);
  EXPECT_NEAR(bench.motion.position_rad, bench.shaft.position_rad, 0.001);
  EXPECT_NEAR(bench.motion.effort_Nm, 1, 0.02);
}

TEST(Damiao, WithoutATimeOutSaysThatItGoesOn) {
  CanBench bench(subject({{"timeout_ms", 0.0}}));
  EXPECT_FALSE(bench.actuator->silence().stops);
  arm(bench);
  bench.law = {.effort_Nm = 0.5};
  bench.run(milliseconds(50), AxisRequest::run);
  bench.driver_alive = false;
  for (int i = 0; i < 200; ++i) bench.step({});
  EXPECT_TRUE(bench.shaft.energized);
  EXPECT_NEAR(bench.shaft.torque_Nm, 0.5, 0.01);
}

TEST(Damiao, RefusesIdsThatAreAnothersAndTimesThatAreTooShort) {
  const auto refusal = [](std::string_view name, OptionValue value) {
    try {
      test::made_of(kDamiaoEntry, subject({{name, value}}).options);
    } catch (const std::runtime_error& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_TRUE(refusal("master_id", 3.0).starts_with("master_id: "));
  EXPECT_TRUE(refusal("timeout_ms", 20.0).starts_with("timeout_ms: "));
  EXPECT_TRUE(refusal("zero_rad", 13.0).starts_with("zero_rad: "));
  EXPECT_TRUE(refusal("max_effort_Nm", 11.0).starts_with("max_effort_Nm: "));
  EXPECT_EQ(refusal("master_id", 33.0), "");
  EXPECT_TRUE(refusal("model", std::string()).starts_with("model must be \"DM4310\" or "));
}

}  // namespace
}  // namespace drover::damiao
