// Any bytes into the LD06 driver: no crash, no absurd point, the same result for any chunking.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "drivers/ld06/driver.h"
#include "tests/fuzz/chunking.h"

namespace {

using namespace std::chrono_literals;
using namespace drover;
using fuzz::require;

constexpr std::size_t kMaxInput = 4096;
const Time kStart{100s};
constexpr Duration kByteTime{43403};

/// Bytes as the rest of packets, so that they get behind the checksum: speed, start and so on.
std::vector<std::uint8_t> sealed(std::span<const std::uint8_t> bytes) {
  constexpr std::size_t kInner = ld06::kPacketSize - 3;
  std::vector<std::uint8_t> stream;
  for (std::size_t at = 0; at + kInner <= bytes.size(); at += kInner) {
    std::vector<std::uint8_t> packet{ld06::kHeader, ld06::kKind};
    packet.insert(packet.end(), bytes.begin() + static_cast<long>(at),
                  bytes.begin() + static_cast<long>(at + kInner));
    packet.push_back(ld06::crc8(packet));
    stream.insert(stream.end(), packet.begin(), packet.end());
  }
  return stream;
}

void check(const Scan& scan) {
  require(scan.begin <= scan.end && std::isfinite(scan.turn_Hz) && scan.turn_Hz >= 0);
  require(!scan.points.empty() && scan.sectors.size() == 24);
  for (const ScanPoint& point : scan.points) {
    require(point.bearing_rad >= -kPi && point.bearing_rad < kPi);
    require(point.range_m == 0 || (point.range_m >= 0.05 && point.range_m <= 12));
  }
}

void check_same(const Scan& a, const Scan& b) {
  require(a.begin == b.begin && a.end == b.end && a.points.size() == b.points.size());
  for (std::size_t i = 0; i < a.points.size(); ++i)
    require(a.points[i].bearing_rad == b.points[i].bearing_rad &&
            a.points[i].range_m == b.points[i].range_m);
  require(std::equal(a.sectors.begin(), a.sectors.end(), b.sectors.begin()));
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size < 2 || size > kMaxInput) return 0;
  // The first byte chooses the chunking of the second run, and whether packets are made whole.
  std::uint32_t choice = data[0];
  std::vector<std::uint8_t> bytes(data + 1, data + size);
  if (choice % 2 == 1) bytes = sealed(bytes);
  Options options(ld06::option_table());
  for (const char* const name : {"mount_x_m", "mount_y_m", "mount_z_m", "mount_yaw_deg"})
    options.set(name, 0.0);
  options.set("self_filter", std::string("0.5 0.3, 0.5 -0.3, -0.5 0"));
  ld06::Ld06Driver whole(options);
  ld06::Ld06Driver pieces(options);
  static ScanOut from_whole;
  static ScanOut from_pieces;
  std::size_t told = 0;
  // As a line gives them, at most 512 at once; the same bytes again in smaller pieces.
  for (std::size_t block = 0; block < bytes.size(); block += 512) {
    const auto some =
        std::span(bytes).subspan(block, std::min<std::size_t>(512, bytes.size() - block));
    from_whole.clear();
    from_pieces.clear();
    whole.on_bytes(some, kStart + static_cast<int>(block) * kByteTime, from_whole);
    for (std::size_t at = 0; at < some.size();) {
      choice = choice * 1664525U + 1013904223U;
      const std::size_t length = std::min<std::size_t>(1 + (choice >> 26U), some.size() - at);
      pieces.on_bytes(some.subspan(at, length), kStart + static_cast<int>(block + at) * kByteTime,
                      from_pieces);
      at += length;
    }
    require(from_whole.scans.size() == from_pieces.scans.size());
    require(from_whole.overflows == from_pieces.overflows);
    for (std::size_t i = 0; i < from_whole.scans.size(); ++i) {
      check(from_whole.scans[i]);
      check_same(from_whole.scans[i], from_pieces.scans[i]);
    }
    told += from_whole.scans.size();
  }
  const auto one = whole.health(kStart + 10s);
  const auto other = pieces.health(kStart + 10s);
  require(one.good == other.good && one.bad == other.bad && one.state == other.state);
  require(told == 0 || one.state != SourceState::fresh);
  return 0;
}
