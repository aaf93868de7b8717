// The robots of the simulator, by the names of their files: a new one is in each test that asks.
#pragma once

#include <filesystem>
#include <set>
#include <string>
#include <vector>

namespace drover::test {

/// `ending`: ".json" is the simulator's file, ".drover.json" its gateway's configuration.
inline std::string robot_file(const std::string& robot, const std::string& ending) {
  return DROVER_SOURCE_DIR "/sim/robots/" + robot + ending;
}

inline std::vector<std::string> simulated_robots() {
  constexpr std::string_view kEnding = ".drover.json";
  std::set<std::string> names;
  for (const auto& file : std::filesystem::directory_iterator(DROVER_SOURCE_DIR "/sim/robots")) {
    const std::string name = file.path().filename();
    if (name.ends_with(kEnding)) names.insert(name.substr(0, name.size() - kEnding.size()));
  }
  return {names.begin(), names.end()};
}

}  // namespace drover::test
