// What a scenario is played with: its gateway's configuration, and a folder for its logs.
#include "sim/scenario/workplace.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <stdexcept>

#include "config/load.h"
#include "sim/robot/scenario.h"
#include "support/temp_folder.h"

namespace drover::sim {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::HasSubstr;
using testing::Not;

class AWorkplace : public ::testing::Test {
 protected:
  AWorkplace() {
    write("robots/it.json", json{{"world", "yard.xml"}, {"origin", json::object()}});
    write("robots/it.drover.json",
          json{{"devices", {{"battery", {{"driver", "modbus_bms"}, {"map", "mine.json"}}}}}});
    write("robots/mine.json", json::object());
    write("robots/other.json", json::object());
    scenario_ = {{"robot", "../robots/it.json"}};
  }
  void write(const std::string& name, const json& document) {
    fs::create_directories((fs::path(folder_.path()) / name).parent_path());
    std::ofstream(folder_.path() + "/" + name) << document.dump(1);
  }
  Workplace made() {
    write("scenarios/it.json", scenario_);
    WorkplaceSettings settings;
    settings.scenario_file = folder_.path() + "/scenarios/it.json";
    settings.log_folder = log_;
    settings.native = true;
    return Workplace(settings);
  }
  json gateway() const { return json::parse(std::ifstream(log_ + "/drover.json")); }
  std::string in_robots(const std::string& name) const {
    return fs::weakly_canonical(folder_.path() + "/robots/" + name).string();
  }

  test::TempFolder folder_;
  std::string log_ = folder_.path() + "/log";
  json scenario_;
};

TEST_F(AWorkplace, LooksForAnotherMapOfTheGatewayBesideTheRobotsFile) {
  (void)made();
  EXPECT_EQ(gateway()["devices"]["battery"]["map"], in_robots("mine.json"));
  scenario_["gateway"]["devices"]["battery"]["map"] = "other.json";
  (void)made();
  EXPECT_EQ(gateway()["devices"]["battery"]["map"], in_robots("other.json"));
  scenario_["gateway"]["devices"]["battery"]["map"] = "third.json";
  try {
    (void)made();
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), HasSubstr("it.json: gateway.devices.battery.map: "));
    EXPECT_THAT(error.what(), Not(HasSubstr("drover-scenario-")));
  }
}

/// On a chip a line may have a number. The simulator's files have names.
TEST_F(AWorkplace, FindsALineByItsNameWhereLinesAreFiles) {
  scenario_["gateway"] = json::parse(R"({"links": {"panel": {"gpio": "drover-sim"}}})");
  write("robots/it.drover.json", json::parse(R"({"devices": {
    "button": {"driver": "gpio_line", "link": "panel", "line": "0", "is": "estop"}}})"));
  (void)made();
  EXPECT_EQ(gateway()["devices"]["button"]["line"], "estop");
}

TEST_F(AWorkplace, FindsABusByItsInterfaceWhateverItsLinkIsCalled) {
  scenario_["gateway"] = json::parse(R"({"links": {"base_can": {"can": "can1"}}})");
  (void)made();
  const std::string socket = gateway()["links"]["base_can"]["can"];
  EXPECT_TRUE(socket.starts_with("unix:") && socket.ends_with("/sim/can1.sock")) << socket;
}

TEST_F(AWorkplace, BeginsItsLogsAnew) {
  fs::create_directories(log_);
  for (const char* name :
       {"droverd.log", "drover.log", "objects.log", "droverd.rec", "droverd.rec.1", "mine.log"})
    std::ofstream(log_ + "/" + name) << "of an earlier run\n";
  (void)made();
  for (const char* name :
       {"droverd.log", "drover.log", "objects.log", "droverd.rec", "droverd.rec.1"})
    EXPECT_FALSE(fs::exists(log_ + "/" + name)) << name;
  EXPECT_TRUE(fs::exists(log_ + "/mine.log")) << "what it does not write is not its own";
}

TEST_F(AWorkplace, NamesTheFilesThatAPersonWrote) {
  const auto place = made();
  const auto command = place.private_file("scenario.json");
  EXPECT_EQ(place.as_written(command + ": drives[0].joint: is missing"),
            folder_.path() + "/scenarios/it.json: drives[0].joint: is missing");
  EXPECT_EQ(place.as_written("x " + place.private_file("drover.json") + ":12:5: no such key"),
            "x " + in_robots("it.drover.json") + ": no such key");
  EXPECT_EQ(place.as_written("can0: down"), "can0: down");
}

/// In real time ages are wider, the guard's too: what no longer fits together then refuses to
/// start.
TEST(AShippedScenario, IsGoodAsItIsPlayedInRealTime) {
  std::size_t played = 0;
  for (const auto& entry : fs::directory_iterator(DROVER_SOURCE_DIR "/sim/scenarios")) {
    const auto file = entry.path().string();
    if (entry.path().extension() != ".json") continue;
    if (file.ends_with("/receiver_renamed.json")) continue;  // a USB device needs the lab
    test::TempFolder logs;
    WorkplaceSettings settings;
    settings.scenario_file = file;
    settings.log_folder = logs.path();
    settings.native = true;
    const Workplace place(settings);
    const auto loaded = config::load_file(place.private_file("drover.json"));
    for (const auto& problem : loaded.problems) ADD_FAILURE() << file << ": " << problem.text("f");
    EXPECT_NO_THROW((void)load_scenario(place.private_file("scenario.json"))) << file;
    ++played;
  }
  EXPECT_GT(played, 100u);
}

/// The time-out of a CubeMars motor is nobody's but its own: the twin has the same.
TEST(AShippedScenario, GivesTheMotorsOfAnArmTheTimeThatItsGuardHas) {
  test::TempFolder logs;
  WorkplaceSettings settings;
  settings.scenario_file = DROVER_SOURCE_DIR "/sim/scenarios/cubemars_arm.json";
  settings.log_folder = logs.path();
  settings.native = true;
  const Workplace place(settings);
  const auto config = json::parse(std::ifstream(place.private_file("drover.json")));
  EXPECT_EQ(config["devices"]["elbow"]["options"]["timeout_ms"], 2000);
  const auto drives = place.document()["drives"];
  EXPECT_TRUE(std::any_of(drives.begin(), drives.end(), [](const auto& drive) {
    return drive.value("joint", "") == "elbow" && drive["options"]["timeout_ms"] == 2000;
  }));
}

}  // namespace
}  // namespace drover::sim
