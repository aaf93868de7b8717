// What a device's driver, and what it is told, may be.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "config/checks.h"
#include "unit/config/config_text.h"

namespace drover::config {
namespace {

using testing::AllOf;
using testing::EndsWith;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

TEST(ConfigurationChecks, RefuseAChoiceThatDoesNotExist) {
  EXPECT_THAT(
      problems(with("\"driver\": \"odrive\", \"link\": \"can0\", \"options\": {\"node\": 2}",
                    "\"driver\": \"odriv\", \"link\": \"can0\", \"options\": {\"node\": 2}")),
      AllOf(
          StartsWith("f:6:25: devices.right.driver: \"odriv\" is not one of: odrive, gpio_line, "),
          EndsWith(" (did you mean \"odrive\"?)\n")));
  EXPECT_THAT(problems(with("\"node\": 2", "\"node\": 2, \"firmware\": \"0.5\"")),
              HasSubstr("devices.right.options.firmware: \"0.5\" is not one of: 0.6, 0.5.6"));
}

TEST(ConfigurationChecks, ListTheChoicesWhereSomethingElseThanATextStands) {
  EXPECT_EQ(
      problems(with("\"node\": 2", "\"node\": 2, \"firmware\": 3")),
      "f:6:86: devices.right.options.firmware: is an integer, but a text is expected (one of: "
      "0.6, 0.5.6)\n");
  EXPECT_EQ(problems(with("\"node\": 2", "\"node\": 2, \"firmware\": 0.6")),
            "f:6:86: devices.right.options.firmware: is a number, but a text is expected (write it "
            "in quotes)\n");
  EXPECT_THAT(problems(with("\"node\": 2", "\"node\": 2, \"firmware\": null")),
              HasSubstr("leave the key out for its default"));
  EXPECT_THAT(problems(with("\"skid_steer\"", "3")),
              HasSubstr("groups.base.kind: is an integer, but a text is expected (one of: "
                        "skid_steer, differential, "));
}

TEST(ConfigurationChecks, RefuseOptionsOfTheDriver) {
  EXPECT_EQ(problems(with("\"node\": 2", "\"node\": 2.5")),
            "f:6:71: devices.right.options.node: is a number, but a whole number is expected"
            " (write it without a fraction)\n");
  EXPECT_EQ(
      problems(with("\"node\": 2", "\"node\": 63")),
      "f:6:71: devices.right.options.node: is 63, but must be between 0 and 62 (node id of the "
      "axis on the bus, 0 to 62 (63 is the broadcast))\n")
      << "what it is says what was meant by the number";
  EXPECT_EQ(
      problems(with("\"node\": 2", "\"node\": 2, \"reversed\": 1")),
      "f:6:86: devices.right.options.reversed: is an integer, but true or false is expected\n");
  EXPECT_EQ(problems(with("{\"node\": 2}", "3")),
            "f:6:62: devices.right.options: is an integer, but an object is expected\n");
}

TEST(ConfigurationChecks, RefuseOptionsThatDoNotFitTogether) {
  EXPECT_EQ(
      problems(with("\"node\": 2", "\"node\": 2, \"watchdog_enable_endpoint\": 5")),
      "f:6:62: devices.right.options: watchdog_enable_endpoint and watchdog_timeout_endpoint are"
      " given together or not at all\n");
  EXPECT_THAT(problems(with("\"line\": \"a\"",
                            "\"line\": \"a\", \"options\": {\"active_debounce_s\": 0.1}")),
              HasSubstr("devices.estop.options: active_debounce_s must be 0"));
}

TEST(ConfigurationChecks, FillInTheDefaultsOfOptions) {
  const auto options = load_text(kGood).config.devices[0].options;
  EXPECT_EQ(options.text("firmware"), "0.6");
  EXPECT_EQ(options.number("gear_ratio"), 1);
  EXPECT_FALSE(options.flag("reversed"));
}

TEST(ConfigurationChecks, GiveTheReceiversDriverTheBaudRateOfThePort) {
  const auto text = with("115200", "57600");
  EXPECT_EQ(problems(text), "");
  EXPECT_EQ(load_text(text).config.devices[2].options.number("baud"), 57600);
  EXPECT_EQ(
      problems(with("\"link\": \"gnss\"", "\"link\": \"gnss\", \"options\": {\"baud\": 9600}")),
      "f:7:72: devices.gnss.options.baud: differs from links.gnss.baud"
      " (leave it out: it follows links.gnss.baud)\n");
}

TEST(ConfigurationChecks, SayThatABatteryHangsOnTheSamePortAsModbus) {
  EXPECT_THAT(problems(with(R"("panel": {"gpio": "chip0"}},
  "devices": {)",
                            R"("panel": {"gpio": "chip0"}, "bms": {"serial": "/dev/b"}},
  "devices": {"battery": {"driver": "modbus_bms", "link": "bms", "map": "daly_d2.json"},)")),
              HasSubstr("devices.battery.link: \"bms\" is a serial line, but modbus_bms hangs on a "
                        "Modbus line (links.bms: \"modbus\": \"/dev/b\" in place of \"serial\")"));
}

TEST(ConfigurationChecks, SayWhichDriverSpeaksWithAProductOrThatNoneDoes) {
  const auto told = [](const std::string& written) {
    return problems(with("\"driver\": \"nmea0183\"", "\"driver\": \"" + written + "\""));
  };
  for (const auto* const receiver : {"um982", "UM-980", "zed-f9p", "u-blox"})
    EXPECT_THAT(told(receiver), HasSubstr("(\"nmea0183\" speaks with it: GNSS receiver"))
        << receiver;
  EXPECT_THAT(told("daly"), HasSubstr("(\"modbus_bms\" speaks with it: battery management system "
                                      "over Modbus, by a register map)"));
  EXPECT_THAT(told("scout_mini"), HasSubstr("(\"agilex_v2\" speaks with it: AgileX Scout"));
  EXPECT_THAT(told("hunter"), HasSubstr("(\"agilex_hunter\" speaks with it: AgileX Hunter"));
  for (const auto* const motor : {"DM-J4340", "DM4310"})
    EXPECT_THAT(told(motor), HasSubstr("(\"damiao\" speaks with it")) << motor;
  for (const auto* const imu : {"hi12", "HI14", "ch104"})
    EXPECT_THAT(told(imu), HasSubstr("(\"hipnuc_can\" speaks with it")) << imu;
  EXPECT_THAT(told("c620"), HasSubstr("(\"robomaster_c620\" speaks with it"));
  EXPECT_THAT(told("wt901c"), HasSubstr("(\"witmotion\" speaks with it"));
  EXPECT_THAT(told("JK"), HasSubstr("(\"modbus_bms\" speaks with it"));
  EXPECT_THAT(told("dm"), HasSubstr("(\"damiao\" speaks with it"));
  EXPECT_THAT(told("admiral"), Not(HasSubstr("speaks with"))) << "a maker's two letters in a word";
  for (const auto* const contact : {"estop", "e-stop", "bumper", "button"})
    EXPECT_THAT(told(contact), HasSubstr("(\"gpio_line\" speaks with it")) << contact;
  for (const auto* const unknown : {"bunker", "VESC", "JBD", "hesai", "bno085", "MPU-6050"})
    EXPECT_THAT(told(unknown), HasSubstr("(no driver speaks with it)")) << unknown;
}

TEST(ConfigurationChecks, SayWhichBaseGoesSideways) {
  const auto told = [](const std::string& kind) {
    return problems(with("\"skid_steer\"", "\"" + kind + "\""));
  };
  EXPECT_THAT(told("omni"), HasSubstr("(\"mecanum\" goes sideways, on four wheels with rollers at "
                                      "45 degrees; other wheels that do are not driven)"));
  EXPECT_THAT(told("holonomic"), HasSubstr("(\"mecanum\" goes sideways"));
  EXPECT_THAT(told("mecanun"), HasSubstr("(did you mean \"mecanum\"?)"));
}

TEST(ConfigurationChecks, AskForOneReversedOfEachWheel) {
  const auto told = problems(with(
      "\"estop\": {", R"("rollers": {"driver": "robomaster_c620", "link": "can0", "options": {)"
                      R"("velocity_gain_Nms_per_rad": 0.3, "reversed": true}},
    "estop": {)"));
  EXPECT_THAT(told, HasSubstr("devices.rollers.options.reversed: is no known key (each motor has "
                              "its own: reversed_1, reversed_2, reversed_3, reversed_4)"));
}

/// Or one name would be two drivers'.
TEST(ConfigurationChecks, FindEachProductAtTheDriverThatNamesIt) {
  for (const auto& entry : driver_registry())
    for (const auto product : entry.products)
      EXPECT_EQ(find_by_product(product), find_driver(entry.name)) << product;
}

}  // namespace
}  // namespace drover::config
