#include "drivers/gt01/serial/codec.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "drivers/thousandths.h"
#include "drover/bytes.h"

namespace drover::gt01::serial {
namespace {

constexpr std::uint16_t kTwistMode = 0;
constexpr std::size_t kMotionData = 8;
constexpr std::size_t kChassisData = 10;
// The documents do not say how wide the docking state is: the packet's length tells.
constexpr std::size_t kUploadWithByte = 17;
constexpr std::size_t kUploadWithWord = 18;

double metres(std::int16_t millimetres) {
  return millimetres / 1000.0;
}

/// Its data; absent when it is no whole packet.
std::optional<std::span<const std::uint8_t>> data_of(std::span<const std::uint8_t> packet) {
  if (packet.size() < kBeforeData + kAfterData || packet.size() > kLongest) return std::nullopt;
  if (packet_size(packet) != packet.size()) return std::nullopt;
  const std::size_t end = packet.size() - kAfterData;
  if (!std::equal(std::begin(kTail), std::end(kTail), packet.end() - 2)) return std::nullopt;
  if (load_le<std::uint16_t>(packet, end) != checksum(packet.first(end))) return std::nullopt;
  return packet.subspan(kBeforeData, end - kBeforeData);
}

std::optional<Report> upload(std::span<const std::uint8_t> data) {
  if (data.size() != kUploadWithByte && data.size() != kUploadWithWord) return std::nullopt;
  const bool word = data.size() == kUploadWithWord;
  Upload out;
  out.voltage_V = load_le<std::uint16_t>(data) / 10.0;
  out.status = load_le<std::uint16_t>(data, 2);
  out.docking = word ? load_le<std::uint16_t>(data, 4) : data[4];
  const auto motion = data.subspan(word ? 6 : 5);
  out.twist = {metres(load_le<std::int16_t>(motion)), load_le<std::int16_t>(motion, 2) / 1000.0};
  for (std::size_t i = 0; i < out.wheels_mps.size(); ++i)
    out.wheels_mps[i] = metres(load_le<std::int16_t>(motion, 4 + 2 * i));
  return out;
}

std::optional<Report> chassis(std::span<const std::uint8_t> data) {
  if (data.size() != kChassisData) return std::nullopt;
  return Chassis{load_le<std::uint16_t>(data) / 1000.0, load_le<std::uint16_t>(data, 2) / 1000.0,
                 load_le<std::uint16_t>(data, 4) / 1000.0, load_le<std::uint16_t>(data, 6),
                 load_le<std::uint16_t>(data, 8)};
}

}  // namespace

std::uint16_t checksum(std::span<const std::uint8_t> bytes) {
  unsigned sum = 0;
  for (const std::uint8_t byte : bytes) sum += byte;
  return static_cast<std::uint16_t>(sum);
}

std::size_t packet_size(std::span<const std::uint8_t> begin) {
  if (begin.size() < kBeforeData || begin[0] != kHead[0] || begin[1] != kHead[1]) return 0;
  if (begin[4] == id::kChassis) return kBeforeData + kChassisData + kAfterData;
  const std::size_t size = begin[5];
  return size < kBeforeData + kAfterData || size > kLongest ? 0 : size;
}

bool is_whole(std::span<const std::uint8_t> packet) {
  return data_of(packet).has_value();
}

std::optional<Report> decode(std::span<const std::uint8_t> packet) {
  const auto data = data_of(packet);
  if (!data) return std::nullopt;
  switch (packet[4]) {
    case id::kUpload: return upload(*data);
    case id::kChassis: return chassis(*data);
    default: return Other{packet[4]};
  }
}

Packet compose(std::uint16_t sequence, std::uint8_t id, std::span<const std::uint8_t> data) {
  Packet out;
  out.resize(kBeforeData + data.size() + kAfterData);
  std::span<std::uint8_t> bytes = out;
  std::copy(std::begin(kHead), std::end(kHead), bytes.begin());
  store_le(bytes, 2, sequence);
  bytes[4] = id;
  bytes[5] = static_cast<std::uint8_t>(bytes.size());
  std::copy(data.begin(), data.end(), bytes.begin() + kBeforeData);
  const std::size_t end = kBeforeData + data.size();
  store_le(bytes, end, checksum(bytes.first(end)));
  std::copy(std::begin(kTail), std::end(kTail), bytes.begin() + end + 2);
  return out;
}

Packet motion(std::uint16_t sequence, const Twist& twist) {
  std::array<std::uint8_t, kMotionData> data{};
  store_le(data, 0, kTwistMode);
  store_le(data, 2, thousandths(twist.vx_mps));
  const auto turn = std::isfinite(twist.wz_radps) ? static_cast<float>(twist.wz_radps) : 0.0F;
  store_le(data, 4, std::bit_cast<std::uint32_t>(turn));
  return compose(sequence, id::kMotion, data);
}

Packet estop(std::uint16_t sequence, bool on) {
  std::array<std::uint8_t, 2> data{};
  store_le<std::uint16_t>(data, 0, on ? 1 : 0);
  return compose(sequence, id::kEstop, data);
}

std::optional<Twist> asked_twist(std::span<const std::uint8_t> packet) {
  const auto data = data_of(packet);
  if (!data || packet[4] != id::kMotion || data->size() != kMotionData) return std::nullopt;
  if (load_le<std::uint16_t>(*data) != kTwistMode) return std::nullopt;
  const auto bits = load_le<std::uint32_t>(*data, 4);
  return Twist{metres(load_le<std::int16_t>(*data, 2)), std::bit_cast<float>(bits)};
}

}  // namespace drover::gt01::serial
