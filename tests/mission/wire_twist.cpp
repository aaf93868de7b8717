#include "mission/wire_twist.h"

#include <bit>
#include <cmath>
#include <fstream>
#include <sstream>

#include "mission/wire_bytes.h"

namespace drover::mission {
namespace {

bool plain(const CanFrame& frame) {
  return !frame.extended && !frame.remote && !frame.error && !frame.fd;
}

double thousandths(unsigned high, unsigned low) {
  return static_cast<std::int16_t>(high << 8U | low) / 1000.0;
}

}  // namespace

namespace gt01 {
namespace {

/// A twist: ED DE, sequence, 02, 12 (length), mode 0, v mm/s, w float, sum, BD BC.
std::optional<Asked> read_twist(const std::vector<std::uint8_t>& b, std::size_t at) {
  constexpr std::size_t kSize = 18;
  if (b.size() - at < kSize || b[at] != 0xED || b[at + 1] != 0xDE || b[at + 4] != 0x02 ||
      b[at + 5] != kSize || b[at + 6] != 0 || b[at + 7] != 0 || b[at + 16] != 0xBD ||
      b[at + 17] != 0xBC)
    return std::nullopt;
  const auto word = [&](std::size_t i) {
    return static_cast<std::uint16_t>(b[at + i] | b[at + i + 1] << 8U);
  };
  unsigned sum = 0;
  for (std::size_t i = 0; i < 14; ++i) sum += b[at + i];
  if ((sum & 0xFFFFU) != word(14)) return std::nullopt;
  const auto bits = static_cast<std::uint32_t>(word(10)) | static_cast<std::uint32_t>(word(12))
                                                               << 16U;
  Asked asked;
  asked.sequence = word(2);
  asked.twist = {static_cast<std::int16_t>(word(8)) / 1000.0, std::bit_cast<float>(bits)};
  return asked;
}

}  // namespace

Line read_line(const std::filesystem::path& folder) {
  std::ifstream file(folder / "serial.log");
  std::vector<std::uint8_t> bytes;
  std::vector<Time> times;
  std::string text;
  while (std::getline(file, text)) {
    std::istringstream words(text);
    std::string stamp;
    std::string port;
    std::string digits;
    words >> stamp >> port >> digits;
    const Time time{from_s(std::stod(stamp.substr(1)))};
    for (std::size_t i = 0; i + 1 < digits.size(); i += 2) {
      bytes.push_back(static_cast<std::uint8_t>(std::stoi(digits.substr(i, 2), nullptr, 16)));
      times.push_back(time);
    }
  }
  Line line;
  for (std::size_t at = 0; at < bytes.size();) {
    auto asked = read_twist(bytes, at);
    if (!asked) {
      ++line.strange;
      ++at;
      continue;
    }
    at += 18;
    asked->time = times[at - 1];
    line.packets.push_back(*asked);
  }
  return line;
}

/// 01: 01 01, v in mm/s, w in 0.001 rad/s, highest byte first, two zeros.
std::optional<TwistCommand> twist_command(const CanFrame& frame) {
  if (!plain(frame) || frame.id != 0x01 || frame.len != 8) return std::nullopt;
  const auto& data = frame.data;
  return TwistCommand{thousandths(data[2], data[3]), thousandths(data[4], data[5])};
}

std::string forbidden(const CanFrame& frame) {
  if (!plain(frame)) return "no plain 11-bit frame";
  constexpr std::uint32_t kTold[] = {0x10, 0x11, 0x12, 0x20, 0x30, 0x41};
  if (has(kTold, frame.id)) return frame.len == 8 ? "" : "a chassis' frame of another length";
  if (frame.id != 0x01) return "no id of this robot";
  const auto& data = frame.data;
  if (frame.len != 8 || data[0] != 1 || data[1] != 1) return "a command that is no twist";
  return (data[6] | data[7]) == 0 ? "" : "a twist with something behind it";
}

}  // namespace gt01

namespace agilex_v2 {

/// 0x111: v in mm/s, w in mrad/s, highest byte first, then zeros.
std::optional<TwistCommand> twist_command(const CanFrame& frame) {
  if (!plain(frame) || frame.id != 0x111 || frame.len != 8) return std::nullopt;
  const auto& data = frame.data;
  return TwistCommand{thousandths(data[0], data[1]), thousandths(data[2], data[3])};
}

std::string forbidden(const CanFrame& frame) {
  if (frame.extended && !frame.remote && !frame.error && !frame.fd) {
    constexpr std::uint32_t kSensor[] = {0x0CFF3408, 0x0CFF3708, 0x0CFF4608};
    return has(kSensor, frame.id) ? "" : "no id of this robot";
  }
  if (!plain(frame)) return "no plain frame";
  const auto& data = frame.data;
  switch (frame.id) {
    case 0x111:
      return frame.len == 8 && (data[4] | data[5] | data[6] | data[7]) == 0 ? "" : "no plain twist";
    case 0x421: return frame.len == 1 && data[0] <= 1 ? "" : "neither standby nor CAN";
    default: break;
  }
  // 0x2xx and 0x3xx are the chassis' own.
  return frame.id >= 0x200 && frame.id < 0x400 ? "" : "no id of this robot";
}

}  // namespace agilex_v2

namespace hunter {

std::optional<double> steering_rad(const CanFrame& frame) {
  if (!plain(frame) || frame.id != 0x111 || frame.len != 8) return std::nullopt;
  return thousandths(frame.data[6], frame.data[7]);
}

/// 0x111: v in mm/s, and the angle of the inner wheel in mrad. Of 0.65 m between the axles and
/// 0.605 m between the wheels.
std::optional<TwistCommand> twist_command(const CanFrame& frame) {
  const auto angle_rad = steering_rad(frame);
  if (!angle_rad) return std::nullopt;
  const double v_mps = thousandths(frame.data[0], frame.data[1]);
  const double inner_m = *angle_rad == 0 ? 1e9 : 0.65 / std::tan(std::abs(*angle_rad));
  return TwistCommand{v_mps, std::copysign(v_mps / (inner_m + 0.3025), v_mps * *angle_rad)};
}

/// Its own brake beside what a Scout hears; a steering angle beyond 0.576 rad is none of its.
std::string forbidden(const CanFrame& frame) {
  if (plain(frame) && frame.id == 0x131)
    return frame.len == 1 && frame.data[0] <= 1 ? "" : "neither locks nor releases its brake";
  if (plain(frame) && frame.id == 0x111) {
    if (frame.len != 8) return "no whole command";
    const auto& data = frame.data;
    if ((data[2] | data[3] | data[4] | data[5]) != 0) return "a turn or a way aside of its own";
    return std::abs(*steering_rad(frame)) <= 0.5765 ? "" : "steered too far";
  }
  return agilex_v2::forbidden(frame);
}

}  // namespace hunter

}  // namespace drover::mission
