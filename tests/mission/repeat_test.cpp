// Equal seeds give equal bytes; other seeds give others.
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>

#include "mission/record.h"

namespace drover::mission {
namespace {

std::string bytes(const std::string& run, const char* log) {
  const auto file = logs_folder() / run / log;
  std::ifstream stream(file, std::ios::binary);
  EXPECT_TRUE(stream) << file << " is missing";
  std::string text{std::istreambuf_iterator<char>(stream), {}};
  EXPECT_FALSE(text.empty()) << file;
  return text;
}

/// Also when a compiler has put checks in, or left an optimisation out.
TEST(Repeat, TheSameSeedGivesTheSameFramesAndMessagesToTheByte) {
  for (const std::string mission : {"straight_and_uturn", "kill_on_ramp"}) {
    for (const char* log : {"can.log", "mqtt.log"})
      EXPECT_TRUE(bytes(mission, log) == bytes(mission + ".again", log)) << mission << ": " << log;
  }
}

TEST(Repeat, AnotherSeedGivesAnotherMission) {
  EXPECT_FALSE(bytes("straight_and_uturn", "can.log") ==
               bytes("straight_and_uturn.seed", "can.log"));
  EXPECT_FALSE(bytes("straight_and_uturn", "mqtt.log") ==
               bytes("straight_and_uturn.seed", "mqtt.log"));
}

}  // namespace
}  // namespace drover::mission
