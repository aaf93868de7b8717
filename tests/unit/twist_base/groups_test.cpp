// Joints outside the base that hang on one device.
#include <gmock/gmock.h>

#include "crawler_robot.h"

namespace drover::config {
namespace {

/// Two arms, and a device that has a joint of each.
std::string with_arms(const std::string& first, const std::string& second) {
  const auto joint = [](const std::string& name) {
    return "\"" + name +
           R"(": {"min_rad": -1, "max_rad": 1, "max_velocity_radps": 1, "max_effort_Nm": 5,
                  "stiffness_Nmprad": 40})";
  };
  std::string text = test::crawler_with(R"("links": {)", R"("links": {"can0": {"can": "can0"}, )");
  const std::string devices = R"("devices": {)";
  text.insert(text.find(devices) + devices.size(), R"(
    "elbows": {"driver": "elbow_pair", "link": "can0",
               "joints": {"left_elbow": {"channel": "first"},
                          "right_elbow": {"channel": "second"}}},)");
  const std::string groups = R"("groups": {)";
  std::string arms = "\"left\": {\"joints\": {" + joint(first);
  arms += (second.empty() ? ", " : "}}, \"right\": {\"joints\": {");
  arms += joint(second.empty() ? "right_elbow" : second) + "}}, ";
  return text.insert(text.find(groups) + groups.size(), arms);
}

std::string problems(const std::string& text) {
  std::string all;
  for (const auto& problem : load_text(text).problems) all += problem.text("f") + "\n";
  return all;
}

TEST(TheJointsOfOneDevice, BelongToOneGroup) {
  EXPECT_EQ(problems(with_arms("left_elbow", "")), "");
  const auto told = problems(with_arms("left_elbow", "right_elbow"));
  EXPECT_THAT(told, ::testing::HasSubstr(
                        "groups.left.joints.left_elbow: its device elbows moves \"right_elbow\" "
                        "too, which is not of this group (joints of one device belong to one "
                        "group)\n"));
  EXPECT_THAT(told, ::testing::HasSubstr("groups.right.joints.right_elbow: its device elbows "
                                         "moves \"left_elbow\" too"));
}

}  // namespace
}  // namespace drover::config
