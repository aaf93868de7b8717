// What is a ZLAC8015D's own, beside what the conformance suite asks of every drive.
#include <gtest/gtest.h>

#include <algorithm>

#include "drivers/zlac8015d/driver.h"
#include "support/describe.h"
#include "unit/drivers/conformance/harness.h"

namespace drover::zlac8015d {
namespace {

using std::chrono::milliseconds;
using test::describe;
using test::parse_frame;

constexpr auto kRun = AxisRequest::run;
constexpr auto kRest = AxisRequest::rest;

/// Made when it is asked for: the table of options is filled at the program's start.
const Settings& settings() {
  static const Settings all = read_settings(Options(option_table()));
  return all;
}

/// The registry's driver beside its twin.
struct Bench : test::CanBench {
  Bench() : CanBench(subject()) {}
  static test::Subject subject() {
    const DriverEntry* const entry = find_driver("zlac8015d");
    return {entry, test::example_options(*entry), "zlac8015d"};
  }
  void arm() {
    run(milliseconds(800), kRest);
    run(milliseconds(500), kRun, 0.0);
    ASSERT_EQ(status.state, AxisState::running) << status.reason.view();
  }
  bool has_sent(const std::string& frame) const {
    return std::any_of(sent.begin(), sent.end(),
                       [&](const CanFrame& each) { return describe(each) == frame; });
  }
};

FrameEffect effect_of(const std::string& frame, const Pair& target = {}) {
  return effect(parse_frame(frame), settings(), steps_of(settings()), target).kind;
}

TEST(Zlac8015dCodec, ReadsTheMakersExamples) {
  EXPECT_EQ(decode_pair(parse_frame("281#1AFCFFFFEA030000"), Cob::velocities, 1),
            (Pair{-998, 1002}));
  EXPECT_EQ(describe(encode_targets(1, {100, -100})), "301#640000009CFFFFFF");
  EXPECT_EQ(describe(encode_controlword(1, 0x0F)), "201#0F00");
}

TEST(Zlac8015dCodec, TakesTheWorseOfBothWheels) {
  const auto state = [](const std::string& frame) {
    return drive_state(*decode_status(parse_frame(frame), 1));
  };
  using canopen::DriveState;
  EXPECT_EQ(state("181#2700270000000000"), DriveState::operation_enabled);
  EXPECT_EQ(state("181#2700230000000000"), DriveState::switched_on);
  EXPECT_EQ(state("181#2000270000000000"), DriveState::switch_on_disabled);
  EXPECT_EQ(state("181#2700280004000000"), DriveState::fault);
  EXPECT_EQ(state("181#0700270000000000"), DriveState::quick_stop_active);
  EXPECT_EQ(error_text(*decode_status(parse_frame("181#2700280001000400"), 1)), "over-current");
  EXPECT_EQ(error_text(*decode_status(parse_frame("181#2700280000000400"), 1)),
            "over-current, of the left or the right motor");
  EXPECT_EQ(error_text(*decode_status(parse_frame("181#2800270000100000"), 1)),
            "error 0x1000, of the left or the right motor");
  EXPECT_TRUE(error_text(*decode_status(parse_frame("181#2700270000000000"), 1)).empty());
}

TEST(Zlac8015dRules, ForbidWhatWritesFlashOrMeansAnotherNode) {
  for (const char* const frame :
       {"601#2B10200001000000", "601#2B09200001000000", "601#2B05200003000000",
        "601#2B0A200002000000", "601#2310100173617665", "601#23FF600164000000", "000#0100",
        "000#8101", "000#8001", "000#0102", "201#1F00", "601#2B40600000000000"})
    EXPECT_EQ(effect_of(frame), FrameEffect::forbidden) << frame;
}

TEST(Zlac8015dRules, NameTheWheelThatMoves) {
  EXPECT_EQ(effect_of("301#0000000000000000"), FrameEffect::stop);
  const auto moves = [](const char* frame) {
    return effect(parse_frame(frame), settings(), steps_of(settings()), {}).moves;
  };
  EXPECT_EQ(moves("301#6400000000000000"), channel_bit(kLeft));
  EXPECT_EQ(moves("301#0000000064000000"), channel_bit(kRight));
  EXPECT_EQ(moves("301#6400000064000000"), channel_bit(kLeft) | channel_bit(kRight));
}

TEST(Zlac8015dRules, EnablingMovesWhatATargetLeftInTheDrive) {
  EXPECT_EQ(effect_of("201#0F00"), FrameEffect::harmless);
  EXPECT_EQ(effect_of("201#0F00", {100, 0}), FrameEffect::motion);
}

TEST(Zlac8015d, WritesTargetsOfZeroBeforeAnythingElse) {
  Bench bench;
  bench.run(milliseconds(800), kRest);
  std::vector<std::string> writes;
  for (const CanFrame& frame : bench.sent)
    if (frame.id == 0x601 && frame.data[0] != kSdoRead) writes.push_back(describe(frame));
  ASSERT_GT(writes.size(), 3U);
  EXPECT_EQ(writes[0], "601#23FF600100000000");
  EXPECT_EQ(writes[1], "601#23FF600200000000");
  EXPECT_EQ(writes[2], "601#2B002000C8000000") << "its time-out, as in the maker's example";
  EXPECT_TRUE(bench.has_sent("000#0101"));
}

TEST(Zlac8015d, BelievesNoProcessDataBeforeItsSetUp) {
  Bench bench;
  bench.inject(parse_frame("701#05"));
  bench.inject(parse_frame("181#2700270000000000"));
  bench.inject(parse_frame("281#1AFCFFFFEA030000"));
  EXPECT_TRUE(bench.out.measurements.empty());
  EXPECT_NE(bench.status.state, AxisState::running);
}

TEST(Zlac8015d, SetsUpANodeThatWasRestartedAndStaysAtRest) {
  Bench bench;
  bench.arm();
  bench.run(milliseconds(300), kRun, 2.0);
  bench.inject(parse_frame("701#00"));
  bench.sent.clear();
  bench.run(milliseconds(2000), kRun, 2.0);
  EXPECT_TRUE(bench.has_sent("601#2B002000C8000000"));
  EXPECT_EQ(bench.status.state, AxisState::fault);
  EXPECT_EQ(bench.status.reason, "the drive was restarted while armed");
}

/// Without it nobody would see a fault, or the emergency stop on the drive's own connector.
TEST(Zlac8015d, IsGivenUpWhenItsStatusCeasesThoughItsSpeedsCome) {
  Bench bench;
  bench.arm();
  bench.run(milliseconds(300), kRun, 2.0);
  bench.lost = id_of(Cob::status, 1);
  bench.run(milliseconds(150), kRun, 2.0);
  EXPECT_EQ(bench.device->health(bench.now).state, SourceState::stale);
  EXPECT_EQ(bench.device->health(bench.now).reason.view().substr(0, 15), "no status (181)");
  bench.run(milliseconds(250), kRun, 2.0);
  EXPECT_EQ(bench.status.state, AxisState::unknown);
  EXPECT_EQ(bench.status.reason.view().substr(0, 15), "no status (181)");
  EXPECT_EQ(describe(bench.sent.back()), "301#0000000000000000");
  bench.lost.reset();
  bench.run(milliseconds(500), kRun, 2.0);
  EXPECT_EQ(bench.status.state, AxisState::fault) << "it runs again by a new request only";
}

/// It may have lost its power meanwhile, whatever it answers first.
TEST(Zlac8015d, ForgetsItsTargetsAndItsStatusWhenItAnswersAfterASilence) {
  Bench bench;
  bench.arm();
  bench.run(milliseconds(300), kRun, 2.0);
  bench.twin->set_power(false, bench.now);
  bench.run(milliseconds(500), kRun, 2.0);
  bench.run(milliseconds(20), kRest);
  ASSERT_EQ(bench.status.state, AxisState::unknown);
  bench.inject(parse_frame("581#4B41600000000000"));
  EXPECT_EQ(bench.effect_of(parse_frame("201#0F00")), FrameEffect::harmless);
}

/// Driven, then left alone under a load as of a slope.
template <class AnyBench>
void leave_alone(AnyBench& bench) {
  bench.run(milliseconds(800), kRest);
  bench.run(milliseconds(1500), kRun, 3.0);
  ASSERT_NEAR(bench.shafts[kLeft].velocity_radps, 3.0, 0.1);
  bench.driver_alive = false;
  bench.load_Nm = 4;
  for (int i = 0; i < 400; ++i) bench.step({kRun, 3.0});
}

/// The maker does not say whether it holds: the simulated one is no better than the worse reading.
TEST(Zlac8015d, LetsGoOfBothWheelsWhenTargetsCease) {
  Bench bench;
  leave_alone(bench);
  const SilenceBehaviour silence = bench.actuator->silence();
  EXPECT_EQ(silence.ends, StopEnds::coasts);
  EXPECT_TRUE(silence.assumed);
  EXPECT_EQ(silence.text,
            "lets go, as far as is known, after 0.200 s (its time-out, set and read back at each "
            "start)");
  for (const Shaft& shaft : bench.shafts) {
    EXPECT_FALSE(shaft.energized);
    EXPECT_EQ(shaft.torque_Nm, 0);
  }
}

TEST(Zlac8015d, HoldsBothWheelsWhenTargetsCeaseWhereAPersonTriedIt) {
  test::Subject tried = Bench::subject();
  tried.options.set("silence_holds", true);
  test::CanBench bench(tried);
  leave_alone(bench);
  const SilenceBehaviour silence = bench.actuator->silence();
  EXPECT_EQ(silence.ends, StopEnds::holds);
  EXPECT_FALSE(silence.assumed);
  EXPECT_EQ(silence.text.substr(0, 15), "stops and holds");
  for (const Shaft& shaft : bench.shafts) {
    EXPECT_TRUE(shaft.energized);
    EXPECT_NEAR(shaft.velocity_radps, 0, 0.02);
  }
}

/// The set-up takes half a second, in which a drive that holds the robot is not to let go.
TEST(Zlac8015d, HoldsOnWhileItIsSetUpAnew) {
  for (const double silence_ms : {30.0, 100.0, 200.0}) {
    test::Subject subject = Bench::subject();
    subject.options.set("silence_ms", silence_ms);
    test::CanBench bench(subject);
    bench.run(milliseconds(1500), kRest);
    bench.run(milliseconds(500), kRun, 0.0);
    bench.run(milliseconds(100), kRest);
    bench.load_Nm = 4;
    bench.run(milliseconds(500), kRest);
    const double held_rad = bench.shafts[kLeft].position_rad;
    bench.device->on_link_up(bench.now);
    bench.sent.clear();
    for (int i = 0; i < 400; ++i) {
      bench.step({kRest, 0});
      ASSERT_TRUE(bench.shafts[kLeft].energized) << silence_ms << " ms, cycle " << i;
    }
    EXPECT_EQ(bench.device->health(bench.now).state, SourceState::fresh);
    EXPECT_NEAR(bench.shafts[kLeft].position_rad, held_rad, 0.02);
  }
}

/// Holding the robot on a slope at rest, or rolling down a ramp to it; then its answers are lost,
/// and it obeys.
struct MuteBench : test::CanBench {
  static test::Subject subject_of(double silence_ms) {
    test::Subject subject = Bench::subject();
    subject.options.set("silence_ms", silence_ms);
    return subject;
  }
  explicit MuteBench(double silence_ms = 200) : CanBench(subject_of(silence_ms)) {
    run(milliseconds(800), kRest);
    run(milliseconds(500), kRun, 0.0);
    load_Nm = 4;
  }
  void mute() {
    sent.clear();
    ASSERT_TRUE(twin->set_fault("silent", now));
  }
  std::size_t zeros() const {
    return static_cast<std::size_t>(std::count_if(
        sent.begin(), sent.end(),
        [](const CanFrame& each) { return describe(each) == "301#0000000000000000"; }));
  }
};

/// Its time-out would let go of the robot on a slope, though both it and the gateway are well.
TEST(Zlac8015d, IsFedOnWhileItsAnswersAreLost) {
  for (const double radps : {0.0, 3.0}) {
    MuteBench bench;
    bench.run(milliseconds(1500), kRun, radps);
    if (radps == 0) bench.run(milliseconds(300), kRest);
    bench.mute();
    for (int i = 0; i < 600; ++i) {
      bench.step({radps == 0 || i > 200 ? kRest : kRun, radps});
      for (const Shaft& shaft : bench.shafts)
        ASSERT_TRUE(shaft.energized) << radps << " rad/s, cycle " << i;
    }
    EXPECT_GT(bench.zeros(), 500U);
    EXPECT_EQ(bench.status.state, AxisState::unknown);
    for (const Shaft& shaft : bench.shafts) EXPECT_NEAR(shaft.velocity_radps, 0, 0.02);
    bench.twin->set_fault("", bench.now);
    for (int i = 0; i < 300; ++i) {
      bench.step({kRest, 0});
      ASSERT_TRUE(bench.shafts[kLeft].energized) << "while it is set up anew, cycle " << i;
    }
    EXPECT_EQ(bench.status.state, AxisState::running) << bench.status.reason.view();
  }
}

/// Its process data may be half mapped then: the service channel feeds it.
TEST(Zlac8015d, IsFedOnWhenItFallsSilentAgainInItsSetUp) {
  for (const double silence_ms : {30.0, 100.0, 200.0}) {
    for (int answered = 10; answered < 130; answered += 15) {
      MuteBench bench(silence_ms);
      bench.run(milliseconds(300), kRest);
      bench.mute();
      bench.run(milliseconds(600), kRest);
      bench.twin->set_fault("", bench.now);
      for (int i = 0; i < answered; ++i) bench.step({kRest, 0});
      bench.twin->set_fault("silent", bench.now);
      for (int i = 0; i < 300; ++i) {
        bench.step({kRest, 0});
        ASSERT_TRUE(bench.shafts[kLeft].energized)
            << silence_ms << " ms, " << answered << " answered, cycle " << i;
      }
    }
  }
}

/// Its heartbeats come, and no answers: the set-up fails, and is tried again after two seconds.
TEST(Zlac8015d, IsFedOnWhenItsSetUpFails) {
  for (const double heartbeat_ms : {20.0, 100.0}) {
    test::Subject subject = Bench::subject();
    subject.options.set("heartbeat_ms", heartbeat_ms);
    test::CanBench bench(subject);
    bench.run(milliseconds(800), kRest);
    bench.run(milliseconds(500), kRun, 0.0);
    bench.run(milliseconds(300), kRest);
    bench.lost = id_of(Cob::sdo_answer, 1);
    bench.device->on_link_up(bench.now);
    for (int i = 0; i < 1000; ++i) {
      bench.step({kRest, 0});
      ASSERT_TRUE(bench.shafts[kLeft].energized) << heartbeat_ms << " ms, cycle " << i;
    }
    EXPECT_EQ(bench.status.state, AxisState::fault);
  }
}

/// A person lets go of it: what is silent is let go of by its own time-out.
TEST(Zlac8015d, IsFedNoLongerWhenItWasReleased) {
  MuteBench bench;
  bench.run(milliseconds(300), kRest);
  bench.mute();
  bench.run(milliseconds(1000), kRest);
  bench.run(milliseconds(1500), AxisRequest::idle);
  EXPECT_FALSE(bench.shafts[kLeft].energized);
  bench.sent.clear();
  bench.run(milliseconds(500), kRest);
  EXPECT_EQ(bench.zeros(), 0U) << "it holds nothing any more";
}

/// It has forgotten what process data mean, or was off already.
TEST(Zlac8015d, IsNotFedInSilenceWhenItHoldsNothing) {
  Bench off;
  off.run(milliseconds(1500), kRest);
  ASSERT_EQ(off.status.state, AxisState::idle);
  MuteBench restarted;
  restarted.inject(parse_frame("701#00"));
  for (test::CanBench* bench :
       {static_cast<test::CanBench*>(&off), static_cast<test::CanBench*>(&restarted)}) {
    ASSERT_TRUE(bench->twin->set_fault("silent", bench->now));
    bench->run(milliseconds(800), kRest);
    bench->sent.clear();
    bench->run(milliseconds(500), kRest);
    for (const CanFrame& frame : bench->sent) EXPECT_EQ(describe(frame), "601#4041600000000000");
    EXPECT_GE(bench->sent.size(), 4U) << "it is asked on";
  }
}

/// Let go while its gateway lives: it has to be asked anew, as after any other loss of its power.
TEST(Zlac8015d, IsGivenUpWhenItsTimeOutFiresWhileItRuns) {
  test::Subject patient = Bench::subject();
  patient.options.set("heartbeat_timeout_s", 1.0);
  test::CanBench bench(patient);
  bench.run(milliseconds(800), kRest);
  bench.run(milliseconds(1500), kRun, 3.0);
  ASSERT_EQ(bench.status.state, AxisState::running) << bench.status.reason.view();
  bench.driver_alive = false;
  for (int i = 0; i < 60; ++i) bench.step({kRun, 3.0});
  bench.driver_alive = true;
  bench.run(milliseconds(50), kRun, 3.0);
  EXPECT_EQ(bench.status.state, AxisState::fault);
  EXPECT_EQ(bench.status.reason, "is no longer enabled");
  bench.run(milliseconds(20), kRest);
  bench.run(milliseconds(1000), kRun, 3.0);
  EXPECT_EQ(bench.status.state, AxisState::running) << bench.status.reason.view();
}

/// The other one has its power still, and would go on.
/// Who presses the button that is nearest means all of the robot, an arm as well.
TEST(Zlac8015d, TellsTheStopOnItsConnectorAsAStopOfAllOfTheRobot) {
  for (const bool runs : {true, false}) {
    Bench bench;
    if (runs)
      bench.arm();
    else
      bench.run(milliseconds(800), kRest);
    EXPECT_FALSE(bench.status.stops_all);
    bench.inject(parse_frame("181#4080408000000000"));
    EXPECT_TRUE(bench.status.stops_all);
    EXPECT_EQ(bench.status.state, AxisState::fault);
    EXPECT_NE(bench.status.reason.view().find("emergency stop input is active"),
              std::string_view::npos)
        << bench.status.reason.view();
  }
}

TEST(Zlac8015d, AFaultOfOneWheelStopsBoth) {
  for (const auto& [fault, text] : {std::pair{"over_temperature", "motor too hot"},
                                    {"over_current", "over-current"},
                                    {"leaves_enabled", ""}}) {
    Bench bench;
    bench.arm();
    bench.run(milliseconds(1000), kRun, 3.0);
    ASSERT_TRUE(bench.twin->set_fault(fault, bench.now));
    bench.sent.clear();
    bench.run(milliseconds(100), kRun, 3.0);
    EXPECT_EQ(bench.status.state, AxisState::fault);
    EXPECT_TRUE(bench.status.powered) << "of the other wheel";
    EXPECT_NE(bench.status.reason.view().find(text), std::string_view::npos)
        << bench.status.reason.view();
    EXPECT_EQ(describe(bench.sent.back()), "301#0000000000000000");
    bench.run(milliseconds(1500), kRun, 3.0);
    const std::size_t well = fault == std::string_view("over_temperature") ? kRight : kLeft;
    EXPECT_TRUE(bench.shafts[well].energized) << fault;
    EXPECT_NEAR(bench.shafts[well].velocity_radps, 0, 0.02) << fault;
    EXPECT_FALSE(bench.shafts[1 - well].energized) << fault;
  }
}

TEST(Zlac8015d, CatchesAWheelOnThoughTheOtherIsAtRestAlready) {
  Bench bench;
  bench.arm();
  const Setpoint wanted[] = {{AxisRequest::hold, 2.0, {}}, {AxisRequest::rest, 0, {}}};
  bench.out.clear();
  bench.actuator->on_setpoints(wanted, bench.now, bench.out);
  ASSERT_FALSE(bench.out.frames.empty());
  EXPECT_EQ(describe(bench.out.frames[0]), "301#BE00000000000000");
  const Setpoint done[] = {{AxisRequest::rest, 0, {}}, {AxisRequest::rest, 0, {}}};
  bench.out.clear();
  bench.actuator->on_setpoints(done, bench.now, bench.out);
  EXPECT_EQ(describe(bench.out.frames[0]), "301#0000000000000000");
}

/// A node that came back takes no process data: the guard asks its service channel as well.
TEST(Zlac8015d, IsStoppedByEachHalfOfItsRecipe) {
  for (const std::uint32_t half : {0x301U, 0x601U}) {
    test::Subject without_time_out = Bench::subject();
    without_time_out.options.set("silence_ms", 0.0);
    test::CanBench bench(without_time_out);
    bench.run(milliseconds(800), kRest);
    bench.run(milliseconds(1500), kRun, 3.0);
    ASSERT_NEAR(bench.shafts[kRight].velocity_radps, 3.0, 0.1);
    bench.driver_alive = false;
    for (int i = 0; i < 300; ++i) {
      for (const StopRound& round : bench.actuator->stop_recipe().rounds)
        for (const CanFrame& frame : round.frames)
          if (frame.id == half) bench.send(frame);
      bench.step({});
    }
    EXPECT_NEAR(bench.shafts[kLeft].velocity_radps, 0, 0.05) << half;
    EXPECT_NEAR(bench.shafts[kRight].velocity_radps, 0, 0.05) << half;
  }
}

TEST(Zlac8015d, SaysWhichObjectIsRefused) {
  Zlac8015dDriver driver(settings(), {0, 1});
  const Time now{std::chrono::seconds(5)};
  DriverOut out;
  driver.on_link_up(now);
  driver.on_frame(parse_frame("581#4360410000000000"), now, out);  // it is there
  driver.on_tick(now, out);
  driver.on_frame(parse_frame("581#80FF600100000206"), now, out);
  EXPECT_EQ(driver.health(now).state, SourceState::stale);
  EXPECT_EQ(driver.health(now).reason,
            "object 60FF:01 cannot be written: no such object (06020000)");
}

TEST(Zlac8015d, SomebodyElsesTargetsAreAFault) {
  Bench bench;
  bench.arm();
  bench.inject(parse_frame("301#0000000000000000"));  // the guard's
  bench.run(milliseconds(20), kRun, 1.0);
  EXPECT_EQ(bench.status.state, AxisState::running);
  bench.inject(parse_frame("301#6400000064000000"));
  bench.run(milliseconds(20), kRun, 1.0);
  EXPECT_EQ(bench.status.state, AxisState::fault);
}

/// What the guard never sends, though it stops: it releases, and the robot rolls.
TEST(Zlac8015d, SomebodyElsesReleaseOrQuickStopIsAFaultToo) {
  for (const char* const frame : {"201#0000", "201#0200"}) {
    Bench bench;
    bench.arm();
    for (const StopRound& round : bench.actuator->stop_recipe().rounds)
      for (const CanFrame& guards : round.frames) bench.inject(guards);
    bench.run(milliseconds(20), kRun, 1.0);
    ASSERT_EQ(bench.status.state, AxisState::running) << "the guard's are welcome";
    bench.inject(parse_frame(frame));
    bench.run(milliseconds(20), kRun, 1.0);
    EXPECT_EQ(bench.status.state, AxisState::fault) << frame;
    EXPECT_NE(bench.status.reason.view().find("somebody else"), std::string_view::npos)
        << bench.status.reason.view();
  }
}

}  // namespace
}  // namespace drover::zlac8015d
