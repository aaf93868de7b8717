// Writes JSON text: commas, escapes and numbers that read back to the same bits.
#include "json/json_text.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include "text/utf8.h"

namespace drover::json {
namespace {

void append_control(std::string& out, unsigned char c) {
  constexpr std::string_view kHex = "0123456789abcdef";
  out += "\\u00";
  out += kHex[c >> 4U];
  out += kHex[c & 0xFU];
}

}  // namespace

void JsonText::separate() {
  if (comma_) out_ += ',';
  comma_ = true;
}

JsonText& JsonText::open(char bracket) {
  separate();
  out_ += bracket;
  comma_ = false;
  return *this;
}

JsonText& JsonText::close(char bracket) {
  out_ += bracket;
  comma_ = true;
  return *this;
}

JsonText& JsonText::key(std::string_view name) {
  text(name);
  out_ += ':';
  comma_ = false;
  return *this;
}

JsonText& JsonText::text(std::string_view value) {
  separate();
  out_ += '"';
  const auto plain = [](char c) { return c >= 0x20 && c < 0x7F && c != '"' && c != '\\'; };
  while (!value.empty()) {
    const auto* const end = std::find_if_not(value.begin(), value.end(), plain);
    out_.append(value.begin(), end);
    value.remove_prefix(static_cast<std::size_t>(end - value.begin()));
    if (value.empty()) break;
    const auto c = static_cast<unsigned char>(value.front());
    const std::size_t length = text::character_bytes(value);
    if (c == '"' || c == '\\') {
      out_ += '\\';
      out_ += value.front();
    } else if (c < 0x20 || c == 0x7F) {
      append_control(out_, c);
    } else if (length == 0) {
      out_ += "\xEF\xBF\xBD";
    } else {
      out_ += value.substr(0, length);
    }
    value.remove_prefix(length == 0 ? 1 : length);
  }
  out_ += '"';
  return *this;
}

JsonText& JsonText::boolean(bool value) {
  separate();
  out_ += value ? "true" : "false";
  return *this;
}

JsonText& JsonText::integer(std::int64_t value) {
  separate();
  out_ += std::to_string(value);
  return *this;
}

JsonText& JsonText::number(double value) {
  separate();
  if (!std::isfinite(value)) value = 0;
  std::array<char, 40> digits{};
  auto* const end = digits.data() + digits.size();
  // Digits alone are an integer to who reads them, and beyond 64 bits they are none.
  const bool large = std::abs(value) >= 0x1p63;
  const auto done = large ? std::to_chars(digits.data(), end, value, std::chars_format::scientific)
                          : std::to_chars(digits.data(), end, value);
  out_.append(digits.data(), done.ptr);
  return *this;
}

JsonText& JsonText::number(double value, int decimals) {
  if (!std::isfinite(value) || std::abs(value) >= 1e15) return number(value);
  separate();
  std::array<char, 40> digits{};
  const auto done = std::to_chars(digits.data(), digits.data() + digits.size(), value,
                                  std::chars_format::fixed, decimals);
  std::string_view text(digits.data(), static_cast<std::size_t>(done.ptr - digits.data()));
  if (text.find('.') != text.npos) {
    text.remove_suffix(text.size() - 1 - text.find_last_not_of('0'));
    if (text.ends_with('.')) text.remove_suffix(1);
  }
  out_ += text == "-0" ? "0" : text;
  return *this;
}

JsonText& JsonText::spelled_number(std::string_view digits) {
  separate();
  out_ += digits;
  return *this;
}

JsonText& JsonText::null() {
  separate();
  out_ += "null";
  return *this;
}

JsonText& JsonText::newline() {
  out_ += '\n';
  return *this;
}

}  // namespace drover::json
