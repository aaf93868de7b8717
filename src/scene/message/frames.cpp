#include "scene/message/frames.h"

#include "text/frame_name.h"

namespace drover::scene {

bool is_global_frame(std::string_view frame_id) {
  const std::string_view name = text::without_slash(frame_id);
  return name == "1" || name == "map";
}

bool is_no_frame(std::string_view frame_id) {
  const std::string_view name = text::without_slash(frame_id);
  return name.empty() || name == "0";
}

}  // namespace drover::scene
