#include "config/load.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "unit/config/config_text.h"

namespace drover::config {
namespace {

using testing::HasSubstr;

TEST(Configuration, TellsAKeyNobodyKnowsWithItsPlaceAndTheLikelyOne) {
  EXPECT_EQ(problems(with("max_speed_mps", "max_sped_mps")),
            "f:8:14: limits.max_sped_mps: is no known key (did you mean \"max_speed_mps\"?)\n");
  EXPECT_EQ(problems(with("\"limits\"", "\"limit\"")),
            "f:8:3: limit: is no known key (did you mean \"limits\"?)\n");
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

TEST(Configuration, SuggestsNothingForAKeyThatResemblesNone) {
  EXPECT_EQ(problems(with("max_speed_mps", "zzzzzz")), "f:8:14: limits.zzzzzz: is no known key\n");
  EXPECT_EQ(problems(with("max_speed_mps", "")), "f:8:14: limits.: is no known key\n");
}

TEST(Configuration, RefusesAValueOfAnotherType) {
  EXPECT_EQ(problems(with("0.8", "\"0.8\"")),
            "f:8:31: limits.max_speed_mps: is a text, but a number is expected"
            " (write it without quotes)\n");
  EXPECT_EQ(problems(with("0.8", "\"fast\"")),
            "f:8:31: limits.max_speed_mps: is a text, but a number is expected\n");
  EXPECT_EQ(problems(with("0.8", "true")),
            "f:8:31: limits.max_speed_mps: is true or false, but a number is expected\n");
  EXPECT_EQ(problems(with("0.8", "null")),
            "f:8:31: limits.max_speed_mps: is null, but a number is expected"
            " (leave the key out for its default)\n");
  EXPECT_EQ(problems(with("1883", "1883.0")),
            "f:11:41: mqtt.port: is a number, but a whole number is expected"
            " (write it without a fraction)\n");
  EXPECT_EQ(problems(with("\"127.0.0.1\"", "127")),
            "f:11:20: mqtt.host: is an integer, but a text is expected (write it in quotes)\n");
  EXPECT_EQ(problems(with("{\"max_speed_mps\": 0.8}", "[0.8]")),
            "f:8:13: limits: is a list, but an object is expected\n");
  EXPECT_EQ(problems(with("[\"right\"]", "\"right\"")),
            "f:7:80: base.right: is a text, but a list of texts is expected\n");
  EXPECT_EQ(problems(with("[\"right\"]", "[\"right\", 2]")),
            "f:7:90: base.right: is an integer, but a list of texts is expected\n");
  EXPECT_EQ(problems(with("[{\"name\": \"can0\", \"interface\": \"can0\"}]", "{}")).substr(0, 51),
            "f:2:12: buses: is an object, but a list is expected");
}

TEST(Configuration, RefusesAListEntryThatIsNoObject) {
  EXPECT_THAT(problems(with("[{\"name\": \"can0\", \"interface\": \"can0\"}]",
                            "[{\"name\": \"can0\", \"interface\": \"can0\"}, \"can1\"]")),
              HasSubstr("f:2:52: buses[1]: is a text, but an object is expected\n"));
}

TEST(Configuration, RefusesAValueOutsideItsRange) {
  EXPECT_EQ(problems(with("0.8", "800")),
            "f:8:31: limits.max_speed_mps: is 800, but must be between 0.05 and 5\n");
  EXPECT_EQ(problems(with("0.8", "5.001")),
            "f:8:31: limits.max_speed_mps: is 5.001, but must be between 0.05 and 5\n");
  EXPECT_EQ(problems(with("0.8", "5")), "");
  EXPECT_EQ(problems(with("1883", "65536")),
            "f:11:41: mqtt.port: is 65536, but must be between 0 and 65535\n");
  EXPECT_NE(problems(with("1883", "4294969179")), "");  // would be 1883 in 32 bits
}

TEST(Configuration, TellsWhatIsMissingAndWhatItMeans) {
  EXPECT_EQ(problems(with("\"track_m\": 0.6, ", "")),
            "f:7:11: base.track_m: is missing (between left and right wheels)\n");
  EXPECT_THAT(problems("{}"), HasSubstr("f:1:1: drives: is missing (driven axes, in order)\n"));
  EXPECT_THAT(problems("{}"), HasSubstr("f:1:1: base: is missing (the vehicle)\n"));
}

TEST(Configuration, RefusesAnEmptyNameWhereOneIsNeeded) {
  EXPECT_EQ(problems(with("\"chip0\"", "\"\"")),
            "f:10:21: lines.chip: is empty (label or name of the GPIO chip, or files:DIRECTORY)\n");
}

TEST(Configuration, RefusesANulCharacterInAText) {
  EXPECT_EQ(problems(with("/dev/drover/gnss", "/dev/\\u0000gnss")),
            "f:9:20: gnss.port: holds a NUL character\n");
}

TEST(Configuration, RefusesAKeyThatIsThereTwice) {
  EXPECT_EQ(problems(with("0.8}", "0.8, \"max_speed_mps\": 0.9}")),
            "f:8:36: limits.max_speed_mps: this key is there twice\n");
}

TEST(Configuration, RefusesWhatIsNoJsonAndTellsWhere) {
  EXPECT_THAT(problems(with("0.8}", "0.8,}")), HasSubstr("f:8:"));
  EXPECT_THAT(problems(""), HasSubstr("f:1:1: "));
  EXPECT_THAT(problems("{\n  \"robot\": \"a\"\n  \"paths\": {}\n}"), HasSubstr("f:3:"));
  EXPECT_EQ(problems("[]"), "f:1:1: an object is expected ({ ... })\n");
}

TEST(Configuration, RefusesTooManyOrTooFewEntries) {
  EXPECT_THAT(problems(with("[\"right\"]", "[]")),
              HasSubstr("f:7:80: base.right: has 0 entries, but needs at least 1 entry\n"));
  std::string buses;
  for (int i = 1; i < 5; ++i) {
    const auto name = "\"can" + std::to_string(i) + "\"";
    buses += ", {\"name\": " + name + ", \"interface\": " + name + "}";
  }
  EXPECT_EQ(problems(with("\"interface\": \"can0\"}", "\"interface\": \"can0\"}" + buses)),
            "f:2:12: buses: has 5 entries, but may have at most 4 entries\n");
}

TEST(Configuration, TellsAllProblemsAtOnceInTheOrderOfTheFile) {
  auto text = with("\"node\": 2", "\"nod\": 2");
  text.replace(text.find("0.165"), 5, "\"a\"");
  text.replace(text.find("115200"), 6, "1");
  text.replace(text.find("1883"), 4, "70000");
  EXPECT_EQ(problems(text),
            "f:5:70: drives[1].options.node: is missing (node id of the axis on the bus, 0 to 62 "
            "(63 is the broadcast))\n"
            "f:5:71: drives[1].options.nod: is no known key (did you mean \"node\"?)\n"
            "f:7:30: base.wheel_radius_m: is a text, but a number is expected\n"
            "f:9:48: gnss.baud: is 1, but must be between 4800 and 921600\n"
            "f:11:41: mqtt.port: is 70000, but must be between 0 and 65535\n");
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
  ASSERT_EQ(c.drives.size(), 2u);
  EXPECT_EQ(c.drives[1].joint, "right");
  EXPECT_EQ(c.drives[1].options.number("node"), 2);
  EXPECT_TRUE(c.gnss.configured);
  EXPECT_EQ(c.gnss.port, "/dev/drover/gnss");
  EXPECT_EQ(c.lines.line[static_cast<std::size_t>(Line::bumper)].name, "b");
  EXPECT_EQ(c.mqtt.port, 1883);
}

}  // namespace
}  // namespace drover::config
