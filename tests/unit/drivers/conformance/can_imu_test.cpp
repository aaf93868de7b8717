// Inertial sensors on CAN, each beside its twin.
#include "drover/angle.h"
#include "unit/drivers/conformance/harness.h"

namespace drover::test {
namespace {

/// 5 ms ticks. Who waits for it hears an NMT start to all, as from another master.
struct CanImuBench {
  explicit CanImuBench(const Subject& subject)
      : made(made_of(*subject.entry, subject.options)),
        twin(std::get<MakeCanImuTwin>(subject.entry->make_twin)(subject.options, 1)) {
    truth.specific_force_mps2 = {0, 0, 9.80665};
    made.device->on_link_up(now);
    start();
  }
  void start() {
    TwinFrames answers;
    twin->on_frame(make_frame(0, {1, 0}), now, answers);
    hear(answers);
  }
  void run(Duration time) {
    for (const Time end = now + time; now < end; now += milliseconds(5)) {
      TwinFrames frames;
      twin->on_tick(now, truth, frames);
      hear(frames);
      DriverOut out;
      made.device->on_tick(now, out);
      sent += out.frames.size();
    }
  }
  void hear(const TwinFrames& frames) {
    for (const CanFrame& frame : frames) {
      DriverOut out;
      made.frames->on_frame(frame, now, out);
      sent += out.frames.size();
      for (const Measurement& m : out.measurements)
        if (const auto* value = std::get_if<ImuSample>(&m.value)) {
          EXPECT_GE(m.time, last);
          EXPECT_LE(m.time, now);
          last = m.time;
          sample = *value;
          ++samples;
        }
    }
  }
  SourceHealth health() const { return made.device->health(now); }

  Made made;
  std::unique_ptr<CanImuTwin> twin;
  ImuTruth truth;
  Time now{std::chrono::seconds(100)};
  Time last = kNever;
  ImuSample sample;
  std::size_t samples = 0;
  std::size_t sent = 0;
};

class CanImuConformance : public ::testing::TestWithParam<Subject> {
 protected:
  CanImuBench bench{GetParam()};
};

/// Turning left on level ground.
TEST_P(CanImuConformance, TellsTheMotionOfItsTwinThenGoesStaleAndSaysWhy) {
  EXPECT_EQ(bench.health().state, SourceState::never_heard);
  EXPECT_FALSE(bench.health().reason.empty());
  bench.truth.angular_velocity_radps = {0, 0, 0.5};
  bench.run(std::chrono::seconds(20));
  EXPECT_EQ(bench.health().state, SourceState::fresh) << bench.health().reason.view();
  EXPECT_TRUE(bench.health().reason.empty()) << bench.health().reason.view();
  EXPECT_EQ(bench.health().bad, 0U);
  EXPECT_GT(bench.samples, 100U);
  EXPECT_NEAR(bench.sample.acceleration_mps2.z, 9.81, 0.5);
  EXPECT_NEAR(bench.sample.angular_velocity_radps.z, 0.5, 0.05);
  EXPECT_TRUE(bench.twin->set_state("silent", bench.now));
  bench.run(std::chrono::seconds(3));
  EXPECT_EQ(bench.health().state, SourceState::stale);
  EXPECT_FALSE(bench.health().reason.empty());
  EXPECT_TRUE(bench.twin->set_state("", bench.now));
  bench.run(std::chrono::seconds(3));
  EXPECT_EQ(bench.health().state, SourceState::fresh);
}

/// What moves nothing sends nothing on a bus.
TEST_P(CanImuConformance, SendsNothing) {
  bench.run(std::chrono::seconds(2));
  bench.twin->set_state("silent", bench.now);
  bench.run(std::chrono::seconds(2));
  bench.made.device->on_link_up(bench.now);
  bench.run(std::chrono::seconds(2));
  EXPECT_EQ(bench.sent, 0U);
}

TEST_P(CanImuConformance, DoesNotBelieveReadingsAtTheEndOfTheirRange) {
  bench.run(std::chrono::seconds(5));
  ASSERT_EQ(bench.health().state, SourceState::fresh);
  ASSERT_TRUE(bench.twin->set_state("saturated", bench.now));
  bench.run(std::chrono::seconds(2));
  EXPECT_EQ(bench.health().state, SourceState::stale);
  EXPECT_FALSE(bench.health().reason.empty());
}

TEST_P(CanImuConformance, IsFreshAgainAfterItsSupplyWasAway) {
  bench.run(std::chrono::seconds(2));
  ASSERT_TRUE(bench.twin->set_state("silent", bench.now));
  bench.run(std::chrono::seconds(3));
  ASSERT_EQ(bench.health().state, SourceState::stale);
  ASSERT_TRUE(bench.twin->set_state("", bench.now));
  ASSERT_TRUE(bench.twin->set_state("restart", bench.now));
  bench.start();
  bench.run(std::chrono::seconds(2));
  EXPECT_EQ(bench.health().state, SourceState::fresh) << bench.health().reason.view();
}

INSTANTIATE_TEST_SUITE_P(Registry, CanImuConformance,
                         ::testing::ValuesIn(subjects_with_twin<MakeCanImuTwin>(&Made::frames)),
                         label_of);

}  // namespace
}  // namespace drover::test
