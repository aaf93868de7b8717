// Bytes as a line brings them: cut anywhere, damaged, foreign.
#include "drivers/ld06/driver.h"

#include <gtest/gtest.h>

#include <random>

#include "unit/drivers/ld06/rig.h"

namespace drover::ld06 {
namespace {

using namespace std::chrono_literals;
using test::ld06_options;

/// What the twin says in a second, with a byte damaged now and then.
std::vector<std::uint8_t> recorded(double damage) {
  Ld06Twin twin(false, 3);
  std::mt19937 random(4);
  std::array<char, 512> said{};
  std::vector<std::uint8_t> bytes;
  for (Time now{100s}; now < Time{101s}; now += 5ms) {
    const std::size_t size = twin.on_tick(now, test::room_m, said);
    for (std::size_t i = 0; i < size; ++i) {
      const bool hit = static_cast<double>(random() % 1000) < 1000 * damage;
      bytes.push_back(
          static_cast<std::uint8_t>(hit ? random() : static_cast<unsigned char>(said[i])));
    }
  }
  return bytes;
}

std::string outcome(std::span<const std::uint8_t> bytes, const std::function<std::size_t()>& next) {
  Ld06Driver driver(ld06_options());
  std::ostringstream text;
  text.precision(17);
  ScanOut out;
  for (std::size_t at = 0; at < bytes.size();) {
    const std::size_t size = std::min(next(), bytes.size() - at);
    out.clear();
    driver.on_bytes(bytes.subspan(at, size), Time{100s + static_cast<long>(at) * 43403ns}, out);
    EXPECT_EQ(out.overflows, 0U);
    for (const Scan& scan : out.scans) {
      text << scan.begin.time_since_epoch().count() << ' ' << scan.turn_Hz;
      for (const ScanPoint& point : scan.points)
        text << ' ' << point.bearing_rad << ' ' << point.range_m;
      for (const SectorState state : scan.sectors)
        text << (state == SectorState::unknown ? '?' : '.');
      text << '\n';
    }
    at += size;
  }
  text << driver.health(Time{101s}).good << '/' << driver.health(Time{101s}).bad;
  return text.str();
}

TEST(Ld06Driver, GivesTheSameForAnyChunking) {
  for (const double damage : {0.0, 0.005}) {
    const auto bytes = recorded(damage);
    const std::string whole = outcome(bytes, [] { return std::size_t{4096}; });
    EXPECT_GT(whole.size(), 10000U);
    EXPECT_EQ(outcome(bytes, [] { return std::size_t{1}; }), whole);
    std::mt19937 random(5);
    for (int i = 0; i < 5; ++i)
      EXPECT_EQ(outcome(bytes, [&] { return std::size_t{1 + random() % 600}; }), whole);
  }
}

TEST(Ld06Driver, LosesLittleWithDamagedBytesAndCountsThem) {
  const auto bytes = recorded(0.002);
  Ld06Driver driver(ld06_options());
  ScanOut out;
  std::size_t turns = 0;
  for (std::size_t at = 0; at < bytes.size(); at += 500) {
    out.clear();
    driver.on_bytes(std::span(bytes).subspan(at, std::min<std::size_t>(500, bytes.size() - at)),
                    Time{100s + static_cast<long>(at) * 43403ns}, out);
    turns += out.scans.size();
  }
  const SourceHealth health = driver.health(Time{101s});
  EXPECT_GT(health.bad, 10U);
  EXPECT_GT(health.good, 290U);
  EXPECT_GE(turns, 8U);
}

TEST(Ld06Driver, SaysThatItsLineLosesPacketsInsteadOfBlamingTheSun) {
  const auto bytes = recorded(0.02);
  Ld06Driver driver(ld06_options());
  ScanOut out;
  Time now{100s};
  for (std::size_t at = 0; at + 500 <= bytes.size(); at += 500) {
    now = Time{100s + static_cast<long>(at) * 43403ns};
    out.clear();
    driver.on_bytes(std::span(bytes).subspan(at, 500), now, out);
  }
  const std::string why(driver.health(now).reason.view());
  EXPECT_NE(driver.health(now).state, SourceState::fresh);
  EXPECT_NE(why.find("of 450 points arrive: its line loses packets"), std::string::npos) << why;
}

TEST(Ld06Driver, SurvivesAMillionRandomBytesAndAllocatesNothing) {
  const auto like = recorded(0);
  std::mt19937 random(6);
  Ld06Driver driver(ld06_options().set("self_filter", std::string("1 1, 1 -1, -1 0")));
  ScanOut out;
  std::array<std::uint8_t, 64> chunk{};
  std::uint64_t allocations = 0;
  Time now{100s};
  for (int i = 0; i < 16000; ++i) {
    const std::size_t from = random() % like.size();
    for (std::size_t k = 0; k < chunk.size(); ++k) {
      const bool noise = random() % 200 == 0 || i % 9 == 0;
      chunk[k] = noise ? static_cast<std::uint8_t>(random()) : like[(from + k) % like.size()];
    }
    now += 3ms;
    out.clear();
    test::AllocationCounter counter;
    driver.on_bytes(chunk, now, out);
    (void)driver.health(now);
    allocations += counter.count();
    ASSERT_EQ(out.overflows, 0U);
  }
  EXPECT_EQ(allocations, 0U);
}

TEST(Ld06Driver, SaysThatItHearsBytesAndNoPackets) {
  Ld06Driver driver(ld06_options());
  ScanOut out;
  const std::array<std::uint8_t, 10> bytes{};
  for (Time now{100s}; now < Time{102s}; now += 10ms) driver.on_bytes(bytes, now, out);
  EXPECT_EQ(driver.health(Time{102s}).reason,
            "bytes but no packet at 230400: baud, or another device?");
}

}  // namespace
}  // namespace drover::ld06
