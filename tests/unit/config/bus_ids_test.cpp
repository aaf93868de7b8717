// Devices of one CAN bus that would take each other's frames for their own.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <string>
#include <utility>

#include "unit/config/config_text.h"

namespace drover::config {
namespace {

using testing::AnyOf;
using testing::HasSubstr;
using testing::Not;

const std::string kExamples = DROVER_SOURCE_DIR "/config/examples";

/// Of the joint that a device "lift" moves.
const std::string kLift = R"("arm": {"joints": {"lift": {"min_rad": -1, "max_rad": 1,
  "max_velocity_radps": 1, "max_effort_Nm": 1}}}, )";

/// The example `name` with `more` devices before its others. The group is refused when it has no
/// device, which is another matter.
std::string example_with(const std::string& name, const std::string& more) {
  std::ifstream file(kExamples + "/" + name);
  std::string text{std::istreambuf_iterator<char>(file), {}};
  const auto put = [&text](const std::string& behind, const std::string& what) {
    const auto at = text.find(behind);
    ASSERT_NE(at, std::string::npos);
    text.insert(at + behind.size(), what);
  };
  put("\"devices\": {", more + ", ");
  put("\"imu\": {\"driver\": \"witmotion\",", " \"role\": \"steers\",");
  put("\"groups\": {", kLift);
  if (more.find("can9") != std::string::npos)
    put("\"links\": {", "\"can9\": {\"can\": \"can9\"}, ");
  return text;
}

/// A robot on a ZLAC8015D, node 1, on can0.
std::string hubs_with(const std::string& more) {
  return problems(example_with("two_hub_motors.json", more), kExamples);
}

std::string imu(const std::string& link, const std::string& frames, int node) {
  return R"("tilt": {"driver": "hipnuc_can", "link": ")" + link +
         R"(", "role": "told", "options": {"frames": ")" + frames + R"(", "node": )" +
         std::to_string(node) + "}}";
}

TEST(BusIds, AreRefusedToTwoDriversOfOneNode) {
  EXPECT_THAT(hubs_with(imu("can0", "canopen", 1)),
              HasSubstr("devices.wheels.options.node: devices.wheels (zlac8015d) and devices.tilt "
                        "(hipnuc_can) both use the id 0x181 on \"can0\""));
}

TEST(BusIds, AreFreeOnABusOfTheirOwnOfAnotherNodeAndOf29Bits) {
  for (const auto& free :
       {imu("can9", "canopen", 1), imu("can0", "canopen", 2), imu("can0", "j1939", 1)})
    EXPECT_THAT(hubs_with(free), Not(AnyOf(HasSubstr("both use"), HasSubstr("devices.")))) << free;
}

std::string motor(const std::string& name, int id, int master_id) {
  return "\"" + name +
         R"(": {"driver": "damiao", "link": "can0", "accept": ["no_watchdog"], "options": )"
         R"({"model": "DM4310", "id": )" +
         std::to_string(id) + ", \"master_id\": " + std::to_string(master_id) + "}}";
}

TEST(BusIds, AreRefusedToAnAnswerUnderAnothersCommand) {
  EXPECT_THAT(hubs_with(motor("lift", 3, 0x181)), HasSubstr("both use the id 0x181 on \"can0\""));
  EXPECT_THAT(hubs_with(motor("lift", 3, 0x201)), HasSubstr("both use the id 0x201 on \"can0\""));
}

TEST(BusIds, OfAFamilyAreShared) {
  const auto told = hubs_with(motor("lift", 3, 0x13) + ", " + motor("turn", 4, 0x14));
  EXPECT_THAT(told, Not(HasSubstr("both use the id")));
}

/// Two nodes of CiA 402, 1 and 2, of which the second one is to hear the heartbeat of `gateway`.
std::string nodes_with(int gateway, const std::string& more = "") {
  std::ifstream file(kExamples + "/cia402.json");
  std::string text{std::istreambuf_iterator<char>(file), {}};
  const std::string devices = "\"devices\": {";
  text.insert(text.find(devices) + devices.size(), more);
  const std::string witmotion = "\"driver\": \"witmotion\",";
  text.insert(text.find(witmotion) + witmotion.size(), " \"role\": \"steers\",");
  const std::string second = "\"node\": 2,";
  text.insert(text.find(second) + second.size(),
              " \"gateway_node\": " + std::to_string(gateway) + ",");
  return problems(text, kExamples);
}

/// Else the heartbeat of the one feeds the other, which runs on when nobody tells it to any more.
TEST(BusIds, AreRefusedToAGatewaysHeartbeatThatIsANodes) {
  EXPECT_THAT(nodes_with(126), Not(HasSubstr("both use")));
  EXPECT_THAT(nodes_with(1),
              HasSubstr("devices.right_drive.options.gateway_node: devices.right_drive (cia402) "
                        "and devices.left_drive (cia402) both use the id 0x701 on \"can0\""));
  // Of a sensor, too; and whichever of them comes first.
  EXPECT_THAT(nodes_with(8, imu("can0", "canopen", 8) + ", "),
              HasSubstr("both use the id 0x708 on \"can0\""));
  const auto lift = R"("lift": {"driver": "cia402", "link": "can0", "options": {"node": 5,)"
                    R"( "velocity_units_per_rps": 60, "gear_ratio": 9, "gateway_node": 1,)"
                    R"( "acceleration": 0, "deceleration": 0}})";
  EXPECT_THAT(hubs_with(lift), HasSubstr("both use the id 0x701 on \"can0\""));
}

