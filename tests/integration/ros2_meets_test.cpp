// Which ROS 2 programs on the robot's computer, which has a network, meet drover-ros2: its domain
// as it makes it, and what else could have been chosen, beside each way they may be told.
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>

#include <array>
#include <iostream>
#include <string>
#include <thread>

#include "integration/ros2_user.h"
#include "integration/two_computers.h"
#include "ros2/domain.h"
#include "ros2/networks.h"
#include "runtime/clock.h"

namespace drover::test {
namespace {

using namespace std::chrono_literals;

constexpr int kDomain = 42;  // nobody else is in this network
constexpr auto kMeetsWithin = 15s;
/// Those who meet do so in a tenth of it: each tells at once that he is there.
constexpr auto kWouldHaveMet = 2s;

/// How our side is made.
enum class Ours : std::uint8_t {
  shipped_localhost,
  shipped_network,
  loopback_only,
  automatic_only,
  automatic_bound,  ///< and its sockets to loopback
};

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
    // Why loopback alone is not what is chosen, nor the network's interface alone.
    Case{"LoopbackOnlyAndHumble", Ours::loopback_only, User::humble, true},
    Case{"LoopbackOnlyAndJazzy", Ours::loopback_only, User::jazzy, false},
    Case{"LoopbackOnlyAndDefaults", Ours::loopback_only, User::defaults, false},
    Case{"AutomaticOnlyAndHumble", Ours::automatic_only, User::humble, false},
    Case{"AutomaticOnlyAndJazzy", Ours::automatic_only, User::jazzy, true},
    Case{"AutomaticOnlyAndDefaults", Ours::automatic_only, User::defaults, false},
    Case{"AutomaticBoundAndJazzy", Ours::automatic_bound, User::jazzy, false},
};

std::string interface_settings(const char* which) {
  return std::string("<CycloneDDS><Domain id=\"any\"><General><Interfaces><NetworkInterface ") +
         which +
         "/></Interfaces><AllowMulticast>false</AllowMulticast></General><Discovery>"
         "<ParticipantIndex>auto</ParticipantIndex><MaxAutoParticipantIndex>32"
         "</MaxAutoParticipantIndex><Peers><Peer address=\"127.0.0.1\"/></Peers></Discovery>"
         "</Domain></CycloneDDS>";
}

/// Our participant, which lives as long as this process.
dds_entity_t make(Ours ours) {
  if (ours == Ours::shipped_localhost || ours == Ours::shipped_network) {
    const auto reach =
        ours == Ours::shipped_network ? ros2::Reach::network : ros2::Reach::localhost;
    static const ros2::Domain kShipped(kDomain, reach, !ros2::networks().empty());
    return kShipped.participant();
  }
  const auto settings =
      interface_settings(ours == Ours::loopback_only ? "name=\"lo\"" : "autodetermine=\"true\"");
  if (dds_create_domain(kDomain, settings.c_str()) < 0) throw std::runtime_error("no domain");
  const dds_entity_t participant = dds_create_participant(kDomain, nullptr, nullptr);
  if (ours == Ours::automatic_bound) (void)ros2::bind_to_loopback();
  return participant;
}

const ros2::TopicKind& odom() {
  return ros2::topic_kinds()[static_cast<std::size_t>(ros2::Topic::odom)];
}

/// Our side, in a process of its own that ends with the test.
void write_for_ever(Ours ours) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  const dds_entity_t writer = make_writer(make(ours), odom(), DDS_RELIABILITY_RELIABLE);
  for (;;) {
    nav_msgs_msg_dds__Odometry_ message{};
    dds_write(writer, &message);
    std::this_thread::sleep_for(50ms);
  }
}

class Ros2Meets : public TwoComputers, public testing::TestWithParam<Case> {
 protected:
  void SetUp() override {
    ours_ = ::fork();
    ASSERT_GE(ours_, 0);
    if (ours_ > 0) return;
    try {
      write_for_ever(GetParam().ours);
    } catch (const std::exception& error) {
      std::cerr << error.what() << "\n";
    }
    ::_exit(1);
  }
  void TearDown() override {
    ::kill(ours_, SIGKILL);
    ::waitpid(ours_, nullptr, 0);
  }
  bool is_ours_alive() const { return ::waitpid(ours_, nullptr, WNOHANG) == 0; }

 private:
  pid_t ours_ = -1;
};

TEST_P(Ros2Meets, WhomTheTableSays) {
  const auto& kind = odom();
  const dds_entity_t domain = dds_create_domain(kDomain, settings_of(GetParam().user).c_str());
  ASSERT_GT(domain, 0);
  const dds_entity_t participant = dds_create_participant(kDomain, nullptr, nullptr);
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
  EXPECT_TRUE(is_ours_alive());
  if (met)
    std::cout << "after " << std::chrono::duration<double>(runtime::monotonic_now() - begin).count()
              << " s\n";
  dds_delete(domain);
}

INSTANTIATE_TEST_SUITE_P(, Ros2Meets, testing::ValuesIn(kCases),
                         [](const auto& one) { return one.param.name; });

}  // namespace
}  // namespace drover::test
