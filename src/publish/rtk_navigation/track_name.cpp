// Which texts may name a track.
#include "publish/rtk_navigation/track_name.h"

#include <algorithm>

namespace drover::publish {
namespace {

/// A character that shows as another line or turns the text around it: C1 controls, U+2028 and
/// U+2029, and the marks of bidirectional text (U+061C, U+200E, U+200F, U+202A to U+202E, U+2066 to
/// U+2069). `name` is UTF-8.
bool has_invisible_mark(std::string_view name) {
  const auto byte = [&](std::size_t i) {
    return i < name.size() ? static_cast<unsigned char>(name[i]) : 0U;
  };
  for (std::size_t i = 0; i < name.size(); ++i) {
    const unsigned a = byte(i);
    const unsigned b = byte(i + 1);
    const unsigned c = byte(i + 2);
    if (a == 0xC2 && b >= 0x80 && b <= 0x9F) return true;
    if (a == 0xD8 && b == 0x9C) return true;
    if (a != 0xE2) continue;
    const bool general = b == 0x80 && (c == 0x8E || c == 0x8F || (c >= 0xA8 && c <= 0xAE));
    const bool isolate = b == 0x81 && c >= 0xA6 && c <= 0xA9;
    if (general || isolate) return true;
  }
  return false;
}

}  // namespace

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
  if (has_invisible_mark(name)) return "the name contains an invisible control character";
  return std::nullopt;
}

}  // namespace drover::publish
