// A chassis that nobody builds: it takes a twist in a packet and tells one. For tests of what a
// base that takes a twist needs of everybody else.
//
// A packet is C5, what it is, two int16 (little endian: mm/s, mrad/s), and the sum of all that.
// Told: drive so (1), let go (2). It tells: let go (3), in closed loop (4), a fault (5); and it
// greets (6), which is answered with rest.
#pragma once

#include <optional>

#include "drover/driver.h"
#include "drover/registry.h"

namespace drover::test {

namespace crawler {

inline constexpr std::uint8_t kDrive = 1;
inline constexpr std::uint8_t kLetGo = 2;
inline constexpr std::uint8_t kIsIdle = 3;
inline constexpr std::uint8_t kRuns = 4;
inline constexpr std::uint8_t kFault = 5;
inline constexpr std::uint8_t kGreets = 6;

inline constexpr std::size_t kSize = 7;
Packet packet(std::uint8_t what, const Twist& twist = {});
/// What it is, and the twist in it; absent when it is none.
struct Said {
  std::uint8_t what = 0;
  Twist twist;
};
std::optional<Said> read(std::span<const std::uint8_t> packet);

}  // namespace crawler

extern const DriverEntry kCrawlerEntry;

}  // namespace drover::test
