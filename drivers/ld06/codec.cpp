#include "drivers/ld06/codec.h"

#include "drover/bytes.h"

namespace drover::ld06 {
namespace {

// Where the fields begin.
constexpr std::size_t kSpeedAt = 2;
constexpr std::size_t kStartAt = 4;
constexpr std::size_t kBeamsAt = 6;
constexpr std::size_t kBeamSize = 3;
constexpr std::size_t kEndAt = kBeamsAt + kBeams * kBeamSize;
constexpr std::size_t kStampAt = kEndAt + 2;
constexpr std::size_t kSumAt = kStampAt + 2;
static_assert(kSumAt + 1 == kPacketSize);

// Eleven steps of 2.7 degrees: a motor at 33 Hz, three times as fast as any that works.
constexpr int kMaxSpan_cdeg = 3000;

constexpr std::array<std::uint8_t, 256> kSums = [] {
  std::array<std::uint8_t, 256> sums{};
  for (unsigned i = 0; i < sums.size(); ++i) {
    unsigned crc = i;
    for (int bit = 0; bit < 8; ++bit) crc = (crc & 0x80U) != 0 ? (crc << 1U) ^ 0x4DU : crc << 1U;
    sums[i] = static_cast<std::uint8_t>(crc & 0xFFU);
  }
  return sums;
}();

}  // namespace

int span_cdeg(const Slice& slice) {
  return (slice.end_cdeg - slice.start_cdeg + kTurn_cdeg) % kTurn_cdeg;
}

std::uint8_t crc8(std::span<const std::uint8_t> bytes) {
  std::uint8_t crc = 0;
  for (const std::uint8_t byte : bytes) crc = kSums[crc ^ byte];
  return crc;
}

Result<Slice, Fault> decode(std::span<const std::uint8_t> bytes) {
  if (bytes.size() != kPacketSize) return Fault::length;
  if (bytes[0] != kHeader || bytes[1] != kKind) return Fault::header;
  if (crc8(bytes.first(kSumAt)) != bytes[kSumAt]) return Fault::checksum;
  Slice slice;
  slice.speed_degps = load_le<std::uint16_t>(bytes, kSpeedAt);
  slice.start_cdeg = load_le<std::uint16_t>(bytes, kStartAt);
  slice.end_cdeg = load_le<std::uint16_t>(bytes, kEndAt);
  slice.stamp_ms = load_le<std::uint16_t>(bytes, kStampAt);
  for (std::size_t i = 0; i < kBeams; ++i) {
    const std::size_t at = kBeamsAt + i * kBeamSize;
    slice.beams[i] = {load_le<std::uint16_t>(bytes, at), bytes[at + 2]};
  }
  if (slice.start_cdeg >= kTurn_cdeg || slice.end_cdeg >= kTurn_cdeg) return Fault::angle;
  if (span_cdeg(slice) > kMaxSpan_cdeg) return Fault::span;
  if (slice.stamp_ms > kStampWrap) return Fault::stamp;
  return slice;
}

std::array<std::uint8_t, kPacketSize> encode(const Slice& slice) {
  std::array<std::uint8_t, kPacketSize> bytes{kHeader, kKind};
  const std::span<std::uint8_t> all(bytes);
  store_le(all, kSpeedAt, slice.speed_degps);
  store_le(all, kStartAt, slice.start_cdeg);
  for (std::size_t i = 0; i < kBeams; ++i) {
    const std::size_t at = kBeamsAt + i * kBeamSize;
    store_le(all, at, slice.beams[i].range_mm);
    bytes[at + 2] = slice.beams[i].intensity;
  }
  store_le(all, kEndAt, slice.end_cdeg);
  store_le(all, kStampAt, slice.stamp_ms);
  bytes[kSumAt] = crc8(std::span<const std::uint8_t>(bytes).first(kSumAt));
  return bytes;
}

}  // namespace drover::ld06
