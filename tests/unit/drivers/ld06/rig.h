// A driver and its twin on one line, in a world that a test describes.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "drivers/ld06/driver.h"
#include "drivers/ld06/twin.h"
#include "support/allocation_counter.h"

namespace drover::test {

using namespace std::chrono_literals;

/// A room of 6 m by 4 m with the scanner in its middle.
inline double room_m(double bearing_rad) {
  return std::min(3 / std::abs(std::cos(bearing_rad)), 2 / std::abs(std::sin(bearing_rad)));
}

/// The defaults, and 0.2 m above base_link, looking ahead.
inline Options ld06_options() {
  return Options(ld06::option_table())
      .set("mount_x_m", 0.0)
      .set("mount_y_m", 0.0)
      .set("mount_z_m", 0.2)
      .set("mount_yaw_deg", 0.0);
}

struct ScannerRig {
  explicit ScannerRig(const Options& options = ld06_options())
      : driver(options), twin(options.flag("upside_down"), 1) {
    driver.on_link_up(now);
  }

  /// What the twin says is heard in chunks of 32 bytes, at the line's pace.
  void run(Duration time) {
    for (const Time end = now + time; now < end;) {
      now += 5ms;
      const std::size_t size = twin.on_tick(now, world, said);
      for (std::size_t at = 0; at < size; at += 32) hear(at, std::min<std::size_t>(32, size - at));
    }
  }

  SourceHealth health() const { return driver.health(now); }
  std::string why() const { return std::string(health().reason.view()); }
  const Scan& last() const { return scans.back(); }

  std::size_t unknown_sectors() const {
    std::size_t count = 0;
    for (const SectorState state : last().sectors) count += state == SectorState::unknown;
    return count;
  }

  ld06::Ld06Driver driver;
  ld06::Ld06Twin twin;
  RangeOf world = room_m;
  Time now{100s};
  std::vector<Scan> scans;
  std::uint64_t allocations = 0;

 private:
  void hear(std::size_t at, std::size_t size) {
    std::array<std::uint8_t, 32> chunk{};
    for (std::size_t i = 0; i < size; ++i) chunk[i] = static_cast<std::uint8_t>(said[at + i]);
    out.clear();
    AllocationCounter counter;
    driver.on_bytes({chunk.data(), size}, now + static_cast<long>(at) * 43403ns, out);
    allocations += counter.count();
    for (const Scan& scan : out.scans) scans.push_back(scan);
  }

  std::array<char, 512> said{};
  ScanOut out;
};

}  // namespace drover::test
