// shape_msgs of ROS 1: SolidPrimitive, Mesh and Plane.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "drover/measurement.h"

namespace drover::scene {

/// Centred at (0, 0, 0) of its pose. Source: ros-message-types, shape_msgs 1.
struct SolidPrimitive {
  enum Type : std::uint8_t { BOX = 1, SPHERE = 2, CYLINDER = 3, CONE = 4 };
  /// What stands where in `dimensions`, in metres. The axis of cylinder and cone is z, the cone's
  /// tip is at +z.
  enum Dimension : std::size_t {
    BOX_X = 0,
    BOX_Y = 1,
    BOX_Z = 2,
    SPHERE_RADIUS = 0,
    CYLINDER_HEIGHT = 0,
    CYLINDER_RADIUS = 1,
    CONE_HEIGHT = 0,
    CONE_RADIUS = 1,
  };
  std::uint8_t type = 0;
  std::vector<double> dimensions;
};

/// shape_msgs/MeshTriangle: indices into the mesh's vertices.
using MeshTriangle = std::array<std::uint32_t, 3>;

/// shape_msgs/Mesh: metres in the frame of its pose.
struct Mesh {
  std::vector<MeshTriangle> triangles;
  std::vector<Vector3> vertices;
};

/// shape_msgs/Plane: a x + b y + c z + d = 0. The four need not be of unit length.
struct Plane {
  std::array<double, 4> coef{};
};

}  // namespace drover::scene
