#include "drivers/nmea0183/twin_faults.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "drivers/nmea0183/fields.h"
#include "drover/angle.h"

namespace drover::nmea0183 {
namespace {

constexpr double kMaxDelay_ms = 2000;
constexpr double kUsualBacklog_s = 0.4;

/// "name", "name:1", "name:1:2": up to two numbers.
struct StateText {
  std::string_view name;
  std::size_t count = 0;
  std::array<double, 2> numbers{};
};

std::optional<StateText> split_state(std::string_view text) {
  StateText state;
  auto colon = text.find(':');
  state.name = text.substr(0, colon);
  while (colon != std::string_view::npos) {
    text.remove_prefix(colon + 1);
    colon = text.find(':');
    const auto value = parse_decimal(text.substr(0, colon));
    if (!value || state.count == state.numbers.size()) return std::nullopt;
    state.numbers[state.count++] = *value;
  }
  return state;
}

Offset along(double length, double direction_deg) {
  const double direction_rad = to_rad(direction_deg);
  return {length * std::cos(direction_rad), length * std::sin(direction_rad)};
}

}  // namespace

Offset PositionDrift::at(Time t) const {
  const double drifting_s = since == kNever ? 0 : std::max(0.0, to_s(t - since));
  return {from.east_m + drifting_s * east_mps, from.north_m + drifting_s * north_mps};
}

Duration TwinFaults::delay(Time now) const {
  if (backlog_growth == 0) return lag;
  const double grown_s = backlog_growth * to_s(now - backlog_since);
  return lag + std::min(backlog_most, from_s(grown_s));
}

bool TwinFaults::set(std::string_view text, Time now, double ahead_deg) {
  const auto state = split_state(text);
  if (!state) return false;
  const auto& [name, count, numbers] = *state;
  if (count == 0) return set_word(name, now);
  if (name == "backlog" && numbers[0] >= 0 && numbers[0] <= 1000) {
    const double most_s = count == 2 ? numbers[1] : kUsualBacklog_s;
    if (!(most_s > 0 && most_s * 1e3 <= kMaxDelay_ms)) return false;
    backlog_growth = numbers[0] * 1e-3;
    backlog_most = from_s(most_s);
    backlog_since = now;
    return true;
  }
  // Counter-clockwise from east. To the robot's left is a quarter turn from where it points.
  const double left_deg = 180 - ahead_deg;
  if (name == "jump" || name == "drift") return set_place(name, numbers[0], numbers[1], now);
  if (count == 1 && name == "jump_aside") return set_place("jump", numbers[0], left_deg, now);
  if (count == 1 && name == "drift_aside") return set_place("drift", numbers[0], left_deg, now);
  return count == 1 && set_number(name, numbers[0]);
}

bool TwinFaults::set_word(std::string_view name, Time now) {
  if (name == "silent")
    output = Output::silent;
  else if (name == "garbage")
    output = Output::garbage;
  else if (name == "stuck")
    stuck = true;
  else if (name == "corrections_lost")
    corrections_lost_at = now;
  else if (name == "heading_flip")
    heading_flip = true;
  else if (name == "heading_lost")
    heading_lost = true;
  else if (name == "gst_lost")
    gst_lost = true;
  else if (name == "drift_stays")
    drift = {drift.at(now), 0, 0, now};
  else if (name == "clear")
    *this = TwinFaults{};
  else
    return false;
  return true;
}

bool TwinFaults::set_number(std::string_view name, double value) {
  const bool is_delay = value >= 0 && value <= kMaxDelay_ms;
  if (name == "bad_checksum" && (value == 0 || value >= 1)) {
    bad_checksum_one_in = value;
  } else if (name == "lag" && is_delay) {
    lag = from_s(value * 1e-3);
  } else if (name == "stamp_late" && is_delay) {
    stamp_late = from_s(value * 1e-3);
  } else if (name == "heading_epoch" && value <= 0 && value * -1e3 <= kMaxDelay_ms) {
    heading_epoch = from_s(value);
  } else if (name == "heading_off" && std::abs(value) <= 180) {
    heading_off_deg = value;
  } else if (name == "rate" && value >= 0.2 && value <= 20) {
    rate_Hz = value;
  } else if (name == "speed_noise" && value >= 0 && value <= 10) {
    speed_noise_mps = value;
  } else {
    return false;
  }
  return true;
}

bool TwinFaults::set_place(std::string_view name, double value, double direction_deg, Time now) {
  if (name == "jump") {
    jump = along(value, direction_deg);
    return true;
  }
  const Offset rate = along(value * 1e-3, direction_deg);
  if (value == 0)
    drift = PositionDrift{};
  else
    drift = {drift.at(now), rate.east_m, rate.north_m, now};
  return true;
}

}  // namespace drover::nmea0183
