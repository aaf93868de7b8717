// Numbers and texts of a message.
#include <algorithm>
#include <cmath>
#include <utility>

#include "scene/message/check.h"
#include "scene/message/validate.h"
#include "text/number.h"
#include "text/utf8.h"

namespace drover::scene::check {
namespace {

/// One that shows as another line, as nothing, or turns the text around it: C0 and C1 controls,
/// DEL, U+2028, U+2029 and the marks of bidirectional text.
bool is_control(std::string_view character) {
  if (character.size() == 1) return character[0] < 0x20 || character[0] == 0x7F;
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(character[i]); };
  if (character.size() == 2) return (byte(0) == 0xC2 && byte(1) < 0xA0) || character == "\u061C";
  if (character.size() != 3 || byte(0) != 0xE2) return false;
  if (byte(1) == 0x80)
    return byte(2) == 0x8E || byte(2) == 0x8F || (byte(2) >= 0xA8 && byte(2) <= 0xAE);
  return byte(1) == 0x81 && byte(2) >= 0xA6 && byte(2) <= 0xA9;
}

}  // namespace

void note(Notes& notes, std::string whole) {
  if (notes.size() >= kMaxNotes) {
    notes.back() = "and more";
    return;
  }
  notes.push_back(std::move(whole));
}

void note(Notes& notes, const std::string& path, std::string_view text) {
  note(notes, path + ": " + std::string(text));
}

std::string member(const std::string& path, std::string_view name) {
  return path.empty() ? std::string(name) : path + "." + std::string(name);
}

std::string element(const std::string& path, std::size_t index) {
  return path + "[" + std::to_string(index) + "]";
}

Problem number(const std::string& path, double value, double least, double most) {
  if (!std::isfinite(value)) return Refusal{path, "is no finite number"};
  if (value >= least && value <= most) return std::nullopt;
  return Refusal{path, "is " + text::number_text(value) + ": it must be from " +
                           text::number_text(least) + " to " + text::number_text(most)};
}

Problem text(const std::string& path, std::string_view value) {
  if (value.size() > kMaxNameBytes) {
    return Refusal{path, "has " + std::to_string(value.size()) + " bytes, at most " +
                             std::to_string(kMaxNameBytes) + " are allowed"};
  }
  while (!value.empty()) {
    const std::size_t bytes = text::character_bytes(value);
    if (bytes == 0) return Refusal{path, "is no UTF-8"};
    if (is_control(value.substr(0, bytes))) return Refusal{path, "contains a control character"};
    value.remove_prefix(bytes);
  }
  return std::nullopt;
}

Problem name(const std::string& path, std::string_view value) {
  if (value.empty()) return Refusal{path, "is empty: it must be named"};
  return text(path, value);
}

}  // namespace drover::scene::check
