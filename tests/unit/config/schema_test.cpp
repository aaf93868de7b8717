// The schema is written from the reader's own tables; here both judge the same texts.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <list>
#include <nlohmann/json.hpp>
#include <sstream>
#include <valijson/adapters/nlohmann_json_adapter.hpp>
#include <valijson/schema.hpp>
#include <valijson/schema_parser.hpp>
#include <valijson/validator.hpp>

#include "config/register_map.h"
#include "unit/config/config_text.h"

namespace drover::config {
namespace {

using Json = nlohmann::json;
using Adapter = valijson::adapters::NlohmannJsonAdapter;

std::string read(const std::filesystem::path& path) {
  std::ifstream file(path);
  std::ostringstream text;
  text << file.rdbuf();
  EXPECT_TRUE(file.good()) << path;
  return text.str();
}

std::unique_ptr<valijson::Schema> compiled(const std::string& text) {
  static std::list<Json> kept;  // a schema looks into its document
  kept.push_back(Json::parse(text));
  auto made = std::make_unique<valijson::Schema>();
  valijson::SchemaParser(valijson::SchemaParser::kDraft7)
      .populateSchema(Adapter(kept.back()), *made);
  return made;
}

bool accepts(const valijson::Schema& schema, const std::string& text) {
  const Json target = Json::parse(text, nullptr, true, /*ignore_comments=*/true);
  return valijson::Validator().validate(schema, Adapter(target), nullptr);
}

bool schema_accepts(const std::string& text) {
  static const auto schema = compiled(schema_text());
  return accepts(*schema, text);
}

TEST(Schema, AndTheReaderRefuseTheSame) {
  for (const auto& [piece, replacement] :
       std::initializer_list<std::pair<const char*, const char*>>{
           {"max_speed_mps", "max_sped_mps"},  // unknown key
           {"0.8", "\"0.8\""},                 // types
           {"0.8", "null"},
           {"1883", "\"1883\""},
           {"1883", "1.5"},
           {"\"127.0.0.1\"", "true"},
           {"[\"right\"]", "\"right\""},
           {"[\"right\"]", "[1]"},
           {"{\"max_speed_mps\": 0.8}", "0.8"},
           {"0.8", "5.01"},  // ranges
           {"0.8", "0.04"},
           {"1883", "65536"},
           {"1883", "-1"},
           {"\"track_m\": 0.6, ", ""},  // missing
           {"\"kind\": \"skid_steer\", ", ""},
           {"\"gpio\": \"chip0\"", ""},
           {"\"line\": \"b\", ", ""},
           {"\"link\": \"gnss\"}", "\"link\": \"gnss\", \"map\": \"m\"}"},  // of another kind
           {"\"gpio\": \"chip0\"", "\"gpio\": \"chip0\", \"can\": \"can1\""},
           {"\"bumper\": {", "\"\": {"},  // names
           {"\"bumper\": {", "\"a name that is much longer than a name may be in here\": {"},
           {"\"is\": \"bumper\"", "\"is\": \"bumpr\""},
           {", \"options\": {\"node\": 1}", ""},
           {"\"chip0\"", "\"\""},  // empty
           {"[\"right\"]", "[]"},
           {"\"left\": {\"driver\": \"odrive\"", "\"left\": {\"driver\": \"odriv\""},  // choices
           {"1883}", "1883}, \"protocol\": {\"power\": \"watt\"}"},
           {"\"node\": 1", "\"nod\": 1"},  // options of drivers
           {"\"node\": 1", "\"node\": 63"},
           {"\"node\": 1", "\"node\": 1.5"},
           {"\"node\": 1", "\"node\": 1, \"firmware\": \"0.4\""},
           {"\"node\": 1", "\"node\": 1, \"reversed\": 1"},
           {"\"link\": \"gnss\"", "\"link\": \"gnss\", \"options\": {\"node\": 1}"},
           {"\"link\": \"gnss\"", "\"link\": \"gnss\", \"options\": {\"latency_s\": 2}"},
           {"\"line\": \"a\"", "\"line\": \"a\", \"options\": {\"active_level\": \"up\"}"},
           {"{\"can\": \"can0\"}", "{\"cna\": \"can0\"}"},
           {"1883}",
            "1883}, \"scene\": {}"},  // the scene needs a footprint, its corners both numbers
           {"1883}",
            "1883}, \"scene\": {\"footprint\": [{\"x_m\": 1}, {\"x_m\": 2}, {\"x_m\": 3}]}"},
           {"1883}", "1883}, \"scene\": {\"footprint\": [], \"margin_m\": -1}"},
       }) {
    const auto text = with(piece, replacement);
    EXPECT_NE(problems(text), "") << piece << " -> " << replacement;
    EXPECT_FALSE(schema_accepts(text)) << piece << " -> " << replacement;
  }
}

TEST(Schema, AndTheReaderAcceptTheSame) {
  EXPECT_TRUE(schema_accepts(std::string(kGood)));
  for (const auto& [piece, replacement] :
       std::initializer_list<std::pair<const char*, const char*>>{
           {"0.8", "5"},
           {"0.8", "0.05"},
           {"\"left\": {\"driver\"", "\"left\": {\"joints\": {\"left\": {}}, \"driver\""},
           {"\"node\": 1", "\"node\": 0, \"firmware\": \"0.5.6\", \"gear_ratio\": 8"},
           {"\"link\": \"gnss\"", "\"link\": \"gnss\", \"options\": {\"latency_s\": 0.1}"},
           {"\"line\": \"a\"", "\"line\": \"a\", \"options\": {\"active_level\": \"high\"}"},
           {"115200", "0"},
       }) {
    const auto text = with(piece, replacement);
    EXPECT_EQ(problems(text), "") << piece << " -> " << replacement;
    EXPECT_TRUE(schema_accepts(text)) << piece << " -> " << replacement;
  }
}

TEST(Schema, AndTheReaderAcceptTheExamples) {
  const std::filesystem::path folder = DROVER_SOURCE_DIR "/config";
  std::vector<std::filesystem::path> files{folder / "drover.json"};
  for (const auto& entry : std::filesystem::directory_iterator(folder / "examples"))
    files.push_back(entry.path());
  ASSERT_GE(files.size(), 2u);
  for (const auto& file : files) {
    EXPECT_EQ(problems(read(file), file.parent_path()), "") << file;
    EXPECT_TRUE(schema_accepts(read(file))) << file;
  }
}

TEST(Schema, InTheFolderIsTheOneThatIsWritten) {
  EXPECT_TRUE(read(DROVER_SOURCE_DIR "/config/drover.schema.json") == schema_text())
      << "write it anew: droverd --schema > config/drover.schema.json";
}

TEST(RegisterMapSchema, AcceptsTheMapsThatComeAlongAndRefusesASlip) {
  const auto schema = compiled(register_map_schema_text());
  for (const auto* name : {"daly_d2.json", "jk_pb.json"}) {
    auto text = read(DROVER_SOURCE_DIR "/config/maps/" + std::string(name));
    EXPECT_TRUE(accepts(*schema, text)) << name;
    text.replace(text.find("\"voltage\""), 9, "\"voltag\"");
    EXPECT_FALSE(accepts(*schema, text)) << name;
  }
}

TEST(Example, OfTwoHubMotorsIsOneDeviceWithTwoJoints) {
  const auto folder = std::string(DROVER_SOURCE_DIR "/config/examples");
  const auto loaded = load_text(read(folder + "/two_hub_motors.json"), folder);
  EXPECT_THAT(loaded.problems, testing::IsEmpty());
  EXPECT_THAT(loaded.warnings, testing::IsEmpty());
  const auto& config = loaded.config;
  ASSERT_EQ(config.engine.joints.size(), 2U);
  EXPECT_EQ(config.devices[0].name, "wheels");
  EXPECT_EQ(config.devices[0].joints.size(), 2U);
  EXPECT_EQ(config.engine.base.left.size(), 1U);
  EXPECT_EQ(config.engine.base.right.size(), 1U);
}

TEST(Example, OfFourRobomasterMotorsSaysThatNothingHoldsThemAndThatTheyGoOnInSilence) {
  const auto folder = std::string(DROVER_SOURCE_DIR "/config/examples");
  const auto text = read(folder + "/robomaster.json");
  const auto loaded = load_text(text, folder);
  EXPECT_THAT(loaded.problems, testing::IsEmpty());
  EXPECT_THAT(loaded.warnings, testing::IsEmpty());
  EXPECT_EQ(loaded.config.engine.joints.size(), 4U);
  EXPECT_EQ(loaded.config.engine.base.hold, engine::HoldBy::level_ground_only);
  auto unaccepted = text;
  unaccepted.replace(unaccepted.find("\"no_watchdog\""), 13, "");
  EXPECT_THAT(problems(unaccepted, folder),
              testing::HasSubstr("keeps its last current for ever, for all that its maker says"));
  auto without_gain = text;
  without_gain.replace(without_gain.find("\"velocity_gain_Nms_per_rad\": 0.3"), 32,
                       "\"ramp_radps2\": 60");
  EXPECT_THAT(problems(without_gain, folder), testing::HasSubstr("velocity_gain_Nms_per_rad"));
}

TEST(Example, OfFourRobomasterMotorsIsToldOfGroundOnWhichItWouldRoll) {
  const auto folder = std::string(DROVER_SOURCE_DIR "/config/examples");
  const auto with = [&](const std::string& hold, const std::string& accept) {
    auto text = read(folder + "/robomaster.json");
    const std::string level = R"("hold": "level_ground_only")";
    text.replace(text.find(level), level.size(), "\"hold\": \"" + hold + "\"");
    const std::string flat = R"("max_tilt_deg": 3)";
    text.replace(text.find(flat), flat.size(), R"("max_tilt_deg": 8)");
    text.insert(text.find("\n  \"links\""), "\n  \"accept\": [" + accept + "],");
    const auto loaded = load_text(text, folder);
    EXPECT_THAT(loaded.problems, testing::IsEmpty());
    std::string told;
    for (const auto& warning : loaded.warnings) told += warning.text("f") + '\n';
    return told;
  };
  EXPECT_THAT(with("level_ground_only", ""),
              testing::HasSubstr("groups.base.max_tilt_deg: is 8: where it may stand when droverd "
                                 "dies drover-guard can only let the wheels of "));
  EXPECT_EQ(with("level_ground_only", "\"rolls\""), "");
  EXPECT_EQ(with("brake", ""), "");
}

TEST(Example, ExplainsEverySection) {
  const auto text = read(DROVER_SOURCE_DIR "/config/drover.json");
  const auto schema = Json::parse(schema_text());
  for (const auto& [section, ignored] : schema["properties"].items())
    if (section != "$schema")  // the editor's own
      EXPECT_THAT(text, testing::HasSubstr("\n  \"" + section + "\":")) << section;
}

TEST(Example, StatesTheDefaultsWhereItStatesWhatHasADefault) {
  const auto loaded = load_file(DROVER_SOURCE_DIR "/config/drover.json");
  const engine::EngineConfig defaults;
  const auto& engine = loaded.config.engine;
  EXPECT_EQ(engine.limits.max_speed_mps, defaults.limits.max_speed_mps);
  EXPECT_EQ(engine.limits.deceleration_mps2, defaults.limits.deceleration_mps2);
  EXPECT_EQ(engine.navigate.corridor_m, defaults.navigate.corridor_m);
  EXPECT_EQ(engine.navigate.goal_tolerance_m, defaults.navigate.goal_tolerance_m);
  EXPECT_EQ(engine.estimate.bound_run_m, defaults.estimate.bound_run_m);
  EXPECT_EQ(engine.health.drive_stale_s, defaults.health.drive_stale_s);
  EXPECT_EQ(loaded.config.guard.limit_ms, GuardConfig{}.limit_ms);
}

}  // namespace
}  // namespace drover::config
