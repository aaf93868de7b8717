// Strict: a line that another program would read differently is an error here.
#include "mission/log_lines.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <stdexcept>

namespace drover::mission {
namespace {

constexpr std::array<std::string_view, 8> kTruthNames{
    "time_s", "x_m", "y_m", "z_m", "yaw_rad", "vx_mps", "free_ahead_m", "wz_radps"};

[[noreturn]] void fail(const char* what, std::string_view line) {
  throw std::runtime_error(std::string(what) + " in '" + std::string(line.substr(0, 120)) + "'");
}

template <typename T, typename... Base>
T number(std::string_view text, std::string_view line, Base... base) {
  T value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value, base...);
  if (text.empty() || error != std::errc{} || end != text.data() + text.size())
    fail("no number", line);
  return value;
}

/// "(seconds.nnnnnnnnn) ", taken off the front of `rest`.
Time take_stamp(std::string_view& rest, std::string_view line) {
  const auto dot = rest.find('.');
  if (rest.empty() || rest[0] != '(' || dot == std::string_view::npos || rest.size() < dot + 12 ||
      rest.substr(dot + 10, 2) != ") ")
    fail("no stamp", line);
  const auto s = number<std::int64_t>(rest.substr(1, dot - 1), line);
  const auto ns = number<std::int64_t>(rest.substr(dot + 1, 9), line);
  rest.remove_prefix(dot + 12);
  return Time{std::chrono::seconds(s) + Duration(ns)};
}

std::string_view take_word(std::string_view& rest, std::string_view line) {
  const auto end = rest.find(' ');
  if (end == 0 || end == std::string_view::npos) fail("a word is missing", line);
  const auto word = rest.substr(0, end);
  rest.remove_prefix(end + 1);
  return word;
}

std::vector<std::string_view> split(std::string_view line) {
  std::vector<std::string_view> cells;
  for (;;) {
    const auto comma = std::min(line.find(','), line.size());
    cells.push_back(line.substr(0, comma));
    if (comma == line.size()) return cells;
    line.remove_prefix(comma + 1);
  }
}

void parse_payload(std::string_view text, CanFrame& frame, std::string_view line) {
  if (!text.empty() && text[0] == 'R') {
    frame.remote = true;
    if (text.size() > 1) frame.len = number<std::uint8_t>(text.substr(1), line);
    if (frame.len > 8) fail("a remote frame of more than 8 bytes", line);
    return;
  }
  const std::size_t limit = frame.fd ? 64 : 8;
  if (text.size() % 2 != 0 || text.size() / 2 > limit) fail("bytes of odd length", line);
  for (std::size_t at = 0; at < text.size(); at += 2)
    frame.data[frame.len++] = number<std::uint8_t>(text.substr(at, 2), line, 16);
}

}  // namespace

CanLine parse_can_line(std::string_view line) {
  constexpr std::uint32_t kErrorFlag = 0x20000000U;
  std::string_view rest = line;
  CanLine parsed;
  parsed.time = take_stamp(rest, line);
  parsed.bus = take_word(rest, line);
  const auto hash = rest.find('#');
  if (hash != 3 && hash != 8) fail("no identifier", line);
  parsed.frame.id = number<std::uint32_t>(rest.substr(0, hash), line, 16);
  parsed.frame.extended = hash == 8;
  if (hash == 8 && (parsed.frame.id & kErrorFlag) != 0) {
    parsed.frame.id &= ~kErrorFlag;
    parsed.frame.error = true;
    parsed.frame.extended = false;
  }
  rest.remove_prefix(hash + 1);
  if (rest.starts_with('#')) {
    if (rest.size() < 2) fail("no flags of a CAN FD frame", line);
    parsed.frame.fd = true;
    rest.remove_prefix(2);
  }
  parse_payload(rest, parsed.frame, line);
  return parsed;
}

MqttLine parse_mqtt_line(std::string_view line) {
  std::string_view rest = line;
  MqttLine parsed;
  parsed.time = take_stamp(rest, line);
  parsed.topic = take_word(rest, line);
  const auto retained = take_word(rest, line);
  if (retained != "0" && retained != "1") fail("retained is neither 0 nor 1", line);
  parsed.retained = retained == "1";
  parsed.payload = rest;
  return parsed;
}

EventLine parse_event_line(std::string_view line) {
  std::string_view rest = line;
  EventLine parsed;
  parsed.time = take_stamp(rest, line);
  if (rest.empty()) fail("no text", line);
  parsed.text = rest;
  return parsed;
}

LevelLine parse_level_line(std::string_view line) {
  std::string_view rest = line;
  LevelLine parsed;
  parsed.time = take_stamp(rest, line);
  parsed.name = take_word(rest, line);
  if (rest != "0" && rest != "1" && rest != "-") fail("no level", line);
  if (rest != "-") parsed.high = rest == "1";
  return parsed;
}

TruthColumns::TruthColumns(std::string_view header) {
  const auto names = split(header);
  count_ = names.size();
  for (const auto wanted : kTruthNames) {
    const auto at = std::find(names.begin(), names.end(), wanted);
    if (at == names.end()) fail(("no column " + std::string(wanted)).c_str(), header);
    columns_.push_back(static_cast<std::size_t>(at - names.begin()));
  }
  // Behind the supply come the joints of an arm.
  const auto supply = std::find(names.begin(), names.end(), "supply");
  for (auto at = supply; at != names.end(); ++at) {
    const auto column = static_cast<std::size_t>(at - names.begin());
    if (at->ends_with("_rad")) arm_.push_back(column);
    if (at->ends_with("_Nm")) arm_torques_.push_back(column);
  }
}

TruthLine TruthColumns::parse(std::string_view line) const {
  const auto cells = split(line);
  if (cells.size() != count_) fail("another number of cells than the header", line);
  std::array<double, kTruthNames.size()> values{};
  for (std::size_t i = 0; i < values.size(); ++i) {
    values[i] = number<double>(cells[columns_[i]], line);
    if (!std::isfinite(values[i])) fail("not finite", line);
  }
  TruthLine truth{Time{from_s(values[0])},
                  values[1],
                  values[2],
                  values[3],
                  values[4],
                  values[5],
                  values[6],
                  values[7],
                  {},
                  {}};
  for (const std::size_t column : arm_)
    truth.arm_rad.push_back(number<double>(cells[column], line));
  for (const std::size_t column : arm_torques_)
    truth.arm_Nm.push_back(number<double>(cells[column], line));
  return truth;
}

}  // namespace drover::mission
