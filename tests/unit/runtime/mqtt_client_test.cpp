#include "runtime/mqtt_client.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace drover::runtime {
namespace {

using std::chrono::seconds;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

/// A broker that is not there, and a folder for the password.
struct MqttClientWithAPassword : testing::Test {
  std::filesystem::path folder =
      std::filesystem::temp_directory_path() / ("drover-mqtt-" + std::to_string(::getpid()));
  config::MqttConfig config;
  std::vector<std::string> said;

  MqttClientWithAPassword() {
    std::filesystem::create_directory(folder);
    config.host = folder / "no-broker.sock";
    config.port = 0;
    config.username = "droverd";
    config.password_file = folder / "password";
  }
  ~MqttClientWithAPassword() override { std::filesystem::remove_all(folder); }

  MqttClient client() {
    return MqttClient(
        config, {}, [](const MqttMessage&) {},
        [this](bool, const std::string& text) { said.push_back(text); });
  }
};

TEST_F(MqttClientWithAPassword, StartsWithoutThePasswordFileAndSaysOnceThatTheBrokerWaitsForIt) {
  auto without = client();
  for (int s = 1; s < 10; ++s) without.tick(Time{seconds(s)});
  EXPECT_THAT(said, ElementsAre(AllOf(HasSubstr("no-broker.sock"), HasSubstr("password_file"),
                                      HasSubstr("cannot read " + config.password_file),
                                      HasSubstr("No such file or directory"))));
  EXPECT_EQ(without.connections(), 0u);  // nobody is asked without it
}

TEST_F(MqttClientWithAPassword, TriesTheBrokerAsSoonAsThePasswordFileIsThere) {
  auto without = client();
  without.tick(Time{seconds(1)});
  std::ofstream(config.password_file) << "secret\n";
  without.tick(Time{seconds(10)});
  EXPECT_EQ(without.connections(), 1u);
  ASSERT_EQ(said.size(), 2u);
  EXPECT_THAT(said[1], AllOf(HasSubstr("no-broker.sock"), Not(HasSubstr("password_file"))));
}

TEST_F(MqttClientWithAPassword, TakesAnEmptyPasswordFileAsMissing) {
  std::ofstream(config.password_file).flush();
  auto without = client();
  without.tick(Time{seconds(1)});
  EXPECT_THAT(said,
              ElementsAre(HasSubstr("mqtt.password_file: " + config.password_file + " is empty")));
}

TEST_F(MqttClientWithAPassword, SaysThatAFolderIsNoPasswordFile) {
  std::filesystem::create_directory(config.password_file);
  auto without = client();
  without.tick(Time{seconds(1)});
  EXPECT_THAT(said, ElementsAre(HasSubstr("password is a folder")));
}

TEST_F(MqttClientWithAPassword, WarnsOnceOfAPasswordThatEverybodyMayRead) {
  std::ofstream(config.password_file) << "secret\n";
  const auto warned = [this](std::filesystem::perms mode) {
    std::filesystem::permissions(config.password_file, mode);
    auto with = client();
    testing::internal::CaptureStderr();
    for (int s = 1; s < 10; ++s) with.tick(Time{seconds(s)});
    return testing::internal::GetCapturedStderr();
  };
  const auto told = warned(std::filesystem::perms{0644});
  EXPECT_THAT(told, HasSubstr("mqtt.password_file: everybody on this computer may read " +
                              config.password_file));
  EXPECT_EQ(std::count(told.begin(), told.end(), '\n'), 1) << told;
  EXPECT_THAT(warned(std::filesystem::perms{0640}), Not(HasSubstr("password_file")));
}

}  // namespace
}  // namespace drover::runtime
