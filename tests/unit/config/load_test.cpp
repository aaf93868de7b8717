#include "config/load.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "unit/config/config_text.h"

namespace drover::config {
namespace {

using testing::HasSubstr;

TEST(Configuration, TellsAKeyNobodyKnowsWithItsPlaceAndTheLikelyOne) {
  EXPECT_EQ(problems(with("max_speed_mps", "max_sped_mps")),
            "f:12:14: limits.max_sped_mps: is no known key (did you mean \"max_speed_mps\"?)\n");
  EXPECT_EQ(problems(with("\"limits\"", "\"limit\"")),
            "f:12:3: limit: is no known key (did you mean \"limits\"?)\n");
}

TEST(Configuration, PassesOverTheEditorsSchema) {
  std::string text(kGood);
  text.insert(text.find('{') + 1, R"("$schema": "drover.schema.json",)");
  EXPECT_TRUE(load_text(text).problems.empty());
}

TEST(Configuration, RecognisesAWrongOrForgottenUnit) {
  for (const auto* slip : {"max_speed_mmps", "max_speed", "max_speed_kmph", "max_speed_m_s"})
    EXPECT_THAT(problems(with("max_speed_mps", slip)), HasSubstr("did you mean \"max_speed_mps\""))
        << slip;
}

TEST(Suggestions, TakeAHeightForAZ) {
  const auto told = [](const char* key) {
    return problems(
        with("\"limits\"", "\"estimate\": {\"" + std::string(key) + "\": 0.5}, \"limits\""));
  };
  EXPECT_THAT(
      told("antenna_height_m"),
      HasSubstr("estimate.antenna_height_m: is no known key (did you mean \"antenna_z_m\"?)"));
  EXPECT_THAT(told("antenna_height"), HasSubstr("did you mean \"antenna_z_m\"?"));
  EXPECT_THAT(problems(with("\"limits\"", "\"scene\": {\"heigth_m\": 1}, \"limits\"")),
              HasSubstr("did you mean \"height_m\"?"));
}

TEST(Configuration, SuggestsNothingForAKeyThatResemblesNone) {
  EXPECT_EQ(problems(with("max_speed_mps", "zzzzzz")), "f:12:14: limits.zzzzzz: is no known key\n");
  EXPECT_EQ(problems(with("max_speed_mps", "")), "f:12:14: limits.: is no known key\n");
}

TEST(Configuration, RefusesAValueOfAnotherType) {
  EXPECT_EQ(problems(with("0.8", "\"0.8\"")),
            "f:12:31: limits.max_speed_mps: is a text, but a number is expected"
            " (write it without quotes)\n");
  EXPECT_EQ(problems(with("0.8", "\"fast\"")),
            "f:12:31: limits.max_speed_mps: is a text, but a number is expected\n");
  EXPECT_EQ(problems(with("0.8", "true")),
            "f:12:31: limits.max_speed_mps: is true or false, but a number is expected\n");
  EXPECT_EQ(problems(with("0.8", "null")),
            "f:12:31: limits.max_speed_mps: is null, but a number is expected"
            " (leave the key out for its default)\n");
  EXPECT_EQ(problems(with("1883", "1883.0")),
            "f:13:41: mqtt.port: is a number, but a whole number is expected"
            " (write it without a fraction)\n");
  EXPECT_EQ(problems(with("\"127.0.0.1\"", "127")),
            "f:13:20: mqtt.host: is an integer, but a text is expected (write it in quotes)\n");
  EXPECT_EQ(problems(with("{\"max_speed_mps\": 0.8}", "[0.8]")),
            "f:12:13: limits: is a list, but an object is expected\n");
  EXPECT_EQ(problems(with("[\"right\"]", "\"right\"")),
            "f:11:113: groups.base.right: is a text, but a list of texts is expected\n");
  EXPECT_THAT(problems(with("[\"right\"]", "[\"right\", 2]")),
              HasSubstr("groups.base.right: is an integer, but a list of texts is expected\n"));
  EXPECT_THAT(problems(with("\"panel\": {\"gpio\": \"chip0\"}", "\"panel\": \"chip0\"")),
              HasSubstr("f:3:78: links.panel: is a text, but an object is expected\n"));
  EXPECT_THAT(problems(with("{\"base\"", "[1], \"b\": {\"base\"")),
              HasSubstr("f:11:13: groups: is a list, but an object is expected\n"));
}

TEST(Configuration, SaysWhatAHexadecimalNumberIs) {
  const auto node = [](const std::string& written) {
    return problems(with("{\"node\": 2}", "{\"node\": " + written + "}"));
  };
  EXPECT_THAT(node("\"0x0b\""), HasSubstr("is a text, but a whole number is expected (write 11, "
                                          "without quotes)"));
  EXPECT_THAT(node("0x0b"), HasSubstr("there are no hexadecimal numbers: write 11"));
  EXPECT_THAT(node("\"0x\""), testing::EndsWith("but a whole number is expected\n"));
  EXPECT_THAT(node("\"0x0b kg\""), testing::EndsWith("but a whole number is expected\n"));
  EXPECT_THAT(problems(with("0.8", "\"0x8\"")), HasSubstr("(write 8, without quotes)"));
}

TEST(Configuration, KeepsTheOrderOfATable) {
  const auto config = load_text(kGood).config;
  ASSERT_EQ(config.links.size(), 3u);
  EXPECT_EQ(config.links[1].name, "gnss");
  ASSERT_EQ(config.devices.size(), 5u);
  EXPECT_EQ(config.devices[0].name, "left");
  EXPECT_EQ(config.devices[4].name, "bumper");
}

TEST(Configuration, RefusesAValueOutsideItsRange) {
  EXPECT_EQ(problems(with("0.8", "800")),
            "f:12:31: limits.max_speed_mps: is 800, but must be between 0.05 and 5 m/s\n");
  EXPECT_EQ(problems(with("0.8", "5.001")),
            "f:12:31: limits.max_speed_mps: is 5.001, but must be between 0.05 and 5 m/s\n");
  EXPECT_EQ(problems(with("0.8", "5")), "");
  EXPECT_EQ(problems(with("1883", "65536")),
            "f:13:41: mqtt.port: is 65536, but must be between 0 and 65535\n");
  EXPECT_NE(problems(with("1883", "4294969179")), "");  // would be 1883 in 32 bits
}

TEST(Configuration, TellsWhatIsMissingAndWhatItMeans) {
  EXPECT_EQ(problems(with("\"track_m\": 0.6, ", "")),
            "f:11:22: groups.base.track_m: is missing (between left and right wheels)\n");
  EXPECT_THAT(problems("{}"), HasSubstr("f:1:1: devices: is missing (devices, by name)\n"));
  EXPECT_THAT(problems("{}"), HasSubstr("f:1:1: links: is missing (ways to devices, by name)\n"));
  EXPECT_THAT(problems(with("{\"base\"", "{\"bsae\"")),
              HasSubstr("f:11:13: groups.base: is missing (the vehicle)\n"));
}

TEST(Configuration, RefusesAnEmptyNameWhereOneIsNeeded) {
  EXPECT_EQ(problems(with("\"chip0\"", "\"\"")),
            "f:3:87: links.panel.gpio: is empty (label or name of a GPIO chip, or "
            "files:DIRECTORY)\n");
  EXPECT_EQ(problems(with("\"line\": \"b\"", "\"line\": \"\"")),
            "f:9:64: devices.bumper.line: is empty\n");
}

TEST(Configuration, RefusesANulCharacterInAText) {
  EXPECT_EQ(problems(with("/dev/drover/gnss", "/dev/\\u0000gnss")),
            "f:3:32: links.gnss.serial: holds a NUL character\n");
}

TEST(Configuration, RefusesAKeyThatIsThereTwice) {
  EXPECT_EQ(problems(with("0.8}", "0.8, \"max_speed_mps\": 0.9}")),
            "f:12:36: limits.max_speed_mps: this key is there twice\n");
}

TEST(Configuration, RefusesWhatIsNoJsonAndTellsWhere) {
  EXPECT_THAT(problems(with("0.8}", "0.8,}")), HasSubstr("f:12:"));
  EXPECT_THAT(problems(""), HasSubstr("f:1:1: "));
  EXPECT_THAT(problems("{\n  \"robot\": \"a\"\n  \"paths\": {}\n}"), HasSubstr("f:3:"));
  EXPECT_EQ(problems("[]"), "f:1:1: an object is expected ({ ... })\n");
}

TEST(Configuration, RefusesTooManyOrTooFewEntries) {
  EXPECT_THAT(problems(with("[\"right\"]", "[]")),
              HasSubstr("groups.base.right: has 0 entries, but needs at least 1 entry\n"));
  std::string links;
  for (int i = 1; i < 9; ++i) {
    const auto name = "\"can" + std::to_string(i) + "\"";
    links += ", " + name + ": {\"can\": " + name + "}";
  }
  EXPECT_THAT(problems(with("{\"can\": \"can0\"}", "{\"can\": \"can0\"}" + links)),
              HasSubstr("links.can8: is one CAN bus too many: there may be 8\n"));
  for (int i = 0; i < 12; ++i) links += ", \"l" + std::to_string(i) + "\": {\"gpio\": \"x\"}";
  EXPECT_THAT(problems(with("{\"can\": \"can0\"}", "{\"can\": \"can0\"}" + links)),
              HasSubstr("f:2:12: links: has 23 entries, but may have at most 17 entries\n"));
}

TEST(Configuration, TellsAllProblemsAtOnceInTheOrderOfTheFile) {
  auto text = with("\"node\": 2", "\"nod\": 2");
  text.replace(text.find("0.165"), 5, "\"a\"");
  text.replace(text.find("115200"), 6, "1");
  text.replace(text.find("1883"), 4, "70000");
  EXPECT_EQ(problems(text),
            "f:3:60: links.gnss.baud: is 1, but a line has one of 4800, 9600, 19200, 38400, 57600, "
            "115200, 230400, 460800, 921600\n"
            "f:6:62: devices.right.options.node: is missing (node id of the axis on the bus, 0 to "
            "62 (63 is the broadcast))\n"
            "f:6:63: devices.right.options.nod: is no known key (did you mean \"node\"?)\n"
            "f:11:63: groups.base.wheel_radius_m: is a text, but a number is expected\n"
            "f:13:41: mqtt.port: is 70000, but must be between 0 and 65535\n");
}

TEST(Configuration, DoesNotLetAForeignKeyForgeALine) {
  const auto text = problems(with("max_speed_mps", "a\\ngood"));
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 1) << text;
}

TEST(Configuration, TellsWhyAFileCannotBeRead) {
  const auto missing = load_file("no/such/file.json");
  ASSERT_EQ(missing.problems.size(), 1u);
  EXPECT_EQ(missing.problems[0].text("no/such/file.json"),
            "no/such/file.json: cannot be read: No such file or directory");
  const auto folder = load_file(DROVER_SOURCE_DIR);
  ASSERT_EQ(folder.problems.size(), 1u);
  EXPECT_EQ(folder.problems[0].message, "cannot be read: Is a directory");
}

TEST(Configuration, RefusesAFileWithoutAnEnd) {
  const auto endless = load_file("/dev/zero");
  ASSERT_EQ(endless.problems.size(), 1u);
}

TEST(Configuration, IgnoresComments) {
  EXPECT_EQ(problems(with("\"limits\"", "// slow\n /* here */ \"limits\"")), "");
}

TEST(Configuration, KeepsTheDefaultOfAKeyThatIsNotThere) {
  const auto loaded = load_text(kGood);
  ASSERT_TRUE(loaded.problems.empty());
  const engine::EngineConfig defaults;
  EXPECT_EQ(loaded.config.engine.limits.acceleration_mps2, defaults.limits.acceleration_mps2);
  EXPECT_EQ(loaded.config.control.tick_Hz, 200);
  EXPECT_TRUE(loaded.config.guard.required);
  EXPECT_EQ(loaded.config.mqtt.client_id, "");
}

TEST(Configuration, GivesEveryPartWhatWasWritten) {
  const auto loaded = load_text(with("0.8", "0.7"));
  ASSERT_TRUE(loaded.problems.empty());
  const auto& c = loaded.config;
  EXPECT_EQ(c.engine.limits.max_speed_mps, 0.7);
  EXPECT_EQ(c.engine.base.wheel_radius_m, 0.165);
  EXPECT_EQ(c.devices[1].name, "right");
  EXPECT_EQ(c.devices[1].options.number("node"), 2);
  EXPECT_EQ(c.links[1].serial, "/dev/drover/gnss");
  EXPECT_EQ(c.links[1].baud, 115200);
  EXPECT_EQ(c.devices[4].line, "b");
  EXPECT_EQ(line_of(c.devices[4]), Line::bumper);
  EXPECT_EQ(c.mqtt.port, 1883);
}

}  // namespace
}  // namespace drover::config
