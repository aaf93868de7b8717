// Which ROS 2 programs with Fast DDS, ROS 2's default, meet drover-ros2 on the robot's computer,
// which has a network.
#include <gtest/gtest.h>

#include <array>
#include <iostream>
#include <thread>

#include "integration/ros2_fastdds_user.h"
#include "integration/ros2_our_side.h"
#include "integration/two_computers.h"
#include "runtime/clock.h"

namespace drover::test {
namespace {

using namespace std::chrono_literals;
using fast::Told;

/// drover-ros2 is there already when they come, and has said so.
constexpr auto kBeforeThem = 3s;
/// It may be that only drover-ros2 looks round, in its own time.
constexpr auto kFastMeetsWithin = 60s;
/// More programs before it than Fast DDS looks for when nobody tells it how many.
constexpr int kCrowd = 6;

struct FastCase {
  const char* name;
  Ours ours;
  Told user;
  int before = 0;
};

void PrintTo(const FastCase& one, std::ostream* out) {
  *out << one.name;
}

constexpr std::array kFastCases{
    FastCase{"LocalhostAndDefaults", Ours::shipped_localhost, Told::nothing},
    FastCase{"LocalhostAndJazzy", Ours::shipped_localhost, Told::by_jazzy},
    FastCase{"LocalhostAndJazzyInACrowd", Ours::shipped_localhost, Told::by_jazzy, kCrowd},
    FastCase{"LocalhostAndHumble", Ours::shipped_localhost, Told::by_humble},
    FastCase{"LocalhostAndOurFile", Ours::shipped_localhost, Told::by_our_file},
    FastCase{"LocalhostAndOurFileInACrowd", Ours::shipped_localhost, Told::by_our_file, kCrowd},
    FastCase{"NetworkAndDefaults", Ours::shipped_network, Told::nothing},
};

class Ros2MeetsFastDds : public TwoComputers, public testing::TestWithParam<FastCase> {
 protected:
  OurSide ours_{GetParam().ours, GetParam().before};
};

TEST_P(Ros2MeetsFastDds, WhomTheTableSays) {
  std::this_thread::sleep_for(kBeforeThem);
  fast::User user(kMeetingDomain, GetParam().user, DROVER_SOURCE_DIR "/config/ros2/fastdds.xml");
  const auto reader = user.reader<fast::Odometry>(meeting_topic().name);
  const Time begin = runtime::monotonic_now();
  const Time until = begin + kFastMeetsWithin;
  bool met = false;
  while (!met && runtime::monotonic_now() < until) {
    std::this_thread::sleep_for(20ms);
    met = reader->newest().has_value();
  }
  EXPECT_TRUE(met) << reader->writers() << " writers";
  EXPECT_TRUE(ours_.alive());
  if (met) std::cout << "after " << to_s(runtime::monotonic_now() - begin) << " s\n";
}

INSTANTIATE_TEST_SUITE_P(, Ros2MeetsFastDds, testing::ValuesIn(kFastCases),
                         [](const auto& one) { return one.param.name; });

}  // namespace
}  // namespace drover::test
