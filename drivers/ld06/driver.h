// Driver of an LD06 or LD19 scanner: bytes in, whole turns out.
#pragma once

#include <cstdint>

#include "drivers/ld06/framer.h"
#include "drivers/ld06/settings.h"
#include "drivers/ld06/turn.h"
#include "drivers/ld06/watch.h"
#include "drover/driver.h"
#include "drover/scan.h"

namespace drover::ld06 {

/// A turn is told when its last beam is in, whatever is wrong with it: what it sees is an obstacle
/// in any case, and what it does not see is unknown in any sector that is not well. Fresh is a
/// scanner whose latest turns see (Condition).
///
/// Time. A packet leaves the device when its last beam was measured; its beams are placed before
/// that by the speed that it tells. What waits on the way in is that much older than it looks.
class Ld06Driver final : public Device, public ScanFace {
 public:
  /// Throws std::runtime_error naming the option.
  explicit Ld06Driver(const Options& options);

  void on_bytes(std::span<const std::uint8_t> bytes, Time first_byte, ScanOut& out) override;
  ScanMount mount() const override { return settings_.mount; }
  void on_tick(Time now, DriverOut& out) override;
  void on_link_up(Time now) override;
  SourceHealth health(Time now) const override;

 private:
  void on_packet(Time first_byte, Time received, ScanOut& out);
  void explain_silence(Time now, Reason& reason) const;

  Settings settings_;
  Duration byte_time_;
  Framer framer_;
  TurnAssembler turns_;
  Watch watch_;
  Time last_byte_ = kNever;
  Time noise_since_ = kNever;  ///< first byte after the latest packet
  Time last_packet_ = kNever;
  Time last_turn_ = kNever;
  Time last_good_ = kNever;  ///< a turn of a scanner that sees
  std::uint64_t good_ = 0;
  std::uint64_t bad_ = 0;
};

}  // namespace drover::ld06
