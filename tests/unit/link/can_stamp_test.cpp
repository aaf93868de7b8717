#include "link/can_stamp.h"

#include <gtest/gtest.h>

namespace drover::link {
namespace {

using namespace std::chrono_literals;

constexpr Time kNow{100s};
constexpr Duration kDistance = 1'700'000'000s;

/// A stamp `ago` before this drain, by a wall clock that is so far from the monotonic one.
Duration stamped(Duration ago, Duration distance) {
  return (kNow - ago).time_since_epoch() + distance;
}

TEST(AStampOfTheKernel, IsTakenToTheMonotonicLine) {
  std::uint64_t clamped = 0;
  const StampWindow window{kNow - 5ms, kNow, kDistance};
  EXPECT_EQ(monotonic_stamp(stamped(3ms, kDistance), window, clamped), kNow - 3ms);
  EXPECT_EQ(monotonic_stamp(stamped(-1us, kDistance), window, clamped), kNow);
  EXPECT_EQ(clamped, 0U);
}

TEST(AStampOfTheKernel, KeepsItsTimeWhenSomebodySetsTheClockBeforeOrAfterIt) {
  for (const Duration step : {Duration(1s), Duration(-1s), Duration(15 * 8766h), Duration(-20ms)}) {
    std::uint64_t clamped = 0;
    const StampWindow window{kNow - 5ms, kNow, kDistance + step, kDistance};
    EXPECT_EQ(monotonic_stamp(stamped(4ms, kDistance), window, clamped), kNow - 4ms);
    EXPECT_EQ(monotonic_stamp(stamped(1ms, kDistance + step), window, clamped), kNow - 1ms);
    EXPECT_EQ(clamped, 0U);
  }
}

TEST(AStampOfTheKernel, ThatCannotBeIsClampedAndCounted) {
  std::uint64_t clamped = 0;
  const StampWindow window{kNow - 5ms, kNow, kDistance};
  EXPECT_EQ(monotonic_stamp(stamped(1s, kDistance), window, clamped), kNow - 5ms);
  EXPECT_EQ(monotonic_stamp(stamped(-1s, kDistance), window, clamped), kNow);
  EXPECT_EQ(clamped, 2U);
}

}  // namespace
}  // namespace drover::link
