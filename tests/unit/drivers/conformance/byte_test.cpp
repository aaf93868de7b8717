// What every driver of a byte stream must do.
#include <gtest/gtest.h>

#include <functional>

#include "support/describe.h"
#include "support/imu_bench.h"
#include "unit/drivers/conformance/harness.h"

namespace drover::test {
namespace {

class ByteConformance : public ::testing::TestWithParam<Subject> {
 protected:
  Made make() const { return made_of(*GetParam().entry, GetParam().options); }
  /// Bytes arrive as on a line of 115200 bit/s, whatever the chunks.
  static constexpr Duration kByteTime = std::chrono::nanoseconds(86806);

  /// Everything reported, in order, and the counters, for one way of chunking.
  std::string outcome(std::span<const std::uint8_t> bytes,
                      const std::function<std::size_t()>& next_size) const {
    const auto driver = make();
    const Time start{std::chrono::seconds(10)};
    driver.device->on_link_up(start);
    std::string text;
    Reason words;
    DriverOut out;
    for (std::size_t at = 0; at < bytes.size();) {
      const std::size_t size = std::min(next_size(), bytes.size() - at);
      out.clear();
      driver.bytes->on_bytes(bytes.subspan(at, size), start + kByteTime * static_cast<long>(at),
                             out);
      EXPECT_EQ(out.overflows, 0U);
      if (!out.measurements.empty()) text += describe(out) + "; ";
      // Of what was told in one call only the last has its words.
      for (const Measurement& m : out.measurements)
        if (has_words(m)) words = driver.device->words(m);
      at += size;
    }
    const SourceHealth health = driver.device->health(start);
    text += std::string(words.view()) + ' ';
    return text + std::to_string(health.good) + "/" + std::to_string(health.bad);
  }
};

TEST_P(ByteConformance, GivesTheSameForAnyChunking) {
  const auto bytes = golden_bytes(*GetParam().entry);
  ASSERT_FALSE(bytes.empty());
  // A driver's output holds 64 measurements: 256 bytes are never more than that.
  const std::string whole = outcome(bytes, [] { return std::size_t{256}; });
  EXPECT_EQ(outcome(bytes, [] { return std::size_t{1}; }), whole);
  std::mt19937 random(3);
  for (int i = 0; i < 20; ++i)
    EXPECT_EQ(outcome(bytes, [&] { return std::size_t{1 + random() % 60}; }), whole);
}

TEST_P(ByteConformance, SurvivesEveryTruncation) {
  for (const GoldenFile& file : read_goldens(DROVER_SOURCE_DIR, *GetParam().entry)) {
    for (const GoldenCase& one : file.cases) {
      for (std::size_t size = 0; size <= one.bytes.size(); ++size) {
        const auto driver = make();
        DriverOut out;
        driver.bytes->on_bytes({one.bytes.data(), size}, Time{std::chrono::seconds(1)}, out);
        driver.device->on_tick(Time{std::chrono::seconds(2)}, out);
        EXPECT_EQ(out.overflows, 0U);
      }
    }
  }
}

TEST_P(ByteConformance, SurvivesAHundredThousandRandomBytesAndAllocatesNothing) {
  const auto like = golden_bytes(*GetParam().entry);
  std::mt19937 random(20250101);
  const auto driver = make();
  Time now{std::chrono::seconds(1)};
  DriverOut out;
  std::array<std::uint8_t, 64> chunk{};
  std::uint64_t allocations = 0;
  for (int i = 0; i < 1600; ++i) {
    const std::size_t from = like.empty() ? 0 : random() % like.size();
    for (std::size_t k = 0; k < chunk.size(); ++k) {
      const bool noise = like.empty() || random() % 40 == 0 || i % 4 == 0;
      chunk[k] = noise ? static_cast<std::uint8_t>(random()) : like[(from + k) % like.size()];
    }
    now += milliseconds(5);
    out.clear();
    AllocationCounter counter;
    driver.bytes->on_bytes(chunk, now, out);
    driver.device->on_tick(now, out);
    allocations += counter.count();
    ASSERT_EQ(out.overflows, 0U);
  }
  EXPECT_EQ(allocations, 0U);
}

/// Receivers of a position.
class GnssConformance : public ByteConformance {};

TEST_P(GnssConformance, IsNeverHeardThenFreshThenStaleAndSaysWhy) {
  const auto driver = make();
  Time now{std::chrono::seconds(100)};
  driver.device->on_link_up(now);
  EXPECT_EQ(driver.device->health(now).state, SourceState::never_heard);
  const auto twin = std::get<MakeGnssTwin>(GetParam().entry->make_twin)(GetParam().options, 1);
  GnssTruth truth;
  truth.latitude_deg = 31.2;
  truth.longitude_deg = 121.5;
  truth.altitude_m = 12;
  truth.heading_deg = 77;
  truth.speed_mps = 0.5;
  truth.course_deg = 77;
  std::array<char, 4096> text{};
  DriverOut out;
  GnssPosition position;
  for (const Time end = now + std::chrono::seconds(20); now < end; now += milliseconds(5)) {
    const std::size_t size = twin->on_tick(now, truth, text);
    std::vector<std::uint8_t> bytes(text.begin(), text.begin() + static_cast<long>(size));
    for (std::size_t at = 0; at < bytes.size(); at += 32) {
      out.clear();
      driver.bytes->on_bytes({bytes.data() + at, std::min<std::size_t>(32, bytes.size() - at)},
                             now + kByteTime * static_cast<long>(at), out);
      for (const Measurement& m : out.measurements)
        if (const auto* value = std::get_if<GnssPosition>(&m.value)) position = *value;
    }
    out.clear();
    driver.device->on_tick(now, out);
  }
  const SourceHealth health = driver.device->health(now);
  EXPECT_EQ(health.state, SourceState::fresh) << health.reason.view();
  EXPECT_EQ(health.bad, 0U);
  EXPECT_GT(health.good, 100U);
  EXPECT_NEAR(position.latitude_deg, truth.latitude_deg, 1e-4);
  EXPECT_NEAR(position.longitude_deg, truth.longitude_deg, 1e-4);
  now += std::chrono::seconds(3);
  driver.device->on_tick(now, out);
  EXPECT_EQ(driver.device->health(now).state, SourceState::stale);
  EXPECT_FALSE(driver.device->health(now).reason.empty());
}

/// Sensors of the robot's motion.
class ImuConformance : public ByteConformance {
 protected:
  ImuBench make_bench() const {
    return {make(), std::get<MakeImuTwin>(GetParam().entry->make_twin)(GetParam().options, 1),
            static_cast<std::uint32_t>(GetParam().options.number("baud"))};
  }
};

/// Turning left on level ground.
TEST_P(ImuConformance, TellsTheMotionOfItsTwinThenGoesStaleAndSaysWhy) {
  ImuBench bench = make_bench();
  EXPECT_EQ(bench.driver->health(bench.now).state, SourceState::never_heard);
  bench.truth.angular_velocity_radps = {0, 0, 0.5};
  bench.run(std::chrono::seconds(20));
  const SourceHealth health = bench.driver->health(bench.now);
  EXPECT_EQ(health.state, SourceState::fresh) << health.reason.view();
  EXPECT_TRUE(health.reason.empty()) << health.reason.view();
  EXPECT_EQ(health.bad, 0U);
  EXPECT_GT(bench.samples, 100U);
  EXPECT_NEAR(bench.sample.acceleration_mps2.z, 9.81, 0.5);
  EXPECT_NEAR(bench.sample.angular_velocity_radps.z, 0.5, 0.05);
  Time last = kNever;
  for (const Measurement& m : bench.heard) {
    ASSERT_GE(m.time, last);
    ASSERT_LE(m.time, bench.now);
    last = m.time;
  }
  EXPECT_EQ(bench.overflows, 0U);
  EXPECT_TRUE(bench.twin->set_state("silent", bench.now));
  bench.run(std::chrono::seconds(3));
  EXPECT_EQ(bench.driver->health(bench.now).state, SourceState::stale);
  EXPECT_FALSE(bench.driver->health(bench.now).reason.empty());
  EXPECT_TRUE(bench.twin->set_state("", bench.now));
  bench.run(std::chrono::seconds(3));
  EXPECT_EQ(bench.driver->health(bench.now).state, SourceState::fresh);
}

TEST_P(ImuConformance, DoesNotBelieveReadingsThatStandStillOrEndTheirRange) {
  for (const char* state : {"frozen", "saturated"}) {
    ImuBench bench = make_bench();
    bench.run(std::chrono::seconds(5));
    ASSERT_EQ(bench.driver->health(bench.now).state, SourceState::fresh);
    ASSERT_TRUE(bench.twin->set_state(state, bench.now));
    bench.run(std::chrono::seconds(2));
    EXPECT_EQ(bench.driver->health(bench.now).state, SourceState::stale) << state;
    EXPECT_FALSE(bench.driver->health(bench.now).reason.empty()) << state;
  }
}

INSTANTIATE_TEST_SUITE_P(Registry, ByteConformance, ::testing::ValuesIn(subjects(&Made::bytes)),
                         label_of);
INSTANTIATE_TEST_SUITE_P(Registry, GnssConformance,
                         ::testing::ValuesIn(subjects_with_twin<MakeGnssTwin>(&Made::bytes)),
                         label_of);
INSTANTIATE_TEST_SUITE_P(Registry, ImuConformance,
                         ::testing::ValuesIn(subjects_with_twin<MakeImuTwin>(&Made::bytes)),
                         label_of);

class LineConformance : public ::testing::TestWithParam<Subject> {
 protected:
  Made make() const { return made_of(*GetParam().entry, GetParam().options); }
};

TEST_P(LineConformance, IsActiveUntilItWasRead) {
  const auto driver = make();
  DriverOut out;
  driver.device->on_tick(Time{std::chrono::seconds(1)}, out);
  EXPECT_EQ(describe(out), "line_state line=estop active=true");
  EXPECT_EQ(driver.device->health(Time{std::chrono::seconds(1)}).state, SourceState::never_heard);
}

TEST_P(LineConformance, IsReleasedByOneLevelAndActiveWhenLostOrSilent) {
  for (const bool lost : {false, true}) {
    int released = 0;
    for (const bool high : {false, true}) {
      const auto driver = make();
      DriverOut out;
      Time now{std::chrono::seconds(1)};
      AllocationCounter counter;
      for (int i = 0; i < 400; ++i, now += milliseconds(5)) {
        driver.levels->on_level(high, now, out);
        driver.device->on_tick(now, out);
      }
      EXPECT_EQ(counter.count(), 0U);
      if (describe(out).find("active=false") == std::string::npos) continue;
      ++released;
      out.clear();
      if (lost) driver.levels->on_lost(now, out);
      now += milliseconds(100);
      driver.device->on_tick(now, out);
      EXPECT_EQ(describe(out), "line_state line=estop active=true");
      EXPECT_EQ(driver.device->health(now).state, SourceState::stale);
      EXPECT_FALSE(driver.device->health(now).reason.empty());
    }
    EXPECT_EQ(released, 1) << "exactly one level means that all is well";
  }
}

INSTANTIATE_TEST_SUITE_P(Registry, LineConformance, ::testing::ValuesIn(subjects(&Made::levels)),
                         label_of);

}  // namespace
}  // namespace drover::test
