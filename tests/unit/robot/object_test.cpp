// Solids by command, and the record of them and of what the robot touches.
#include "unit/robot/robot_rig.h"

namespace drover::sim {
namespace {

using testing::ContainsRegex;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::StartsWith;

struct ObjectCommand : RobotTest {
  ObjectCommand() {
    scenario.world = std::string(DROVER_SOURCE_DIR) + "/sim/worlds/field_scene.xml";
  }
};

TEST_F(ObjectCommand, IsRefusedWhenItIsNotWhole) {
  auto robot = make();
  for (const auto* text :
       {"obstacle a box 1 2 0 1 1", "obstacle a box 1 2 0 1 1 x", "obstacle a box 1 2 0 1 1 1 1 1",
        "obstacle a box 1 2 0 1 1 -1", "obstacle a cylinder 1 2 0.3", "obstacle a sphere 1 2",
        "obstacle a prism 1 2 1 0.5 0 0 1 0", "obstacle a prism 1 2 1 0.5 0 0 1 0 1",
        "obstacle a move 1 2 1", "obstacle a remove", "obstacle a 1 2", "obstacle a egg 1 2"})
    EXPECT_THAT(robot.command(text), StartsWith("error: ")) << text;
  run(robot, kTick);
  EXPECT_THAT(robot.take_object_lines(), Not(HasSubstr("put")));
}

TEST_F(ObjectCommand, PutsMovesAndTakesAway) {
  auto robot = make();
  EXPECT_EQ(robot.command("obstacle crate box 3 1 90 0.4 0.3 1.2"), "ok");
  EXPECT_EQ(robot.command("obstacle post cylinder 4 1 0.01 1.5 0.9"), "ok");
  run(robot, kTick);
  EXPECT_EQ(robot.take_object_lines(),
            "(100.000000000) watching 36\n"
            "(100.000000000) put crate box 3.000000 1.000000 0.600000 1.570796 0.400000 0.300000 "
            "1.200000\n"
            "(100.000000000) put post cylinder 4.000000 1.000000 0.900000 0.000000 0.010000 "
            "1.500000\n");
  EXPECT_EQ(robot.command("obstacle post move 4 0 1"), "ok");
  run(robot, 2 * kTick);
  EXPECT_EQ(robot.take_object_lines(), "(100.010000000) at post 4.000000 0.995000\n");
  EXPECT_EQ(robot.command("obstacle post remove"), "ok");
  run(robot, kTick);
  EXPECT_EQ(robot.take_object_lines(), "(100.015000000) gone post\n");
  run(robot, kTick);
  EXPECT_THAT(robot.take_object_lines(), IsEmpty());
}

TEST_F(ObjectCommand, KeepsAConeAPrismAndASphere) {
  auto robot = make();
  EXPECT_EQ(robot.command("obstacle a cone 3 1 0.3 0.8"), "ok");
  EXPECT_EQ(robot.command("obstacle b prism 5 1 1 0.5 0 0 1 0 0 1"), "ok");
  EXPECT_EQ(robot.command("obstacle c sphere 7 1 0.3"), "ok");
  run(robot, kTick);
  const auto lines = robot.take_object_lines();
  EXPECT_THAT(lines, HasSubstr("put a cone 3.000000 1.000000 0.400000 0.000000 0.300000 0.800000"));
  EXPECT_THAT(lines, HasSubstr("put b prism 5.000000 1.000000 0.500000 0.000000 1.000000 0.000000 "
                               "0.000000 1.000000 0.000000 0.000000 1.000000"));
  EXPECT_THAT(lines, HasSubstr("put c sphere 7.000000 1.000000 0.300000 0.000000 0.300000"));
}

TEST_F(ObjectCommand, TouchesAreKeptWithTheirSpeed) {
  auto robot = make();
  run(robot, std::chrono::seconds(1));
  EXPECT_EQ(robot.command("obstacle wall box 1 0 0 0.2 4 1"), "ok");
  EXPECT_EQ(robot.command("kick 0.8 0"), "ok");
  run(robot, std::chrono::seconds(1));
  const auto lines = robot.take_object_lines();
  EXPECT_THAT(lines, ContainsRegex("touch wall 0\\.4[0-9]+ .*"));
  EXPECT_EQ(robot.command("obstacle wall remove"), "ok");
  run(robot, std::chrono::seconds(1));
  const auto later = lines + robot.take_object_lines();
  EXPECT_THAT(later, ContainsRegex("leave wall 0\\.0[0-9]+ 0\\.[1-9][0-9]+ 0\\.0"));
}

TEST_F(RobotTest, InAWorldWithoutObjectsNothingIsKept) {
  auto robot = make();
  EXPECT_FALSE(robot.has_objects());
  EXPECT_THAT(robot.command("obstacle crate box 3 1 90 0.4 0.3 1.2"), StartsWith("error: "));
  EXPECT_EQ(robot.command("obstacle obstacle 0.2 0"), "ok");
  run(robot, std::chrono::seconds(1));
  EXPECT_THAT(robot.take_object_lines(), IsEmpty());
}

}  // namespace
}  // namespace drover::sim
