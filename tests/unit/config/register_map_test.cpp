#include "config/register_map.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>

namespace drover::config {
namespace {

using testing::HasSubstr;

constexpr std::string_view kGoodMap = R"({
  "name": "test", "source": "nobody", "stride": 2,
  "fields": [
    {"field": "voltage", "address": "0x28", "type": "u32", "unit": "mV"},
    {"field": "temperature", "address": 32, "count": 4, "fitted": 50, "unit": "K", "scale": 0.1},
    {"field": "state", "address": 47, "states": ["idle", "discharging"]}
  ],
  "alarms": [{"address": 60, "bit": 3, "level": "critical", "text": "empty"}]
}
)";

std::string map_with(std::string_view piece, std::string_view replacement) {
  std::string text(kGoodMap);
  const auto at = text.find(piece);
  EXPECT_NE(at, std::string::npos) << piece;
  return text.replace(at, piece.size(), replacement);
}
std::string map_problems(std::string_view text) {
  std::string all;
  for (const auto& problem : parse_register_map(text).problems) all += problem.text("m") + "\n";
  return all;
}
std::string content(const std::string& path) {
  std::ifstream file(path);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

TEST(RegisterMapFile, TellsWhatIsWrongWithItsPlace) {
  EXPECT_EQ(map_problems(map_with("\"voltage\"", "\"voltag\"")).substr(0, 56),
            "m:4:15: fields[0].field: \"voltag\" is not one of: voltage");
  EXPECT_EQ(map_problems(map_with("\"0x28\"", "\"0x12345\"")),
            "m:4:37: fields[0].address: is a text, but an address like 40 or \"0x28\" is "
            "expected\n");
  EXPECT_EQ(map_problems(map_with("32,", "65536,")),
            "m:5:41: fields[1].address: is 65536, but must be between 0 and 65535\n");
  EXPECT_EQ(map_problems(map_with("\"K\"", "\"mA\"")),
            "m:5:79: fields[1].unit: \"mA\" is no unit of temperature (its own is degC)\n");
  EXPECT_EQ(map_problems(map_with("\"idle\", ", "\"idel\", ")),
            "m:6:49: fields[2].states: \"idel\" is no state (did you mean \"idle\"?)\n");
  EXPECT_EQ(map_problems(map_with(", \"states\": [\"idle\", \"discharging\"]", "")),
            "m:6:5: fields[2].states: is missing ([\"idle\", \"charging\", \"discharging\"])\n");
  EXPECT_EQ(map_problems(map_with("\"bit\": 3", "\"bit\": 16")),
            "m:8:37: alarms[0].bit: is 16, but must be between 0 and 15\n");
  EXPECT_EQ(map_problems(map_with("\"source\": \"nobody\", ", "")),
            "m:1:1: source: is missing (where the addresses come from)\n");
  EXPECT_EQ(map_problems(map_with("\"unit\": \"mV\"", "\"range\": [5, 2]")),
            "m:4:69: fields[0].range: must be [lowest, highest]\n");
  EXPECT_EQ(map_problems(map_with("\"unit\": \"mV\"", "\"function\": 1")),
            "m:4:72: fields[0].function: reads bits: only 3 and 4 read registers\n");
  EXPECT_EQ(map_problems(map_with("32, \"count\"", "65532, \"count\"")),
            "m:5:57: fields[1].count: reaches beyond the last register\n");
  EXPECT_THAT(map_problems("[]"), HasSubstr("m:1:1: an object is expected"));
}

std::string map_of(const std::string& fields, const std::string& more = "") {
  return R"({"name": "test", "source": "nobody",
"fields": [
)" + fields +
         "]" + more + "}";
}

TEST(RegisterMapFile, HasOneMeaningForEachRegister) {
  EXPECT_EQ(map_problems(map_of(R"({"field": "voltage", "address": 40, "type": "u32"},
{"field": "current", "address": 41, "type": "i16"})")),
            "m:4:33: fields[1].address: \"current\" takes register 41, which is a part of "
            "\"voltage\" (fields[0]: u32 at 40)\n");
  EXPECT_EQ(map_problems(map_of(R"({"field": "voltage", "address": 40},
{"field": "soc", "address": 40})")),
            "m:4:29: fields[1].address: \"soc\" takes register 40, which is a part of "
            "\"voltage\" (fields[0]: u16 at 40)\n");
  EXPECT_EQ(map_problems(map_of(R"({"field": "soc", "address": 44},
{"field": "temperature", "address": 40, "count": 8})")),
            "m:4:37: fields[1].address: \"temperature\" takes register 44, which is a part of "
            "\"soc\" (fields[0]: u16 at 44)\n");
  EXPECT_EQ(map_problems(map_of(R"({"field": "soc", "address": 40, "type": "u8_high"},
{"field": "temperature", "address": 40, "type": "u8_low"},
{"field": "current", "address": 40, "function": 4})")),
            "")
      << "two halves, and a register of another table";
  EXPECT_EQ(map_problems(map_of(R"({"field": "lowest_cell", "address": 0, "count": 8},
{"field": "highest_cell", "address": 0, "count": 8},
{"field": "state", "address": 9, "states": ["idle", "charging"]},
{"field": "charger", "address": 9})")),
            "")
      << "two things that one value tells";
}

TEST(RegisterMapFile, CountsTheBytesWhereItsAddressesDo) {
  const auto bytes = R"(, "stride": 2)";
  EXPECT_EQ(map_problems(map_of(R"({"field": "voltage", "address": 40, "type": "u32"},
{"field": "current", "address": 44, "type": "i16"})",
                                bytes)),
            "");
  EXPECT_THAT(map_problems(map_of(R"({"field": "voltage", "address": 40, "type": "u32"},
{"field": "current", "address": 42, "type": "i16"})",
                                  bytes)),
              HasSubstr("\"current\" takes register 42, which is a part of \"voltage\""));
}

TEST(RegisterMapFile, HasOneTextForEachAlarmBit) {
  EXPECT_EQ(map_problems(map_of(R"({"field": "soc", "address": 1})",
                                R"(, "alarms": [{"address": 60, "bit": 3, "text": "hot"},
{"address": 60, "bit": 4, "text": "cold"},
{"address": 60, "bit": 3, "text": "empty"}])")),
            "m:5:24: alarms[2].bit: \"empty\" is bit 3 of register 60, which is \"hot\" "
            "(alarms[0]) already\n");
}

TEST(RegisterMapFile, WarnsOfAddressesAsSheetsCountThem) {
  const auto map_warnings = [](const std::string& text) {
    std::string all;
    for (const auto& warning : parse_register_map(text).warnings) all += warning.text("m") + "\n";
    return all;
  };
  EXPECT_EQ(map_warnings(std::string(kGoodMap)), "");
  EXPECT_EQ(map_warnings(map_of(R"({"field": "voltage", "address": 40001},
{"field": "soc", "address": 40003})",
                                R"(, "alarms": [{"address": 40010, "bit": 1, "text": "hot"}])")),
            "m:3:33: fields[0].address: is 40001, and 2 others are alike: a map counts from 0, as "
            "on the wire; what a sheet calls 40001 is most often register 0 of function 3 (of a "
            "device that really has register 40001: \"0x9C41\")\n");
  EXPECT_THAT(map_warnings(map_of(R"({"field": "voltage", "address": 30011})")),
              HasSubstr("fields[0].address: is 30011: a map counts from 0, as on the wire; what a "
                        "sheet calls 30011 is most often register 10 of function 4"));
  EXPECT_EQ(map_warnings(map_of(R"({"field": "voltage", "address": "0x9C41"})")), "");
  EXPECT_EQ(map_warnings(map_of(R"({"field": "voltage", "address": 50000})")), "");
}

TEST(RegisterMapFile, MeansWhatItSays) {
  EXPECT_EQ(map_problems(kGoodMap), "");
  const auto map = parse_register_map(kGoodMap).map;
  ASSERT_EQ(map.fields.size(), 3U);
  EXPECT_EQ(map.stride, 2);
  EXPECT_EQ(map.fields[0].address, 0x28);
  EXPECT_DOUBLE_EQ(map.fields[0].scale, 0.001);
  EXPECT_EQ(map.fields[0].type, RegisterType::u32);
  EXPECT_EQ(map.fields[1].count, 4);
  EXPECT_EQ(map.fields[1].count_address, 50);
  EXPECT_DOUBLE_EQ(map.fields[1].scale, 0.1);
  EXPECT_DOUBLE_EQ(map.fields[1].offset, -273.15);
  ASSERT_EQ(map.fields[2].flows.size(), 2U);
  EXPECT_EQ(map.fields[2].flows[1], BatteryFlow::discharging);
  ASSERT_EQ(map.alarms.size(), 1U);
  EXPECT_TRUE(map.alarms[0].critical);
}

TEST(RegisterMapFile, ThatCannotBeReadIsNamed) {
  const auto loaded = load_register_map("no/such/map.json");
  ASSERT_EQ(loaded.problems.size(), 1U);
  EXPECT_EQ(loaded.problems[0].text("drover.json"),
            "no/such/map.json: cannot be read: No such file or directory");
}

TEST(RegisterMaps, ThatComeAlongAreGood) {
  for (const auto* name : {"daly_d2.json", "jk_pb.json"}) {
    const auto loaded = load_register_map(DROVER_SOURCE_DIR "/config/maps/" + std::string(name));
    for (const auto& problem : loaded.problems) ADD_FAILURE() << problem.text("");
  }
}

TEST(RegisterMaps, AreFoundBesideTheConfigurationFirst) {
  EXPECT_EQ(find_register_map("maps/daly_d2.json", DROVER_SOURCE_DIR "/config"),
            DROVER_SOURCE_DIR "/config/maps/daly_d2.json");
  EXPECT_EQ(find_register_map("no_such.json", "folder"), "folder/no_such.json");
}

TEST(RegisterMapSchema, InTheFolderIsTheOneThatIsWritten) {
  EXPECT_TRUE(content(DROVER_SOURCE_DIR "/config/maps/register_map.schema.json") ==
              register_map_schema_text())
      << "write it anew: droverd --map-schema > config/maps/register_map.schema.json";
}

TEST(RegisterMapSchema, TellsWhichCurrentChargesAndWhatAChargerIs) {
  EXPECT_THAT(register_map_schema_text(), HasSubstr("current: positive while the pack charges"));
  EXPECT_THAT(register_map_schema_text(), HasSubstr("charger: any raw value but 0 means"));
}

TEST(RegisterMapFile, OfTheCloneIsFoundByAProgramThatRunsFromABuildInIt) {
  const auto elsewhere = std::filesystem::temp_directory_path();
  EXPECT_TRUE(std::filesystem::exists(find_register_map("daly_d2.json", elsewhere.string())));
  EXPECT_THAT(missing_register_map("daly.json", elsewhere.string()).message,
              HasSubstr("config/maps"));
}

}  // namespace
}  // namespace drover::config
