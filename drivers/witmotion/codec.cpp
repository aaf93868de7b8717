#include "drivers/witmotion/codec.h"

#include <cmath>
#include <cstdlib>
#include <numeric>

#include "drover/angle.h"
#include "drover/bytes.h"

namespace drover::witmotion {
namespace {

constexpr double kWordRange = 32768;
constexpr double kAccelerationRange_mps2 = 16 * kGravity_mps2;
constexpr double kRateRange_radps = 2000 * kPi / 180;
// A channel that clips need not reach the very last count.
constexpr int kSaturated = 32700;

struct Rate {
  std::uint16_t code;
  double rate_Hz;
};
constexpr Rate kRates[] = {{1, 0.2}, {2, 0.5}, {3, 1},   {4, 2},    {5, 5},   {6, 10},
                           {7, 20},  {8, 50},  {9, 100}, {10, 125}, {11, 200}};

struct Baud {
  std::uint16_t code;
  std::uint32_t baud;
};
constexpr Baud kBauds[] = {{1, 4800},   {2, 9600},   {3, 19200},  {4, 38400}, {5, 57600},
                           {6, 115200}, {7, 230400}, {8, 460800}, {9, 921600}};

constexpr double kBandwidths_Hz[] = {256, 184, 94, 44, 21, 10, 5};  // by code

class Reader {
 public:
  explicit Reader(std::span<const std::uint8_t> frame) : bytes_(frame.subspan(2)) {}
  std::uint8_t byte(std::size_t i) const { return bytes_[i]; }
  std::uint16_t unsigned_word(std::size_t i) const { return load_le<std::uint16_t>(bytes_, 2 * i); }
  std::int16_t word(std::size_t i) const { return load_le<std::int16_t>(bytes_, 2 * i); }
  Words words(std::size_t from) const { return {word(from), word(from + 1), word(from + 2)}; }
  std::uint32_t unsigned_long(std::size_t i) const { return load_le<std::uint32_t>(bytes_, 4 * i); }
  std::int32_t long_word(std::size_t i) const {
    return static_cast<std::int32_t>(unsigned_long(i));
  }

