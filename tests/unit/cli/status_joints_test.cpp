// Of joints outside the base and of joint commands: what `drover status` shows of them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "cli/show.h"
#include "publish/status/status.h"

namespace drover::cli {
namespace {

Snapshot with_a_wheel() {
  Snapshot s;
  AxisSnapshot wheel;
  wheel.joint = "front_left";
  wheel.state = AxisState::running;
  wheel.health = SourceState::fresh;
  wheel.motion.position_rad = 12.345;
  wheel.motion.velocity_radps = 3.021;
  (void)s.axes.push_back(wheel);
  return s;
}

TEST(StatusInShort, TellsWhoseCommandsAnArmFollows) {
  Snapshot s;
  GroupSnapshot arm;
  arm.name = "arm";
  arm.owner = GroupOwner::ros2;
  arm.state = GroupState::following;
  ASSERT_TRUE(s.groups.push_back(arm));
  arm.name = "mast";
  arm.owner = GroupOwner::nobody;
  arm.state = GroupState::holding;
  arm.reason = "its commands have ceased";
  ASSERT_TRUE(s.groups.push_back(arm));
  const auto parsed = json::parse(publish::status_json(s, {}));
  const auto shown = show_status(parsed->root);
  EXPECT_NE(shown.find("arm       following  owner ros2\n"), std::string::npos) << shown;
  EXPECT_NE(shown.find("mast      holding  its commands have ceased\n"), std::string::npos);
  EXPECT_EQ(*parsed->root.find("groups")->list()->at(1).find("owner")->text(), "nobody");
}

TEST(StatusInShort, TellsByWhichStiffnessAJointIsHeld) {
  Snapshot s = with_a_wheel();
  AxisSnapshot elbow = s.axes[0];
  elbow.joint = "elbow";
  elbow.stiffness_Nmprad = 60;
  elbow.damping_Nmsprad = 2.5;
  ASSERT_TRUE(s.axes.push_back(elbow));
  const auto status = json::parse(publish::status_json(s, {}))->root;
  const auto& axes = *status.find("axes")->list();
  EXPECT_EQ(axes.back().find("stiffness_Nmprad")->number(), 60);
  EXPECT_EQ(axes.back().find("damping_Nmsprad")->number(), 2.5);
  EXPECT_FALSE(axes.front().find("stiffness_Nmprad")->number()) << "of a wheel there is none";
  const std::string shown = show_status(status);
  EXPECT_NE(shown.find("60 Nm/rad  2.5 Nms/rad"), std::string::npos) << shown;
  EXPECT_EQ(shown.find("Nm/rad"), shown.rfind("Nm/rad")) << "of the joint alone";
}

/// Wheels beside a gripper of one joint.
Snapshot with_a_gripper() {
  Snapshot s = with_a_wheel();
  GroupSnapshot gripper;
  gripper.name = "gripper";
  EXPECT_TRUE(s.groups.push_back(gripper));
  AxisSnapshot jaw = s.axes[0];
  jaw.joint = "jaw";
  jaw.group = 1;
  jaw.motion.position_rad = -0.25;
  EXPECT_TRUE(s.axes.push_back(jaw));
  return s;
}

/// Also of one that nothing is asked of. Of a wheel it is no place.
TEST(StatusInShort, TellsWhereAJointOutsideTheBaseIs) {
  const auto status = json::parse(publish::status_json(with_a_gripper(), {}))->root;
  const auto& axes = *status.find("axes")->list();
  ASSERT_NE(axes.back().find("group"), nullptr);
  EXPECT_EQ(*axes.back().find("group")->text(), "gripper");
  EXPECT_EQ(axes.front().find("group"), nullptr) << "a wheel is of the base";
  const std::string shown = show_status(status);
  EXPECT_THAT(shown, testing::HasSubstr("jaw           running    -0.250 rad     3.02 rad/s"));
  EXPECT_THAT(shown, testing::HasSubstr("front_left    running                   3.02 rad/s"))
      << "one column under the other";
  EXPECT_THAT(show_status(json::parse(publish::status_json(with_a_wheel(), {}))->root),
              testing::HasSubstr("front_left    running     3.02 rad/s"));
}

/// It is counted before anybody looks whose joints a message names.
TEST(StatusInShort, TakesNoRefusalOfAGroupsJointForTheWheels) {
  Snapshot s = with_a_gripper();
  const auto shown = [&s](const char* why) {
    s.joint_command = {false, 0, 100, why};
    return show_status(json::parse(publish::status_json(s, {}))->root);
  };
  EXPECT_THAT(shown("joint 'jaw': velocity is NaN"),
              testing::HasSubstr("wheels    silent, 0 followed; of all joints 100 refused, "
                                 "last (gripper): joint 'jaw': velocity is NaN\n"));
  for (const char* const why : {"joint 'front_left': velocity is NaN", "joint 'jawbone': none"})
    EXPECT_THAT(shown(why),
                testing::HasSubstr(std::string("; of all joints 100 refused, last: ") + why));
}

/// Of a robot with an arm: what is of the wheels says so, and what a limit held back is told.
TEST(StatusInShort, TellsAnArmsCommandsApartFromTheWheels) {
  Snapshot s;
  GroupSnapshot arm;
  arm.name = "arm";
  arm.owner = GroupOwner::broker;
  arm.state = GroupState::following;
  arm.accepted = 321;
  arm.refused = 4;
  ASSERT_TRUE(s.groups.push_back(arm));
  arm.name = "mast";
  arm.limited = 45;
  ASSERT_TRUE(s.groups.push_back(arm));
  s.joint_command.refused = 147;
  s.joint_command.reason = "too old";
  LinkSnapshot link;
  link.name = "base_can";
  ASSERT_TRUE(s.links.push_back(link));
  link.name = "can_of_the_arm";
  ASSERT_TRUE(s.links.push_back(link));
  const auto shown = show_status(json::parse(publish::status_json(s, {}))->root);
  for (const char* const has :
       {"arm       following  owner broker  321 followed, 4 refused\n",
        "mast      following  owner broker  321 followed, 4 refused, held "
        "by a limit in 45 cycles\n",
        "wheels    silent, 0 followed; of all joints 147 refused, last: too old\n",
        "drives    not held (those of the base)\n", "links     base_can       down",
        "          can_of_the_arm down"})
    EXPECT_NE(shown.find(has), std::string::npos) << has << "\n" << shown;
}

}  // namespace
}  // namespace drover::cli
