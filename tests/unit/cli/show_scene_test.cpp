// Answers about the scene as a person reads them.
#include "cli/show_scene.h"

#include <gtest/gtest.h>

#include "unit/cli/parsed.h"

namespace drover::cli {
namespace {

TEST(SceneList, HasALineForEachObjectAndSet) {
  EXPECT_EQ(
      show_scene(parsed(
          R"({"ok":true,"objects":[{"id":"box1","shapes":1,"triangles":0,"x_m":1.5,"y_m":0.2,)"
          R"("distance_m":3.1,"arrived_s":1700000000.5},)"
          R"({"id":"wall","shapes":2,"triangles":12,"x_m":1,"y_m":2,"distance_m":null,)"
          R"("arrived_s":null},)"
          R"({"id":"none","shapes":0,"triangles":0,"x_m":null,"y_m":null,"distance_m":null}],)"
          R"("constraints":[{"name":"row","joint":1,"position":0,"orientation":1,"visibility":0,)"
          R"("arrived_s":1700000000}],"problem":""})")),
      "box1                  1 shape     x     1.50 m  y     0.20 m     3.10 m from the robot"
      "  since 2023-11-14 22:13:20Z\n"
      "wall                  2 shapes    x     1.00 m  y     2.00 m  the robot does not know where "
      "it is  12 triangles\n"
      "none                  0 shapes    not placed\n"
      "row                   constraints: 1 joint, 1 orientation  since 2023-11-14 22:13:20Z\n");
}

TEST(SceneList, SaysThatItIsEmpty) {
  EXPECT_EQ(show_scene(parsed(R"({"ok":true,"objects":[],"constraints":[],"problem":""})")),
            "no object and no constraint\n");
}

TEST(SceneList, BeginsWithWhatIsLostAndTheWayOut) {
  EXPECT_EQ(show_scene(parsed(
                R"({"ok":true,"objects":[],"constraints":[],"problem":"the file is damaged"})")),
            "NOTHING IS FREE, no task moves: the file is damaged\n"
            "  the way out: drover scene accept-loss gives up what is lost\n"
            "no object and no constraint\n");
}

TEST(SceneShow, TellsShapesAndPlaces) {
  EXPECT_EQ(
      show_scene_entry(parsed(
          R"({"ok":true,"object":[{"header":{"frame_id":"map"},"id":"box1","operation":0,)"
          R"("primitives":[{"type":1,"dimensions":[0.4,0.3,1.2]},{"type":4,"dimensions":[2,0.5]}],)"
          R"("primitive_poses":[{"position":{"x":2,"y":-0.5,"z":0.6},)"
          R"("orientation":{"x":0,"y":0,"z":0.70710678118654757,"w":0.70710678118654757}},)"
          R"({"position":{"x":0,"y":0,"z":0},"orientation":{"x":0,"y":0,"z":0,"w":1}}]},)"
          R"({"id":"box1","operation":2,"planes":[{"coef":[1,0,0,-20]}],)"
          R"("plane_poses":[{"position":{"x":0,"y":0,"z":0},"orientation":{"w":1}}]}]})")),
      "object    box1  in the map\n"
      "box       0.40 x 0.30 x 1.20 m  at x 2.00  y -0.50  z 0.60 m  yaw 90.0 deg\n"
      "cone      height 2.00  radius 0.50 m  at x 0.00  y 0.00  z 0.00 m\n"
      "plane     1 x +0 y +0 z -20 = 0  at x 0.00  y 0.00  z 0.00 m\n");
}

TEST(SceneShow, TellsConstraints) {
  EXPECT_EQ(
      show_scene_entry(parsed(
          R"({"ok":true,"constraints":{"name":"row",)"
          R"("joint_constraints":[{"joint_name":"base/y","position":1.5,"tolerance_above":0.5,)"
          R"("tolerance_below":0.25,"weight":1}],)"
          R"("position_constraints":[{"header":{"frame_id":"map"},"link_name":"base_link",)"
          R"("constraint_region":{"primitives":[{}],"meshes":[]}}],)"
          R"("orientation_constraints":[{"header":{"frame_id":"map"},"link_name":"base_link",)"
          R"("absolute_x_axis_tolerance":0.2,"absolute_y_axis_tolerance":0.2,)"
          R"("absolute_z_axis_tolerance":3.2}],)"
          R"("visibility_constraints":[{"target_radius":0.5,"max_view_angle":0.3}]}})")),
      "constraints row\n"
      "joint       base/y  from 1.25 to 2\n"
      "position    base_link  inside of 1 shape  of frame map\n"
      "orientation base_link  within 0.2 0.2 3.2 rad about x, y, z  of frame map\n"
      "visibility  target of radius 0.50 m  view angle to 0.3 rad\n");
}

}  // namespace
}  // namespace drover::cli
