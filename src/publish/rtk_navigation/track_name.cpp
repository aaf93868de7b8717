// Which texts may name a track.
#include "publish/rtk_navigation/track_name.h"

#include <algorithm>

#include "text/control.h"

namespace drover::publish {
std::optional<std::string> name_problem(std::string_view name, std::size_t max_bytes) {
  const auto is_control = [](char c) {
    return static_cast<unsigned char>(c) < 0x20 || static_cast<unsigned char>(c) == 0x7F;
  };
  if (std::any_of(name.begin(), name.end(), is_control)) {
    return "the name contains a control character";
  }
  if (name.size() > max_bytes) {
    return "the name is longer than " + std::to_string(max_bytes) + " bytes";
  }
  return std::nullopt;
}

std::optional<std::string> new_name_problem(std::string_view name) {
  if (name.empty()) return "the name is empty";
  if (text::has_control(name)) return "the name contains an invisible control character";
  return std::nullopt;
}

}  // namespace drover::publish
