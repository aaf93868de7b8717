// Names of frames as ROS programs write them.
#pragma once

#include <string_view>

namespace drover::text {

/// Old ROS programs begin a frame's name with a slash, which means nothing: "/map" is "map".
constexpr std::string_view without_slash(std::string_view frame_id) {
  if (frame_id.starts_with('/')) frame_id.remove_prefix(1);
  return frame_id;
}

}  // namespace drover::text
