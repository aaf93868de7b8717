// Numbers and texts of a message.
#include <algorithm>
#include <cmath>
#include <utility>

#include "scene/message/check.h"
#include "scene/message/validate.h"
#include "text/number.h"

namespace drover::scene::check {
namespace {

/// Length of the UTF-8 character at the front, 0 when there is none (RFC 3629). DDS checks nothing.
std::size_t character_bytes(std::string_view value) {
  const auto byte = [&](std::size_t i) {
    return i < value.size() ? static_cast<unsigned char>(value[i]) : 0U;
  };
  const auto follows = [&](std::size_t i) { return (byte(i) & 0xC0U) == 0x80U; };
  const unsigned first = byte(0);
  if (first < 0x80) return 1;
  if (first >= 0xC2 && first <= 0xDF) return follows(1) ? 2 : 0;
  const bool short_form = (first == 0xE0 && byte(1) < 0xA0) || (first == 0xF0 && byte(1) < 0x90);
  const bool beyond = (first == 0xED && byte(1) > 0x9F) || (first == 0xF4 && byte(1) > 0x8F);
  if (short_form || beyond || !follows(1) || !follows(2)) return 0;
  if (first >= 0xE0 && first <= 0xEF) return 3;
  return first >= 0xF0 && first <= 0xF4 && follows(3) ? 4 : 0;
}

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
    const std::size_t bytes = character_bytes(value);
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
