// The table in src/publish/README.md of what each drive follows is the registry's.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <string>
#include <vector>

#include "drover/registry.h"

namespace drover {
namespace {

std::string row_of(const DriverEntry& entry) {
  const auto of_mode = [](ChannelMode mode) -> std::string {
    switch (mode) {
      case ChannelMode::velocity:
        return "`velocity` | no effect | followed | must be 0 | must be 0 | no effect |";
      case ChannelMode::twist:
        return "`twist` | no joints | no joints | no joints | no joints | no joints |";
      case ChannelMode::impedance:
        return "`impedance` | by `follows` | by `follows` | by `follows` | by `follows` | by "
               "`follows` |";
    }
    return "?";
  };
  return "| `" + std::string(entry.name) + "` | " + of_mode(entry.channels[0].mode);
}

std::vector<std::string> rows_of_readme() {
  std::ifstream file(DROVER_SOURCE_DIR "/src/publish/README.md");
  std::vector<std::string> rows;
  bool inside = false;
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with("| driver | mode |")) {
      inside = std::getline(file, line).good();  // what is below the heads
    } else if (inside && !line.starts_with("|")) {
      break;
    } else if (inside) {
      rows.push_back(line);
    }
  }
  return rows;
}

TEST(FollowedValues, OfTheReadmeAreThoseOfTheRegistry) {
  std::vector<std::string> rows;
  for (const DriverEntry& entry : driver_registry())
    if (!entry.channels.empty()) rows.push_back(row_of(entry));
  EXPECT_THAT(rows_of_readme(), testing::UnorderedElementsAreArray(rows));
}

}  // namespace
}  // namespace drover
