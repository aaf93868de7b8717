#include "sim/robot/slcan_text.h"

#include <array>
#include <charconv>
#include <cstdio>

namespace drover::sim {
namespace {

std::optional<std::uint32_t> hex(std::string_view digits) {
  std::uint32_t value = 0;
  const auto result = std::from_chars(digits.data(), digits.data() + digits.size(), value, 16);
  if (digits.empty() || result.ec != std::errc{} || result.ptr != digits.data() + digits.size())
    return std::nullopt;
  return value;
}

}  // namespace

bool append_slcan(std::string& text, const CanFrame& frame) {
  if (frame.fd || frame.error || frame.len > 8) return false;
  std::array<char, 16> head{};
  const char kind = frame.extended ? (frame.remote ? 'R' : 'T') : (frame.remote ? 'r' : 't');
  const int n = std::snprintf(head.data(), head.size(), frame.extended ? "%c%08X%u" : "%c%03X%u",
                              kind, frame.id, static_cast<unsigned>(frame.len));
  text.append(head.data(), static_cast<std::size_t>(n));
  for (std::size_t i = 0; i < frame.len && !frame.remote; ++i) {
    std::array<char, 3> byte{};
    std::snprintf(byte.data(), byte.size(), "%02X", static_cast<unsigned>(frame.data[i]));
    text += byte.data();
  }
  text += '\r';
  return true;
}

std::optional<CanFrame> parse_slcan(std::string_view line) {
  if (line.empty() || std::string_view("tTrR").find(line[0]) == std::string_view::npos)
    return std::nullopt;
  CanFrame frame;
  frame.extended = line[0] == 'T' || line[0] == 'R';
  frame.remote = line[0] == 'r' || line[0] == 'R';
  const std::size_t id_digits = frame.extended ? 8 : 3;
  if (line.size() < id_digits + 2) return std::nullopt;
  const auto id = hex(line.substr(1, id_digits));
  const char length = line[1 + id_digits];
  if (!id || *id > (frame.extended ? 0x1FFFFFFFU : 0x7FFU) || length < '0' || length > '8')
    return std::nullopt;
  frame.id = *id;
  frame.len = static_cast<std::uint8_t>(length - '0');
  const auto data = line.substr(id_digits + 2);
  if (data.size() != (frame.remote ? 0U : 2U * frame.len)) return std::nullopt;
  for (std::size_t i = 0; i < data.size() / 2; ++i) {
    const auto byte = hex(data.substr(2 * i, 2));
    if (!byte) return std::nullopt;
    frame.data[i] = static_cast<std::uint8_t>(*byte);
  }
  return frame;
}

}  // namespace drover::sim
