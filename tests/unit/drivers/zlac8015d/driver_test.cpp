// What is a ZLAC8015D's own, beside what the conformance suite asks of every drive.
#include "drivers/zlac8015d/driver.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "unit/drivers/zlac8015d/bench.h"

namespace drover::zlac8015d {
namespace {

using std::chrono::milliseconds;
using test::describe;
using test::parse_frame;

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
