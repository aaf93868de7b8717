// What a header's frame_id names.
#pragma once

#include <string_view>

namespace drover::scene {

/// "1" and "map", also with ROS 1's slash before it.
bool is_global_frame(std::string_view frame_id);
/// "0" and nothing at all: what has it cannot be placed.
bool is_no_frame(std::string_view frame_id);

}  // namespace drover::scene
