// What drives taught the robot of itself, over the death of the gateway: real processes, in real
// time.
#include <gmock/gmock.h>

#include <fstream>

#include "integration/robot_rig.h"

namespace drover::test {
namespace {

using testing::HasSubstr;

class Learned : public RobotRig {
 protected:
  std::string show() { return drover({"learned", "show", "--json"}).text; }
  /// One of its values; empty when it is not known.
  static std::string fits(const std::string& shown, const std::string& name) {
    const auto at = shown.find("\"" + name + "\"");
    if (at == std::string::npos) return {};
    const auto from = shown.find("\"fits\":", at) + 7;
    return shown.substr(from, shown.find(',', from) - from);
  }
  bool is_on_disk() const {
    std::ifstream file(folder() / "state/learned.json");
    const std::string text{std::istreambuf_iterator<char>(file), {}};
    return text.find("late_s") != std::string::npos;
  }
};

TEST_F(Learned, OutlivesTheGatewayUntilAPersonHasItForgotten) {
  start_new();
  EXPECT_THAT(show(), HasSubstr(R"("values":[])"));
  // Stops and starts tell how late positions are.
  for (int drive = 0; drive < 3 && fits(show(), "positions late").empty(); ++drive) {
    const std::string name = "row " + std::to_string(drive);
    save_track(name, 3);
    start_until_accepted(name, 6);
    ASSERT_TRUE(wait_for_status("NAV_SUCCESS"));
  }
  ASSERT_TRUE(wait_until([&] { return is_on_disk(); }));
  const std::string before = fits(show(), "positions late");
  ASSERT_NE(before, "") << show();

  daemon().signal(SIGKILL);
  ASSERT_EQ(daemon().wait(std::chrono::seconds(20)), 128 + SIGKILL);
  start_daemon();
  ASSERT_TRUE(wait_until([&] { return drover({"learned", "show"}).code == 0; }));
  EXPECT_THAT(daemon().output(), HasSubstr("what the robot has learned of itself is used"));
  const std::string after = fits(show(), "positions late");
  ASSERT_NE(after, "") << show();
  EXPECT_NEAR(std::stod(after), std::stod(before), 0.02) << "half a sigma is not worth a write";
  EXPECT_THAT(drover({"learned", "show"}).text, HasSubstr("kept on the disk, of 20"));

  // Refused until the place is known again, and compared with where it stood.
  EXPECT_TRUE(wait_until([&] {
    return drover({"learned", "forget"}).code == 0;
  })) << drover({"learned", "forget"}).text;
  ASSERT_TRUE(wait_until([&] { return !is_on_disk(); }));
  EXPECT_THAT(show(), HasSubstr(R"("values":[])"));
  stop_daemon();
  start_daemon();
  ASSERT_TRUE(wait_until([&] { return drover({"learned", "show"}).code == 0; }));
  EXPECT_THAT(show(), HasSubstr(R"("values":[])"));
}

}  // namespace
}  // namespace drover::test
