// CubeMars motors in the configuration: what they can neither be asked nor told stands there.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>

#include "unit/config/config_text.h"

namespace drover::config {
namespace {

using testing::AnyOf;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

const std::string kRobots = DROVER_SOURCE_DIR "/config/examples";

std::string robot(const std::string& name) {
  std::ifstream file(kRobots + "/" + name);
  return {std::istreambuf_iterator<char>(file), {}};
}

std::string problems_with(const std::string& piece, const std::string& replacement) {
  auto text = robot("cubemars_arm.json");
  const auto at = text.find(piece);
  EXPECT_NE(at, std::string::npos) << piece;
  if (at == std::string::npos) return "";
  return problems(text.replace(at, piece.size(), replacement), kRobots);
}

TEST(CubemarsMit, IsTheArmOfAnExample) {
  const auto loaded = load_text(robot("cubemars_arm.json"), kRobots);
  EXPECT_THAT(loaded.problems, IsEmpty());
  EXPECT_THAT(loaded.warnings, IsEmpty());
  ASSERT_EQ(loaded.config.engine.groups.size(), 1u);
  EXPECT_EQ(loaded.config.engine.groups[0].joints.size(), 3u);
}

TEST(CubemarsMit, NeedsAModel) {
  EXPECT_THAT(problems_with("\"id\": 1, \"model\": \"AK70-10\"", "\"id\": 1"),
              HasSubstr("devices.turret.options.model: is missing"));
  EXPECT_THAT(
      problems_with("\"model\": \"AK70-10\"", "\"model\": \"AK70\""),
      HasSubstr("\"AK70\" is not one of: AK10-9, AK60-6, AK70-10, AK80-6, AK80-9, AK80-64"));
}

TEST(CubemarsMit, IsRefusedWithoutAKnownTimeOutUntilThatIsAccepted) {
  EXPECT_THAT(
      problems_with(", \"timeout_ms\": 100}", "}"),
      HasSubstr("devices.turret.options: may follow its last command for ever: its time-out "
                "is not known"));
  EXPECT_THAT(problems_with(", \"timeout_ms\": 100}}", "}, \"accept\": [\"no_watchdog\"]}"),
              IsEmpty());
}

TEST(CubemarsMit, SharesTheMasterIdZeroWithItsLike) {
  auto text = robot("cubemars_arm.json");
  for (const std::string id : {"\"id\": 1, ", "\"id\": 2, ", "\"id\": 3, "})
    text.replace(text.find(id), id.size(), id + "\"master_id\": 0, ");
  EXPECT_THAT(problems(text, kRobots), IsEmpty());
  EXPECT_THAT(problems_with("\"id\": 3, ", "\"id\": 3, \"master_id\": 2, "),
              HasSubstr("master_id: 1 to 126 are ids of motors"));
}

std::string hubs_and_a_motor(const std::string& master_id) {
  auto text = robot("two_hub_motors.json");
  const std::string devices = "\"devices\": {";
  text.insert(text.find(devices) + devices.size(),
              R"("lift": {"driver": "cubemars_mit", "link": "can0", "accept": ["no_watchdog"],
                 "options": {"model": "AK80-9", "id": 3, "master_id": )" +
                  master_id + "}},");
  return problems(text, kRobots);
}

TEST(CubemarsMit, SharesNoBusWithCanOpenWhenItAnswersUnderTheIdOfItsMaster) {
  constexpr const char* kRefused = "a cubemars_mit shares no bus with a zlac8015d";
  EXPECT_THAT(hubs_and_a_motor("0"), HasSubstr(kRefused));
  EXPECT_THAT(hubs_and_a_motor("-1"), Not(AnyOf(HasSubstr(kRefused), HasSubstr("both use"))));
}

}  // namespace
}  // namespace drover::config
