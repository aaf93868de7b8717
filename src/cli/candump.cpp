#include "cli/candump.h"

#include <algorithm>
#include <cctype>
#include <sstream>

#include "cli/hex.h"

namespace drover::cli {

namespace {

constexpr std::uint32_t kErrorFlag = 0x20000000;  // linux/can.h, as can-utils write it
constexpr std::uint32_t kExtendedMask = 0x1FFFFFFF;

std::optional<Time> parse_stamp(std::string_view text) {
  if (text.size() < 4 || text.front() != '(' || text.back() != ')') return std::nullopt;
  text = text.substr(1, text.size() - 2);
  const auto point = text.find('.');
  if (point == std::string_view::npos) return std::nullopt;
  const auto digits = text.substr(point + 1);
  if (digits.empty() || digits.size() > 9) return std::nullopt;
  std::int64_t seconds = 0;
  std::int64_t fraction = 0;
  const auto read = [](std::string_view from, std::int64_t& into) {
    const auto* end = from.data() + from.size();
    const auto [stop, error] = std::from_chars(from.data(), end, into);
    return error == std::errc() && stop == end && into >= 0;
  };
  if (!read(text.substr(0, point), seconds) || !read(digits, fraction)) return std::nullopt;
  if (seconds > 8'000'000'000) return std::nullopt;  // beyond what nanoseconds hold
  for (auto n = digits.size(); n < 9; ++n) fraction *= 10;
  return Time{Duration{seconds * 1'000'000'000 + fraction}};
}

/// A name that an interface may have, and that does nothing to a terminal.
bool is_bus(std::string_view name) {
  constexpr std::size_t kLongest = 15;  // linux/if.h
  return name.size() <= kLongest &&
         std::all_of(name.begin(), name.end(), [](char c) { return c > 0x20 && c < 0x7F; });
}

bool parse_data(std::string_view hex, CanFrame& frame) {
  if (hex.size() % 2 != 0 || hex.size() / 2 > (frame.fd ? 64U : 8U)) return false;
  for (std::size_t i = 0; i < hex.size(); i += 2) {
    const auto byte = from_hex(hex.substr(i, 2));
    if (!byte) return false;
    frame.data[frame.len++] = static_cast<std::uint8_t>(*byte);
  }
  return true;
}

bool parse_remote(std::string_view length, CanFrame& frame) {
  frame.remote = true;
  if (length.empty()) return true;
  if (length.size() != 1 || length[0] < '0' || length[0] > '8') return false;
  frame.len = static_cast<std::uint8_t>(length[0] - '0');
  return true;
}

std::optional<CanFrame> parse_frame(std::string_view text) {
  const auto hash = text.find('#');
  if (hash != 3 && hash != 8) return std::nullopt;
  const auto id = from_hex(text.substr(0, hash));
  if (!id) return std::nullopt;
  CanFrame frame;
  frame.extended = hash == 8;
  frame.error = frame.extended && (*id & kErrorFlag) != 0;
  frame.id = *id & kExtendedMask;
  if ((!frame.extended && *id > 0x7FF) || (*id & ~(kExtendedMask | kErrorFlag)) != 0)
    return std::nullopt;
  auto rest = text.substr(hash + 1);
  bool good = false;
  if (!rest.empty() && rest.front() == 'R') {
    good = parse_remote(rest.substr(1), frame);
  } else if (!rest.empty() && rest.front() == '#') {
    frame.fd = true;
    good = rest.size() >= 2 && from_hex(rest.substr(1, 1)) && parse_data(rest.substr(2), frame);
  } else {
    good = parse_data(rest, frame);
  }
  if (!good) return std::nullopt;
  return frame;
}

}  // namespace

std::optional<LoggedFrame> parse_candump(std::string_view line) {
  std::istringstream words{std::string(line)};
  std::string stamp;
  std::string bus;
  std::string frame_text;
  if (!(words >> stamp >> bus >> frame_text)) return std::nullopt;
  const auto time = parse_stamp(stamp);
  const auto frame = parse_frame(frame_text);
  if (!time || !frame || !is_bus(bus)) return std::nullopt;
  return LoggedFrame{*time, bus, *frame};
}

}  // namespace drover::cli
