// "obstacle NAME ..." of a solid, as words:
//   box X Y YAW_DEG LENGTH WIDTH HEIGHT [Z]     Z: of the middle of its height; none: on the ground
//   cylinder X Y RADIUS HEIGHT [Z]
//   cone X Y RADIUS HEIGHT [Z]                  its tip is up
//   sphere X Y RADIUS [Z]
//   prism X Y HEIGHT Z X1 Y1 X2 Y2 X3 Y3 ...    a convex polygon about X and Y, counter-clockwise
//   move X Y SPEED                              it goes there on a straight line
//   remove
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "sim/plant/plant.h"

namespace drover::sim {

/// Whether the words behind the name speak of a solid; else of a box that the world has.
bool is_object_command(std::span<const std::string_view> words);
/// "ok", or "error: ...".
std::string command_object(Plant& plant, std::string_view name,
                           std::span<const std::string_view> words);

}  // namespace drover::sim