 private:
  std::span<const std::uint8_t> bytes_;
};

Vector3 scaled(const Words& raw, double range) {
  const double unit = range / kWordRange;
  return {raw[0] * unit, raw[1] * unit, raw[2] * unit};
}

double temperature_degC(std::int16_t word) {
  return word / 100.0;
}

Acceleration acceleration(const Words& raw, double at_degC) {
  return {scaled(raw, kAccelerationRange_mps2), raw, at_degC};
}
AngularRate angular_rate(const Words& raw) {
  return {scaled(raw, kRateRange_radps), raw};
}
Angles angles(const Words& raw, std::uint16_t version) {
  const Vector3 rad = scaled(raw, kPi);
  return {rad.x, rad.y, rad.z, raw, version};
}

// Whole degrees times ten million, and minutes times a hundred thousand in what is left.
double coordinate_deg(std::int32_t value) {
  constexpr std::int32_t kDegree = 10'000'000;
  const std::int32_t degrees = value / kDegree;
  return degrees + value % kDegree / 1e5 / 60;
}

Attitude attitude(const Reader& r) {
  Attitude out;
  for (std::size_t i = 0; i < 4; ++i) out.raw[i] = r.word(i);
  out.orientation = {out.raw[0] / kWordRange, out.raw[1] / kWordRange, out.raw[2] / kWordRange,
                     out.raw[3] / kWordRange};
  return out;
}

Report standard(FrameType type, const Reader& r) {
  switch (type) {
    case FrameType::clock:
      return Clock{2000 + r.byte(0), r.byte(1), r.byte(2),         r.byte(3),
                   r.byte(4),        r.byte(5), r.unsigned_word(3)};
    case FrameType::acceleration: return acceleration(r.words(0), temperature_degC(r.word(3)));
    case FrameType::angular_rate: return angular_rate(r.words(0));
    case FrameType::angles: return angles(r.words(0), r.unsigned_word(3));
    case FrameType::magnetic_field: return MagneticField{r.words(0), temperature_degC(r.word(3))};
    case FrameType::pressure:
      return Pressure{static_cast<double>(r.long_word(0)), r.long_word(1) / 100.0};
    case FrameType::gps_position:
      return GpsPosition{coordinate_deg(r.long_word(0)), coordinate_deg(r.long_word(1))};
    case FrameType::gps_motion:
      return GpsMotion{r.word(0) / 10.0, r.word(1), r.unsigned_long(1) / 1000.0 / 3.6};
    case FrameType::quaternion: return attitude(r);
    case FrameType::gps_accuracy:
      return GpsAccuracy{r.unsigned_word(0), r.unsigned_word(1) / 100.0, r.unsigned_word(2) / 100.0,
                         r.unsigned_word(3) / 100.0};
    case FrameType::registers:
      return Registers{
          {r.unsigned_word(0), r.unsigned_word(1), r.unsigned_word(2), r.unsigned_word(3)}};
    case FrameType::ports:
    case FrameType::combined:
    case FrameType::combined_registers: break;
  }
  return Ports{{r.unsigned_word(0), r.unsigned_word(1), r.unsigned_word(2), r.unsigned_word(3)}};
}

}  // namespace

bool is_standard_type(std::uint8_t type) {
  return (type >= 0x50 && type <= 0x5A) || type == 0x5F;
}
bool is_combined_type(std::uint8_t type) {
  return type == 0x61 || type == 0x71;
}

std::uint8_t checksum(std::span<const std::uint8_t> before) {
  return static_cast<std::uint8_t>(std::accumulate(before.begin(), before.end(), 0U));
}

std::optional<Report> decode(std::span<const std::uint8_t> frame) {
  if (frame.size() < kFrameSize || frame[0] != kHeader) return std::nullopt;
  const auto type = static_cast<FrameType>(frame[1]);
  const Reader r(frame);
  if (frame.size() == kFrameSize && is_standard_type(frame[1]) &&
      checksum(frame.first(kFrameSize - 1)) == frame.back())
    return standard(type, r);
  if (frame.size() == kCombinedFrameSize && type == FrameType::combined)
    return Combined{acceleration(r.words(0), kAbsent), angular_rate(r.words(3)),
                    angles(r.words(6), 0)};
  return std::nullopt;
}

bool is_saturated(const Words& words) {
  for (const int word : words)
    if (std::abs(word) >= kSaturated) return true;
  return false;
}

Command write_register(Register address, std::uint16_t value) {
  return {0xFF, 0xAA, static_cast<std::uint8_t>(address), low_byte(value), high_byte(value)};
}
Command read_registers(Register first) {
  return write_register(Register::read, static_cast<std::uint8_t>(first));
}

std::optional<std::uint16_t> rate_code(double rate_Hz) {
  for (const Rate& rate : kRates)
    if (std::abs(rate.rate_Hz - rate_Hz) < 1e-6) return rate.code;
  return std::nullopt;
}
std::optional<double> rate_Hz(std::uint16_t code) {
  for (const Rate& rate : kRates)
    if (rate.code == code) return rate.rate_Hz;
  return std::nullopt;
}
std::optional<std::uint16_t> baud_code(std::uint32_t baud) {
  for (const Baud& each : kBauds)
    if (each.baud == baud) return each.code;
  return std::nullopt;
}
std::optional<std::uint32_t> baud_of(std::uint16_t code) {
  for (const Baud& each : kBauds)
    if (each.code == code) return each.baud;
  return std::nullopt;
}
std::uint16_t bandwidth_code(double bandwidth_Hz) {
  std::size_t code = 0;
  for (std::size_t i = 0; i < std::size(kBandwidths_Hz); ++i)
    if (kBandwidths_Hz[i] >= bandwidth_Hz) code = i;
  return static_cast<std::uint16_t>(code);
}

}  // namespace drover::witmotion
