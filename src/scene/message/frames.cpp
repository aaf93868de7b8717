#include "scene/message/frames.h"

namespace drover::scene {
namespace {

std::string_view without_slash(std::string_view frame_id) {
  if (frame_id.starts_with('/')) frame_id.remove_prefix(1);
  return frame_id;
}

}  // namespace

bool is_global_frame(std::string_view frame_id) {
  const std::string_view name = without_slash(frame_id);
  return name == "1" || name == "map";
}

bool is_no_frame(std::string_view frame_id) {
  const std::string_view name = without_slash(frame_id);
  return name.empty() || name == "0";
}

}  // namespace drover::scene
