// No drive of the registry is left out of the suites of the mode that it states.
#include <gtest/gtest.h>

#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "drover/registry.h"

namespace drover::test {
namespace {

std::vector<std::string> suites_of(ChannelMode mode) {
  switch (mode) {
    case ChannelMode::velocity: return {"Registry/CanConformance", "Registry/CanVelocity"};
    case ChannelMode::impedance: return {"Registry/CanConformance", "Registry/Impedances"};
    case ChannelMode::twist: return {"Registry/TwistConformance"};
  }
  return {"of no such mode"};
}

/// What is registered, whether it is played in this run or not.
bool is_in_suite(std::string_view name, const DriverEntry& entry) {
  const auto& all = *testing::UnitTest::GetInstance();
  for (int i = 0; i < all.total_test_suite_count(); ++i) {
    const auto& suite = *all.GetTestSuite(i);
    if (suite.name() != name) continue;
    for (int j = 0; j < suite.total_test_count(); ++j)
      if (std::string(suite.GetTestInfo(j)->name()).ends_with("/" + std::string(entry.name)))
        return true;
  }
  return false;
}

TEST(Conformance, IsAskedOfEachDriveByEachModeThatItStates) {
  std::set<ChannelMode> seen;
  for (const DriverEntry& entry : driver_registry()) {
    for (const Channel& channel : entry.channels) {
      seen.insert(channel.mode);
      for (const auto& suite : suites_of(channel.mode))
        EXPECT_TRUE(is_in_suite(suite, entry)) << entry.name << " is not in " << suite;
    }
  }
  EXPECT_EQ(seen.size(), 3u) << "each mode has a drive";
}

/// A suite takes a device by its first channel.
TEST(Conformance, IsOfDevicesWhoseChannelsAreOfOneMode) {
  for (const DriverEntry& entry : driver_registry())
    for (const Channel& channel : entry.channels)
      EXPECT_EQ(channel.mode, entry.channels[0].mode) << entry.name;
}

TEST(Conformance, KnowsEachThatMovesSomething) {
  for (const DriverEntry& entry : driver_registry())
    EXPECT_EQ(entry.kind == SlotKind::drive, !entry.channels.empty()) << entry.name;
}

}  // namespace
}  // namespace drover::test
