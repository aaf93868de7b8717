// A ROS 2 program on the host that hears /joint_states: ros2_hear COUNT. It is told by the
// environment, as ROS 2's own are: ROS_DOMAIN_ID, and ROS_LOCALHOST_ONLY or
// ROS_AUTOMATIC_DISCOVERY_RANGE. Exit status 0: so many came within thirty seconds.
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <string_view>
#include <thread>

#include "integration/ros2_user.h"

namespace {

using namespace std::chrono_literals;
using drover::test::User;

std::string_view told(const char* name) {
  const char* const value = std::getenv(name);
  return value == nullptr ? "" : value;
}

User user() {
  if (told("ROS_LOCALHOST_ONLY") == "1") return User::humble;
  return told("ROS_AUTOMATIC_DISCOVERY_RANGE") == "LOCALHOST" ? User::jazzy : User::defaults;
}

}  // namespace

int main(int argc, char** argv) {
  const int wanted = argc > 1 ? std::atoi(argv[1]) : 1;
  const auto domain = static_cast<dds_domainid_t>(std::atoi(told("ROS_DOMAIN_ID").data()));
  if (dds_create_domain(domain, drover::test::settings_of(user()).c_str()) < 0) return 2;
  const auto& kind =
      drover::ros2::topic_kinds()[static_cast<std::size_t>(drover::ros2::Topic::joint_states)];
  const dds_entity_t participant = dds_create_participant(domain, nullptr, nullptr);
  const dds_entity_t topic = dds_create_topic(participant, kind.type, kind.name, nullptr, nullptr);
  const dds_entity_t reader = dds_create_reader(participant, topic, nullptr, nullptr);
  if (reader < 0) return 2;
  const auto begin = std::chrono::steady_clock::now();
  int count = 0;
  while (count < wanted && std::chrono::steady_clock::now() < begin + 30s) {
    void* sample = nullptr;
    dds_sample_info_t info{};
    if (dds_take(reader, &sample, &info, 1, 1) != 1) {
      std::this_thread::sleep_for(1ms);
      continue;
    }
    if (info.valid_data && count++ == 0) {
      const auto& names = static_cast<const sensor_msgs_msg_dds__JointState_*>(sample)->name_;
      for (std::uint32_t i = 0; i < names._length; ++i) std::printf("%s ", names._buffer[i]);
      std::printf("first after %.2f s\n",
                  std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count());
    }
    dds_return_loan(reader, &sample, 1);
  }
  std::printf("%d of %d heard after %.2f s\n", count, wanted,
              std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count());
  dds_delete(DDS_CYCLONEDDS_HANDLE);
  return count < wanted ? 1 : 0;
}
