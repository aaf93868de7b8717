// How an `angle` in degrees counts on the wire; makers differ, inside it is always a yaw in rad.
#pragma once

#include <cstdint>

#include "drover/angle.h"

namespace drover {

enum class HeadingConvention : std::uint8_t {
  clockwise_from_north,
  counterclockwise_from_north,
  counterclockwise_from_east,
};

/// Degrees [0, 360) in the given convention, of a compass heading (clockwise from true north).
inline double angle_deg_from_compass(HeadingConvention convention, double compass_deg) {
  switch (convention) {
    case HeadingConvention::counterclockwise_from_north: return wrap_deg(-compass_deg);
    case HeadingConvention::counterclockwise_from_east: return wrap_deg(90.0 - compass_deg);
    case HeadingConvention::clockwise_from_north: break;
  }
  return wrap_deg(compass_deg);
}

/// Yaw (rad, counter-clockwise from east) of an angle in the given convention.
inline double yaw_rad_from_angle(HeadingConvention convention, double angle_deg) {
  switch (convention) {
    case HeadingConvention::counterclockwise_from_north:
      return yaw_rad_from_compass_deg(-angle_deg);
    case HeadingConvention::counterclockwise_from_east: return to_rad(angle_deg);
    case HeadingConvention::clockwise_from_north: break;
  }
  return yaw_rad_from_compass_deg(angle_deg);
}

}  // namespace drover
