// From slices to whole turns.
#pragma once

#include <optional>

#include "drivers/ld06/codec.h"
#include "drover/scan.h"

namespace drover::ld06 {

/// A turn begins where the angle passes zero; the first, which began somewhere, is not told. A
/// packet that was lost leaves a hole. Where so much was lost that a turn could be put together
/// from two, it is dropped.
class TurnAssembler final {
 public:
  /// Upside down the sensor's clockwise is counter-clockwise seen from above.
  explicit TurnAssembler(bool upside_down) : upside_down_(upside_down) {}

  /// `sent` is the time of the packet's first byte, by when its last beam was measured. True when
  /// this slice ended a turn.
  bool add(const Slice& slice, Time sent);
  /// The turn that ended, every beam with the range that was told; it has no sectors yet. Until the
  /// next add().
  Scan& turn() { return ended_; }
  void reset();

 private:
  void begin_turn(Time at);
  bool end_turn();
  bool is_gap(std::uint16_t stamp_ms, Time sent) const;

  bool upside_down_;
  Scan growing_;
  Scan ended_;
  bool whole_ = false;      ///< the growing turn began at zero
  double last_cdeg_ = 0;    ///< angle of the latest beam
  double speed_degps_ = 0;  ///< sum over the slices of the growing turn
  int slices_ = 0;
  std::optional<std::uint16_t> stamp_ms_;
  Time sent_ = kNever;  ///< the latest slice
};

}  // namespace drover::ld06
