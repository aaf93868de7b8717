// Which ROS 2 programs on the robot's computer, which has a network, meet drover-ros2: its domain
// as it makes it, and what else could have been chosen, beside each way they may be told. Those
// with Fast DDS: ros2_meets_fastdds_test.cpp.
#include <gtest/gtest.h>

#include <array>
#include <iostream>
#include <string>
#include <thread>

#include "integration/ros2_our_side.h"
#include "integration/ros2_user.h"
#include "integration/two_computers.h"
#include "runtime/clock.h"

namespace drover::test {
namespace {

using namespace std::chrono_literals;

constexpr auto kMeetsWithin = 15s;
/// Those who meet do so in a tenth of it: each tells at once that he is there.
constexpr auto kWouldHaveMet = 2s;

struct Case {
  const char* name;
  Ours ours;
  User user;
  bool meet;
};

void PrintTo(const Case& one, std::ostream* out) {
  *out << one.name;
}

constexpr std::array kCases{
    Case{"LocalhostAndHumble", Ours::shipped_localhost, User::humble, true},
    Case{"LocalhostAndJazzy", Ours::shipped_localhost, User::jazzy, true},
    Case{"LocalhostAndDefaults", Ours::shipped_localhost, User::defaults, false},
    Case{"NetworkAndDefaults", Ours::shipped_network, User::defaults, true},
    Case{"NetworkAndHumble", Ours::shipped_network, User::humble, true},
    Case{"NetworkAndJazzy", Ours::shipped_network, User::jazzy, true},
    // Why loopback alone is not what is chosen, nor the network's interface alone.
    Case{"LoopbackOnlyAndHumble", Ours::loopback_only, User::humble, true},
    Case{"LoopbackOnlyAndJazzy", Ours::loopback_only, User::jazzy, false},
    Case{"LoopbackOnlyAndDefaults", Ours::loopback_only, User::defaults, false},
    Case{"AutomaticOnlyAndHumble", Ours::automatic_only, User::humble, false},
    Case{"AutomaticOnlyAndJazzy", Ours::automatic_only, User::jazzy, true},
    Case{"AutomaticOnlyAndDefaults", Ours::automatic_only, User::defaults, false},
    Case{"AutomaticBoundAndJazzy", Ours::automatic_bound, User::jazzy, false},
};

class Ros2Meets : public TwoComputers, public testing::TestWithParam<Case> {
 protected:
  OurSide ours_{GetParam().ours};
};

TEST_P(Ros2Meets, WhomTheTableSays) {
  const auto& kind = meeting_topic();
  const dds_entity_t domain =
      dds_create_domain(kMeetingDomain, settings_of(GetParam().user).c_str());
  ASSERT_GT(domain, 0);
  const dds_entity_t participant = dds_create_participant(kMeetingDomain, nullptr, nullptr);
  const dds_entity_t topic = dds_create_topic(participant, kind.type, kind.name, nullptr, nullptr);
  const dds_entity_t reader = dds_create_reader(participant, topic, nullptr, nullptr);
  ASSERT_GT(reader, 0);
  const Time begin = runtime::monotonic_now();
  const Time until = begin + (GetParam().meet ? Duration(kMeetsWithin) : Duration(kWouldHaveMet));
  bool met = false;
  while (!met && runtime::monotonic_now() < until) {
    std::this_thread::sleep_for(20ms);
    void* sample = nullptr;
    dds_sample_info_t info{};
    if (dds_take(reader, &sample, &info, 1, 1) == 1) {
      met = info.valid_data;
      dds_return_loan(reader, &sample, 1);
    }
  }
  EXPECT_EQ(met, GetParam().meet);
  EXPECT_TRUE(ours_.alive());
  if (met)
    std::cout << "after " << std::chrono::duration<double>(runtime::monotonic_now() - begin).count()
              << " s\n";
  dds_delete(domain);
}

INSTANTIATE_TEST_SUITE_P(, Ros2Meets, testing::ValuesIn(kCases),
                         [](const auto& one) { return one.param.name; });

}  // namespace
}  // namespace drover::test
