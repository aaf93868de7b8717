// What a ZLAC8015D does when its targets cease, and how it is fed on while its answers are lost.
#include <gtest/gtest.h>

#include <algorithm>

#include "unit/drivers/zlac8015d/bench.h"

namespace drover::zlac8015d {
namespace {

using std::chrono::milliseconds;
using test::describe;
using test::parse_frame;

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

}  // namespace
}  // namespace drover::zlac8015d
