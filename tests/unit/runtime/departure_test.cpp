#include "runtime/departure.h"

#include <gtest/gtest.h>

namespace drover::runtime {
namespace {

using namespace std::chrono_literals;

constexpr Duration kCycle = 5ms;
constexpr Time kDecided{10s};

TEST(Departure, LetsGoWhatIsAtMostTwoCyclesOld) {
  EXPECT_TRUE(may_leave({kDecided, false}, {kDecided, false}, kCycle));
  EXPECT_TRUE(may_leave({kDecided, false}, {kDecided + 10ms, false}, kCycle));
  EXPECT_FALSE(may_leave({kDecided, false}, {kDecided + 11ms, false}, kCycle));
}

TEST(Departure, HoldsWhatWasDecidedBeforeTheGuardTookTheBus) {
  EXPECT_FALSE(may_leave({kDecided, false}, {kDecided + 1ms, true}, kCycle));
  EXPECT_TRUE(may_leave({kDecided, true}, {kDecided + 1ms, true}, kCycle))
      << "judged as frames beside a guard that holds: questions and zeros";
}

}  // namespace
}  // namespace drover::runtime
