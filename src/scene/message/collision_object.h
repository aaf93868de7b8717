// moveit_msgs/CollisionObject of ROS 1, before it had a pose of its own.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "scene/message/header.h"
#include "scene/message/shapes.h"

namespace drover::scene {

/// object_recognition_msgs/ObjectType: kept, used for nothing.
struct ObjectType {
  std::string key;
  std::string db;
};

/// Source: ros-message-types, moveit_msgs 1. Poses are relative to header.frame_id.
struct CollisionObject {
  enum Operation : std::uint8_t { ADD = 0, REMOVE = 1, APPEND = 2, MOVE = 3 };
  Header header;
  std::string id;
  ObjectType type;
  std::vector<SolidPrimitive> primitives;
  std::vector<Pose> primitive_poses;
  std::vector<Mesh> meshes;
  std::vector<Pose> mesh_poses;
  std::vector<Plane> planes;
  std::vector<Pose> plane_poses;
  std::uint8_t operation = ADD;
};

}  // namespace drover::scene
