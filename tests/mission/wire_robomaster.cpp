// All values are big endian.
#include "mission/wire_robomaster.h"

#include <algorithm>
#include <cstdlib>

namespace drover::mission::robomaster {
namespace {

constexpr std::uint32_t kCommand = 0x200;  // and what the motors tell is 201 to 204
constexpr float kCountsPerA = 819.2F;
// What a geared M3508 needs to go on turning; and what the friction of robomaster.xml's wheels,
// 0.13 Nm, needs to begin to: a real one needs twice as much.
constexpr int kRunning = 124;
constexpr int kBegins = 355;

// Of the rotor: slower than 0.1 rad/s behind the gear of 19 a wheel stands.
constexpr int kStands_rpm = 18;
constexpr int kAnglesPerTurn = 8192;
constexpr int kAway = 50;  // 2 mrad behind the gear

int word_at(const CanFrame& frame, std::size_t at) {
  const int value = frame.data[at] * 256 + frame.data[at + 1];
  return value < 0x8000 ? value : value - 0x10000;
}

bool is_plain(const CanFrame& frame) {
  return !frame.extended && !frame.remote && !frame.error && !frame.fd && frame.len == 8;
}

bool is_command(const CanFrame& frame) {
  return is_plain(frame) && frame.id == kCommand;
}

}  // namespace

void Bus::take(Told& told, int angle, int rpm) {
  const int gone = (angle - told.angle + kAnglesPerTurn * 3 / 2) % kAnglesPerTurn;
  told.away += gone - kAnglesPerTurn / 2;
  told.angle = angle;
  told.rpm = rpm;
}

/// What was pushed away, and is let back by those who pushed, turns with the current that held it.
/// That one is beyond where it was when that current began: it has not come back so far.
bool Bus::drives(Told& told, int counts) {
  if (!(counts * told.counts > 0)) told.away = 0;
  told.counts = counts;
  const bool held =
      std::abs(told.rpm) <= kStands_rpm && std::abs(told.away) >= kAway && counts * told.away < 0;
  if (held) return false;
  if (told.rpm == 0) return std::abs(counts) >= kBegins;
  return counts * told.rpm > 0 && std::abs(counts) >= kRunning;
}

std::optional<std::array<float, kMotors>> Bus::drives_A(const CanFrame& frame) {
  if (is_plain(frame) && frame.id > kCommand && frame.id <= kCommand + kMotors)
    take(told_.at(frame.id - kCommand - 1), frame.data[0] * 256 + frame.data[1], word_at(frame, 2));
  if (!is_command(frame)) return std::nullopt;
  std::array<float, kMotors> drives_A{};
  for (std::size_t i = 0; i < kMotors; ++i) {
    const int counts = word_at(frame, 2 * i);
    if (drives(told_.at(i), counts)) drives_A.at(i) = static_cast<float>(counts) / kCountsPerA;
  }
  return drives_A;
}

bool is_zero(const CanFrame& frame) {
  return is_command(frame) && std::all_of(frame.data.begin(), frame.data.begin() + frame.len,
                                          [](std::uint8_t byte) { return byte == 0; });
}

std::string forbidden(const CanFrame& frame) {
  if (frame.error) return "an error frame";
  if (frame.extended || frame.fd || frame.remote) return "no plain 11-bit frame";
  if (frame.id < kCommand || frame.id > kCommand + kMotors) return "no id of this robot";
  if (frame.len != 8) return "a frame of another length";
  if (frame.id != kCommand) return {};
  for (std::size_t i = 0; i < kMotors; ++i)
    if (std::abs(word_at(frame, 2 * i)) > 16384) return "more than a controller takes";
  return {};
}

}  // namespace drover::mission::robomaster
