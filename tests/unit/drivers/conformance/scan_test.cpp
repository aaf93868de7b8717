// What every scanner must do: say what it sees, and never call free what it does not.
#include <gtest/gtest.h>

#include "unit/drivers/conformance/harness.h"

namespace drover::test {
namespace {

using namespace std::chrono_literals;

/// A room of 6 m by 4 m with the scanner in its middle.
double in_a_room_m(double bearing_rad) {
  return std::min(3 / std::abs(std::cos(bearing_rad)), 2 / std::abs(std::sin(bearing_rad)));
}

class ScanConformance : public ::testing::TestWithParam<Subject> {
 protected:
  ScanConformance()
      : made(made_of(*GetParam().entry, GetParam().options)),
        twin(std::get<MakeScannerTwin>(GetParam().entry->make_twin)(GetParam().options, 1)) {
    made.device->on_link_up(now);
  }

  void run(Duration time) {
    for (const Time end = now + time; now < end;) {
      now += 5ms;
      const std::size_t size = twin->on_tick(now, world, said);
      ScanOut out;
      AllocationCounter counter;
      made.scans->on_bytes({reinterpret_cast<const std::uint8_t*>(said.data()), size}, now, out);
      allocations += counter.count();
      EXPECT_EQ(out.overflows, 0U);
      for (const Scan& scan : out.scans) scans.push_back(scan);
    }
  }
  SourceHealth health() const { return made.device->health(now); }
  std::size_t seen_free() const {
    std::size_t count = 0;
    for (const SectorState state : scans.back().sectors) count += state == SectorState::seen_free;
    return count;
  }

  Made made;
  std::unique_ptr<ScannerTwin> twin;
  RangeOf world = in_a_room_m;
  Time now{100s};
  std::array<char, 4096> said{};
  std::vector<Scan> scans;
  std::uint64_t allocations = 0;
};

TEST_P(ScanConformance, HasGoldenBytesOfKnownOrigin) {
  const auto files = read_goldens(DROVER_SOURCE_DIR, *GetParam().entry);
  ASSERT_FALSE(files.empty());
  for (const GoldenFile& file : files) {
    EXPECT_TRUE(file.has_source && file.has_provenance) << file.path;
    EXPECT_FALSE(file.cases.empty()) << file.path;
  }
}

TEST_P(ScanConformance, IsNeverHeardThenFreshThenStaleAndSaysWhy) {
  EXPECT_EQ(health().state, SourceState::never_heard);
  EXPECT_FALSE(health().reason.empty());
  run(3s);
  EXPECT_EQ(health().state, SourceState::fresh) << health().reason.view();
  EXPECT_EQ(health().bad, 0U);
  ASSERT_FALSE(scans.empty());
  EXPECT_LE(scans.back().end, now);
  EXPECT_LT(now - scans.back().end, 300ms);
  EXPECT_EQ(seen_free(), scans.back().sectors.size());
  for (const ScanPoint& point : scans.back().points) {
    ASSERT_GE(point.bearing_rad, -kPi);
    ASSERT_LT(point.bearing_rad, kPi);
    EXPECT_NEAR(point.range_m, in_a_room_m(point.bearing_rad), 0.1);
  }
  EXPECT_EQ(allocations, 0U);
  ASSERT_TRUE(twin->set_state("silent", now));
  run(2s);
  EXPECT_EQ(health().state, SourceState::stale);
  EXPECT_FALSE(health().reason.empty());
  ASSERT_TRUE(twin->set_state("", now));
  run(2s);
  EXPECT_EQ(health().state, SourceState::fresh);
}

TEST_P(ScanConformance, CallsNothingFreeThatItDoesNotSee) {
  for (const char* state : {"covered", "sun", "frozen"}) {
    ASSERT_TRUE(twin->set_state("", now));
    run(3s);
    ASSERT_EQ(health().state, SourceState::fresh) << health().reason.view();
    ASSERT_TRUE(twin->set_state(state, now));
    run(2s);
    EXPECT_EQ(health().state, SourceState::stale) << state;
    EXPECT_FALSE(health().reason.empty()) << state;
    EXPECT_EQ(seen_free(), 0U) << state;
  }
}

TEST_P(ScanConformance, SurvivesAHundredThousandRandomBytesAndAllocatesNothing) {
  const auto like = golden_bytes(*GetParam().entry);
  std::mt19937 random(20250101);
  std::array<std::uint8_t, 64> chunk{};
  ScanOut out;
  AllocationCounter counter;
  for (int i = 0; i < 1600; ++i) {
    const std::size_t from = random() % like.size();
    for (std::size_t k = 0; k < chunk.size(); ++k) {
      const bool noise = random() % 40 == 0 || i % 4 == 0;
      chunk[k] = noise ? static_cast<std::uint8_t>(random()) : like[(from + k) % like.size()];
    }
    now += 5ms;
    out.clear();
    made.scans->on_bytes(chunk, now, out);
    (void)made.device->health(now);
    ASSERT_EQ(out.overflows, 0U);
  }
  EXPECT_EQ(counter.count(), 0U);
}

INSTANTIATE_TEST_SUITE_P(Registry, ScanConformance, ::testing::ValuesIn(subjects(&Made::scans)),
                         label_of);

}  // namespace
}  // namespace drover::test
