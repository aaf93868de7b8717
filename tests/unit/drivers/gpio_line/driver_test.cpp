#include "drivers/gpio_line/driver.h"

#include <gtest/gtest.h>

#include "support/describe.h"

namespace drover::gpio_line {
namespace {

using std::chrono::milliseconds;
using test::describe;

class Bench {
 public:
  explicit Bench(const Options& options = Options(option_table()), Line line = Line::estop)
      : driver(read_settings(options, line)) {}
  /// Readings each 5 ms.
  std::string read(bool high, int times = 1) {
    out.clear();
    for (int i = 0; i < times; ++i) {
      now += milliseconds(5);
      driver.on_level(high, now, out);
      driver.on_tick(now, out);
    }
    return describe(out);
  }

  Time now{std::chrono::seconds(1)};
  GpioLineDriver driver;
  DriverOut out;
};

constexpr auto kActive = "line_state line=estop active=true";
constexpr auto kReleased = "line_state line=estop active=false";

TEST(GpioLine, RefusesADebouncedEmergencyStop) {
  Options options(option_table());
  options.set("active_debounce_s", 0.01);
  EXPECT_THROW(read_settings(options, Line::estop), std::runtime_error);
  EXPECT_NO_THROW(read_settings(options, Line::zone_near));
}

TEST(GpioLine, RefusesUnknownLevelsAndBadTimes) {
  EXPECT_THROW(
      read_settings(Options(option_table()).set("active_level", std::string("up")), Line::bumper),
      std::runtime_error);
  EXPECT_THROW(read_settings(Options(option_table()).set("release_debounce_s", -1.0), Line::bumper),
               std::runtime_error);
  EXPECT_THROW(read_settings(Options(option_table()).set("stale_s", kAbsent), Line::bumper),
               std::runtime_error);
}

TEST(GpioLine, IsNotReleasedByABounceShorterThanTheDebounce) {
  Bench bench;
  EXPECT_EQ(bench.read(false), kActive);
  EXPECT_EQ(bench.read(true, 39), "nothing");  // 190 ms
  EXPECT_EQ(bench.read(false), "nothing");
  EXPECT_EQ(bench.read(true, 40), "nothing");
  EXPECT_EQ(bench.read(true), kReleased);
}

TEST(GpioLine, CountsAnEdgeToActiveAtOnce) {
  Bench bench;
  bench.read(true, 50);
  EXPECT_EQ(bench.read(false), kActive);
}

TEST(GpioLine, CountsAPulseBetweenTwoPolls) {
  Bench bench;
  bench.read(true, 50);
  bench.out.clear();
  bench.driver.on_level(false, bench.now + milliseconds(1), bench.out);
  bench.driver.on_level(true, bench.now + milliseconds(2), bench.out);
  EXPECT_EQ(describe(bench.out), kActive);
  EXPECT_EQ(bench.read(true, 39), "nothing");
}

TEST(GpioLine, IsActiveWhenLostAndNeedsTheWholeReleaseTimeAfterwards) {
  Bench bench;
  bench.read(true, 50);
  bench.out.clear();
  bench.driver.on_lost(bench.now, bench.out);
  EXPECT_EQ(describe(bench.out), kActive);
  EXPECT_EQ(bench.driver.health(bench.now).reason, "the line cannot be read");
  EXPECT_EQ(bench.read(true, 40), "nothing");
  EXPECT_EQ(bench.read(true), kReleased);
}

TEST(GpioLine, TellsThatItIsNotKnownBeforeItsContactHasHeld) {
  Bench bench;
  bench.driver.on_lost(bench.now, bench.out);
  EXPECT_EQ(bench.driver.health(bench.now).state, SourceState::never_heard);
  bench.read(true, 10);
  EXPECT_EQ(bench.driver.health(bench.now).state, SourceState::never_heard);
  EXPECT_EQ(bench.driver.health(bench.now).reason,
            "not known yet, its contact has to hold for a moment");
  bench.read(true, 2);
  EXPECT_EQ(bench.driver.health(bench.now).state, SourceState::fresh);
  EXPECT_TRUE(bench.driver.health(bench.now).reason.empty());
}

TEST(GpioLine, IsKnownAtOnceWhenItIsActive) {
  Bench bench;
  bench.read(false);
  EXPECT_EQ(bench.driver.health(bench.now).state, SourceState::fresh);
}

TEST(GpioLine, IsNotFreshAfterALossBeforeItsContactHasHeldAgain) {
  Bench bench;
  bench.read(true, 50);
  bench.driver.on_lost(bench.now, bench.out);
  bench.read(true, 2);
  EXPECT_EQ(bench.driver.health(bench.now).state, SourceState::stale);
  bench.read(true, 41);
  EXPECT_EQ(bench.driver.health(bench.now).state, SourceState::fresh);
}

TEST(GpioLine, IsActiveWhenReadingsCease) {
  Bench bench;
  bench.read(true, 50);
  bench.out.clear();
  bench.driver.on_tick(bench.now + milliseconds(20), bench.out);
  EXPECT_EQ(describe(bench.out), "nothing");
  bench.driver.on_tick(bench.now + milliseconds(21), bench.out);
  EXPECT_EQ(describe(bench.out), kActive);
}

TEST(GpioLine, IsNotReleasedByReadingsWithGapsBetweenThem) {
  Bench bench;
  bench.read(true);
  for (int i = 0; i < 20; ++i) {
    bench.now += milliseconds(50);
    EXPECT_EQ(bench.read(true), "nothing");
  }
}

TEST(GpioLine, DoesNotGoBackInTimeForAnOldEdge) {
  Bench bench;
  bench.read(true, 50);
  bench.out.clear();
  bench.driver.on_level(false, bench.now - milliseconds(3), bench.out);
  ASSERT_EQ(bench.out.measurements.size(), 1U);
  EXPECT_EQ(bench.out.measurements[0].time, bench.now);
}

TEST(GpioLine, IgnoresTestPulsesOfAScannerWhenTold) {
  Options options(option_table());
  options.set("active_debounce_s", 0.012);
  Bench bench(options, Line::zone_near);
  bench.read(true, 50);
  EXPECT_EQ(bench.read(false, 2), "nothing");
  EXPECT_EQ(bench.read(true, 1), "nothing");
  EXPECT_EQ(bench.read(false, 4), "line_state line=zone_near active=true");
}

TEST(GpioLine, ReadsAnActiveHighLine) {
  Options options(option_table());
  options.set("active_level", std::string("high"));
  Bench bench(options);
  EXPECT_EQ(bench.read(false, 41), std::string(kActive) + "; " + kReleased);
  EXPECT_EQ(bench.read(true), kActive);
}

}  // namespace
}  // namespace drover::gpio_line