TEST(BusIds, AreNotTakenByANodeThatIsNoneOfCanOpens) {
  const std::string axis =
      R"("lift": {"driver": "odrive", "link": "can0", "accept": ["no_watchdog"], "options": )"
      R"({"node": )";
  EXPECT_THAT(hubs_with(axis + "0}}"), Not(HasSubstr("both use the id")));
  EXPECT_THAT(hubs_with(axis + "4}}"), HasSubstr("both use the id 0x081 on \"can0\""));
}

std::string controllers(const std::string& link, const std::string& motors) {
  return R"("rollers": {"driver": "robomaster_c620", "link": ")" + link +
         R"(", "options": {"motors": ")" + motors +
         R"(", "velocity_gain_Nms_per_rad": 0.3}, "joints": {"a": {"channel": ")" + motors[0] +
         R"("}}})";
}

std::string motor_on(const std::string& link, int id, const std::string& more = "") {
  return R"("lift": {"driver": "damiao", "link": ")" + link +
         R"(", "options": {"model": "DM4310", "id": )" + std::to_string(id) + more + "}}";
}

/// As hubs_with(), of warnings; `word` is accepted.
std::string warned_hubs_with(const std::string& more, const std::string& word = "no_relay") {
  auto text = example_with("two_hub_motors.json", more);
  text.insert(text.find('{') + 1, "\"accept\": [\"" + word + "\"], ");
  std::string all;
  for (const auto& warning : load_text(text, kExamples).warnings) all += warning.text("f") + "\n";
  return all;
}

TEST(BusIds, AreRefusedToAMotorThatAnswersAsAControllerDoesOrIsToldAsOne) {
  const auto told = [](int master_id) {
    return problems(
        example_with("robomaster.json",
                     motor_on("can0", 9, R"(, "master_id": )" + std::to_string(master_id))),
        kExamples);
  };
  for (const auto& [id, hex] : {std::pair{0x203, "0x203"}, {0x200, "0x200"}})
    EXPECT_THAT(told(id), (HasSubstr("devices.wheels (robomaster_c620) and devices.lift "
                                     "(damiao) both use the id " +
                                     std::string(hex) + " on \"can0\"")));
  EXPECT_THAT(told(0x205), Not(HasSubstr("both use")));
}

TEST(BusIds, OfAMotorThatIsNotInMitModeAreToldWhenAControllerAnswersUnderThem) {
  const auto told = warned_hubs_with(controllers("can9", "1-4") + ", " + motor_on("can9", 3));
  EXPECT_THAT(told, HasSubstr("devices.lift.options.id: devices.lift (damiao) and devices.rollers "
                              "(robomaster_c620) share the id 0x203 on \"can9\""));
  const auto shares = HasSubstr("share the id");
  const auto first_four = controllers("can9", "1-4") + ", ";
  EXPECT_THAT(warned_hubs_with(first_four + motor_on("can9", 3), "mixed_bus"), Not(shares));
  EXPECT_THAT(warned_hubs_with(first_four + motor_on("can9", 5)), Not(shares));
  EXPECT_THAT(warned_hubs_with(first_four + motor_on("can0", 3)), Not(shares));
  const auto last_four = controllers("can9", "5-8") + ", ";
  EXPECT_THAT(warned_hubs_with(last_four + motor_on("can9", 3)), Not(shares));
  EXPECT_THAT(warned_hubs_with(last_four + motor_on("can9", 5)),
              HasSubstr("share the id 0x205 on \"can9\""));
}

TEST(Buses, HaveOneBitRate) {
  const auto scout = R"("scout": {"driver": "agilex_v2", "link": ")";
  const auto on = [&](const std::string& link) { return scout + link + "\"}, "; };
  EXPECT_THAT(warned_hubs_with(on("can9") + motor_on("can9", 3)),
              HasSubstr("devices.lift.link: devices.lift (damiao) speaks at 1000 kbit/s, and "
                        "devices.scout (agilex_v2) on \"can9\" at 500 kbit/s"));
  const auto differs = HasSubstr("a bus has one bit rate");
  EXPECT_THAT(warned_hubs_with(on("can9") + motor_on("can9", 3), "mixed_bus"), Not(differs));
  EXPECT_THAT(warned_hubs_with(on("can0") + motor_on("can9", 3)), Not(differs));
  EXPECT_THAT(warned_hubs_with(controllers("can9", "1-4") + ", " + motor_on("can9", 6)),
              Not(differs));
}

}  // namespace
}  // namespace drover::config
