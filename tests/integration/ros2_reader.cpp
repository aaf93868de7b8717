// A ROS 2 user's program that only reads: every topic of drover-ros2, reliable, until it is ended.
// Usage: ros2_reader DOMAIN
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <vector>

#include "integration/ros2_user.h"

int main(int argc, char** argv) {
  using namespace drover;
  if (argc != 2) return 2;
  const auto domain = static_cast<dds_domainid_t>(std::atoi(argv[1]));
  if (dds_create_domain(domain, test::settings_of(test::User::humble).c_str()) < 0) return 1;
  const dds_entity_t participant = dds_create_participant(domain, nullptr, nullptr);
  std::vector<dds_entity_t> readers;
  for (const auto& kind : ros2::topic_kinds())
    readers.push_back(test::make_reader(participant, kind, DDS_RELIABILITY_RELIABLE));
  bool told = false;
  for (;;) {
    for (const dds_entity_t reader : readers) {
      void* sample = nullptr;
      dds_sample_info_t info{};
      while (dds_take(reader, &sample, &info, 1, 1) == 1) {
        dds_return_loan(reader, &sample, 1);
        if (!told) std::puts("it reads");
        if (!told) std::fflush(stdout);
        told = true;
      }
    }
    ::usleep(5000);
  }
}
