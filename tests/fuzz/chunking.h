// A byte driver gives the same result for any chunking: what the fuzz targets of all of them check.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <span>

#include "drover/driver.h"

namespace drover::fuzz {

inline void require(bool holds) {
  if (!holds) std::abort();
}

/// Feeds `whole` with all bytes at once and `pieces` with chunks that `choice` selects, both new
/// and alike, the first byte at `start`; then `check` sees each measurement and `check_same` each
/// pair.
template <class Driver, class Check, class CheckSame>
void check_chunking(Driver& whole, Driver& pieces, std::span<const std::uint8_t> bytes,
                    std::uint32_t choice, Time start, double baud, Check check,
                    CheckSame check_same) {
  static DriverOut from_whole;
  static DriverOut from_pieces;
  from_whole.clear();
  from_pieces.clear();
  whole.on_bytes(bytes, start, from_whole);
  const Duration byte_time = from_s(10 / baud);
  for (std::size_t at = 0; at < bytes.size();) {
    choice = choice * 1664525U + 1013904223U;
    const std::size_t length = std::min<std::size_t>(1 + (choice >> 26U), bytes.size() - at);
    pieces.on_bytes(bytes.subspan(at, length), start + static_cast<int>(at) * byte_time,
                    from_pieces);
    at += length;
  }
  require(from_whole.measurements.size() == from_pieces.measurements.size());
  require(from_whole.overflows == from_pieces.overflows);
  for (std::size_t i = 0; i < from_whole.measurements.size(); ++i) {
    check(from_whole.measurements[i]);
    check_same(from_whole.measurements[i], from_pieces.measurements[i]);
  }
  const Time later = start + std::chrono::seconds(10);
  const auto one = whole.health(later);
  const auto other = pieces.health(later);
  require(one.good == other.good && one.bad == other.bad);
}

}  // namespace drover::fuzz
