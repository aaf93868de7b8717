// A ROS 2 program that looks for the robot and wants it stopped: it reads /diagnostics and says
// true on /e_stop, again and again. Usage: ros2_visit humble|jazzy|defaults SECONDS
// Exit status 0: it saw the robot in that time. Domain 0.
#include <chrono>
#include <cstdlib>
#include <string_view>
#include <thread>

#include "integration/ros2_user.h"

int main(int argc, char** argv) {
  using namespace drover;
  using namespace std::chrono_literals;
  if (argc != 3) return 2;
  const std::string_view told = argv[1];
  const auto user = told == "humble"  ? test::User::humble
                    : told == "jazzy" ? test::User::jazzy
                                      : test::User::defaults;
  if (dds_create_domain(0, test::settings_of(user).c_str()) < 0) return 2;
  const dds_entity_t participant = dds_create_participant(0, nullptr, nullptr);
  const auto& kind = ros2::topic_kinds()[static_cast<std::size_t>(ros2::Topic::diagnostics)];
  const dds_entity_t reader = test::make_reader(participant, kind, DDS_RELIABILITY_RELIABLE);
  const dds_entity_t writer =
      test::make_writer(participant, ros2::stop_kind(), DDS_RELIABILITY_RELIABLE);
  bool seen = false;
  const auto until = std::chrono::steady_clock::now() + std::chrono::seconds(std::atoi(argv[2]));
  // A little longer than it takes to see it: what it says is on its way.
  for (int rest = 20; rest > 0 && std::chrono::steady_clock::now() < until; rest -= seen ? 1 : 0) {
    const std_msgs_msg_dds__Bool_ stop{true};
    dds_write(writer, &stop);
    void* sample = nullptr;
    dds_sample_info_t info{};
    if (dds_take(reader, &sample, &info, 1, 1) == 1) {
      seen = seen || info.valid_data;
      dds_return_loan(reader, &sample, 1);
    }
    std::this_thread::sleep_for(50ms);
  }
  dds_delete(DDS_CYCLONEDDS_HANDLE);
  return seen ? 0 : 1;
}
