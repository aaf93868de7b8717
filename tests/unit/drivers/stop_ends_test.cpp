// The table in drivers/README.md of what holds after the guard's stop is what the drivers say.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <regex>
#include <string>
#include <vector>

#include "unit/drivers/conformance/harness.h"

namespace drover::test {
namespace {

using Names = std::map<std::string, std::vector<std::string>>;

Names by_the_drivers() {
  Names names;
  for (const DriverEntry& entry : driver_registry()) {
    if (!has_face(entry, &Made::actuator)) continue;
    const Made made = made_of(entry, example_options(entry));
    switch (made.actuator->stop_recipe().ends) {
      case StopEnds::holds: names["holds"].emplace_back(entry.name); break;
      case StopEnds::damps: names["damps"].emplace_back(entry.name); break;
      case StopEnds::coasts: names["coasts"].emplace_back(entry.name); break;
    }
  }
  return names;
}

Names by_the_readme() {
  static const std::regex kRow(R"(\| \*\*(holds|damps|coasts)\*\*.*\| (.*) \|)");
  static const std::regex kName("`([a-z0-9_]+)`");
  std::ifstream file(DROVER_SOURCE_DIR "/drivers/README.md");
  Names names;
  for (std::string line; std::getline(file, line);) {
    std::smatch row;
    if (!std::regex_match(line, row, kRow)) continue;
    const std::string cell = row[2];
    for (std::sregex_iterator it(cell.begin(), cell.end(), kName), end; it != end; ++it)
      names[row[1]].push_back(it->str(1));
  }
  return names;
}

TEST(StopEnds, OfTheReadmeAreThoseOfTheDrivers) {
  const Names said = by_the_readme();
  const Names are = by_the_drivers();
  EXPECT_EQ(are.size(), 3U);
  for (const auto& [ends, names] : are) {
    ASSERT_TRUE(said.contains(ends)) << ends;
    EXPECT_THAT(said.at(ends), testing::UnorderedElementsAreArray(names)) << ends;
  }
}

}  // namespace
}  // namespace drover::test
