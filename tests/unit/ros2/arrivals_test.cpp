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
  info.source_timestamp = (kUtc + 50ms) / 1ns;
  EXPECT_EQ(said_at(info, kLook, kUtc), kLook) << "another thread read the clock";
  info.source_timestamp = (kUtc + 1s) / 1ns;
  EXPECT_EQ(said_at(info, kLook, kUtc), Time{1ns}) << "the clock was set back: nobody knows";
  info.source_timestamp = 0;
  EXPECT_EQ(said_at(info, kLook, kUtc), Time{1ns});
}

/// What waited while a program hung and the clock was set back is not of now.
TEST(ASample, IsNotOfNowWhereItIsOldOrFromAfterNow) {
  constexpr Duration kUtc = std::chrono::hours(500'000);
  const auto why = [kUtc](Duration stamp) {
    dds_sample_info_t info{};
    info.source_timestamp = stamp / 1ns;
    return too_late(info, kUtc, 300ms);
  };
  EXPECT_EQ(why(kUtc - 300ms), "");
  EXPECT_EQ(why(kUtc + 100ms), "");
  EXPECT_NE(why(kUtc - 301ms).find("too late"), std::string::npos);
  EXPECT_NE(why(kUtc + 101ms).find("set back"), std::string::npos);
  EXPECT_NE(why(kUtc + std::chrono::hours(24)).find("set back"), std::string::npos);
  EXPECT_NE(why(Duration{}).find("no DDS time stamp"), std::string::npos);
}

}  // namespace
}  // namespace drover::ros2
