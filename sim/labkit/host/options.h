// What one lab run was asked to do; sim/lab fills it, every part of the supervisor reads it.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace drover::lab {

struct Options {
  std::string base_dir;  // holds one folder per running lab
  std::string kernel;    // the User-Mode Linux executable
  std::string init;      // the script that runs as process 1 inside
  std::string can = "vcan";
  std::string logs_dir;  // empty: logs stay inside and are lost
  std::string memory = "512M";
  std::uint64_t seed = 1;
  double timeout_s = 0.0;  // wall clock, 0 = none
  int cpu = -1;            // host CPU, -1 = choose one no other lab uses
  int host_port = -1;      // -1 = no wire to the host, 0 = choose a free port
  int second_port = -1;    // with host_port: -1 = none, 0 = choose a free one
  bool real_time = false;
  bool interactive = false;
  bool shell = false;
  std::vector<std::string> environment;  // NAME=VALUE, the whole environment of the command
  std::vector<std::string> command;
};

}  // namespace drover::lab
