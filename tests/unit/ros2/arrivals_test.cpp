// When something came, as the loop sees it that was held up.
#include "ros2/arrivals.h"

#include <gtest/gtest.h>

#include "ros2/samples.h"

namespace drover::ros2 {
namespace {

using namespace std::chrono_literals;

constexpr Time kLook{100s};

TEST(Arrivals, AreFromTheOldestToTheNewestSinceTheLastLook) {
  Arrivals arrivals;
  for (const Duration ago : {290ms, 150ms, 10ms}) arrivals.came(kLook - ago);
  auto since = arrivals.look(kLook);
  EXPECT_EQ(since.oldest, kLook - 290ms);
  EXPECT_EQ(since.newest, kLook - 10ms);
  arrivals.came(kLook + 20ms);
  since = arrivals.look(kLook + 1s);
  EXPECT_EQ(since.oldest, kLook + 20ms);
  EXPECT_EQ(since.newest, kLook + 20ms);
}

TEST(Arrivals, ThatNobodyToldOfYetAreOfNow) {
  Arrivals arrivals;
  EXPECT_EQ(arrivals.look(kLook).oldest, kLook);
  EXPECT_EQ(arrivals.look(kLook).newest, kLook);
}

TEST(ASample, WasSaidAsLongAgoAsItsTimeStampIsOld) {
  constexpr Duration kUtc = std::chrono::hours(500'000);
  dds_sample_info_t info{};
  info.source_timestamp = (kUtc - 200ms) / 1ns;
  EXPECT_EQ(said_at(info, kLook, kUtc), kLook - 200ms);
  info.source_timestamp = (kUtc + 1s) / 1ns;
  EXPECT_EQ(said_at(info, kLook, kUtc), kLook) << "a clock that was set meanwhile";
  info.source_timestamp = 0;
  EXPECT_EQ(said_at(info, kLook, kUtc), Time{1ns});
}

}  // namespace
}  // namespace drover::ros2
