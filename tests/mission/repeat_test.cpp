// Equal seeds give equal bytes; other seeds give others.
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <sstream>
#include <string>

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

TEST(Repeat, TheSameSeedGivesTheSameFramesAndMessagesToTheByte) {
  for (const std::string mission : {"straight_and_uturn", "kill_on_ramp"}) {
    for (const char* log : {"can.log", "mqtt.log"})
      EXPECT_TRUE(bytes(mission, log) == bytes(mission + ".again", log)) << mission << ": " << log;
  }
}

/// `log` without the times of what is said at once when a connection stands: until then the threads
/// of droverd begin in an order of their own, and read the clock a few times more or less.
std::string without_first_moments(const std::string& log) {
  std::istringstream lines(log);
  std::string text;
  for (std::string line; std::getline(lines, line); text += line + '\n') {
    const auto said = line.find(") drover/online");
    if (said != std::string::npos) line.erase(0, said);
  }
  return text;
}

/// When a compiler has put checks in, or left an optimisation out.
TEST(Repeat, OtherBuildsOfTheSameProgramsSendTheSame) {
  for (const std::string mission : {"straight_and_uturn", "kill_on_ramp"}) {
    EXPECT_TRUE(bytes(mission, "can.log") == bytes(mission + ".other", "can.log")) << mission;
    EXPECT_TRUE(without_first_moments(bytes(mission, "mqtt.log")) ==
                without_first_moments(bytes(mission + ".other", "mqtt.log")))
        << mission;
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
