// The field robot with a scene, and a ROS 2 user who puts things around it.
#pragma once

#include <moveit_msgs.h>

#include <string>

#include "integration/ros2_drive_rig.h"
#include "ros2/arena.h"

namespace drover::test {

class SceneFromRos2 : public MovedFromRos2 {
 protected:
  explicit SceneFromRos2(const std::string& inputs) : MovedFromRos2(inputs) {
    add_section(R"("scene": {
      "footprint": [{"x_m": 0.45, "y_m": 0.35}, {"x_m": -0.415, "y_m": 0.35},
                    {"x_m": -0.415, "y_m": -0.35}, {"x_m": 0.45, "y_m": -0.35}],
      "ground_clearance_m": 0.05, "height_m": 1})");
  }
  static moveit_msgs_msg_dds__CollisionObject_ object(ros2::Arena& arena, const std::string& id,
                                                      const char* frame) {
    moveit_msgs_msg_dds__CollisionObject_ made{};
    made.header_.frame_id_ = arena.text(frame);
    made.pose_.orientation_.w_ = 1;
    made.id_ = arena.text(id);
    made.type_ = {arena.text(""), arena.text("")};
    return made;
  }
  /// A box of 0.4 x 2 x 1 m on the ground, `ahead_m` of the frame's origin. False: it was not taken
  /// to be written.
  static bool put_box(dds_entity_t by, const std::string& id, const char* frame, double ahead_m) {
    ros2::Arena arena;
    auto made = object(arena, id, frame);
    made.pose_.position_ = {ahead_m, 0, 0.5};
    auto* box = arena.fill(made.primitives_, 1);
    box->type_ = 1;
    auto* size = arena.fill(box->dimensions_, 3);
    size[0] = 0.4;
    size[1] = 2;
    size[2] = 1;
    return dds_write(by, &made) == DDS_RETCODE_OK;
  }
  bool shows(std::string_view text) {
    return drover({"scene", "list"}).text.find(text) != std::string::npos;
  }
  std::string state() { return drover({"status", "--json"}).text; }
  bool journal_has(std::string_view text) {
    return program_.output().find(text) != std::string::npos;
  }
};

}  // namespace drover::test
