#include "text/control.h"

#include <algorithm>

#include "text/utf8.h"

namespace drover::text {
namespace {

/// A byte that begins no character is one.
std::string_view first_of(std::string_view text) {
  return text.substr(0, std::max<std::size_t>(character_bytes(text), 1));
}

}  // namespace

bool is_control(std::string_view character) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(character[i]); };
  if (character.size() == 1) return byte(0) < 0x20 || byte(0) == 0x7F;
  if (character.size() == 2) return (byte(0) == 0xC2 && byte(1) < 0xA0) || character == "\u061C";
  if (character.size() != 3 || byte(0) != 0xE2) return false;
  if (byte(1) == 0x80)
    return byte(2) == 0x8E || byte(2) == 0x8F || (byte(2) >= 0xA8 && byte(2) <= 0xAE);
  return byte(1) == 0x81 && byte(2) >= 0xA6 && byte(2) <= 0xA9;
}

bool has_control(std::string_view text) {
  while (!text.empty()) {
    const auto character = first_of(text);
    if (is_control(character)) return true;
    text.remove_prefix(character.size());
  }
  return false;
}

std::string harmless(std::string_view text) {
  std::string out;
  out.reserve(text.size());
  while (!text.empty()) {
    const auto character = first_of(text);
    if (is_control(character))
      out += '?';
    else
      out += character;
    text.remove_prefix(character.size());
  }
  return out;
}

}  // namespace drover::text
