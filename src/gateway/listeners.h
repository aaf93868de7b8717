// Who on a bus hears which frame: found at once, however many devices there are.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "drover/driver.h"
#include "gateway/input.h"

namespace drover::gateway {

/// Built at the start from what each device `listens` to.
class Listeners final {
 public:
  void add(SlotId slot, std::span<const FrameFilter> filters);
  /// Calls `tell(slot)` once for each that listens to the frame, in the order in which they came.
  template <class Tell>
  void each(const CanFrame& frame, const Tell& tell) const {
    if (frame.extended) {
      for (const auto& [slot, filters] : extended_)
        if (matches(filters, frame)) tell(slot);
    } else if (frame.id < kStandardIds) {
      for (std::size_t i = begin_[frame.id]; i < begin_[frame.id + 1]; ++i) tell(standard_[i]);
    }
  }

 private:
  static constexpr std::size_t kStandardIds = 0x800;
  static bool matches(std::span<const FrameFilter> filters, const CanFrame& frame);

  std::vector<std::pair<SlotId, std::vector<FrameFilter>>> all_;
  std::vector<std::pair<SlotId, std::vector<FrameFilter>>> extended_;
  /// Those of id i stand in `standard_` from begin_[i] to begin_[i + 1].
  std::array<std::uint32_t, kStandardIds + 1> begin_{};
  std::vector<SlotId> standard_;
};

}  // namespace drover::gateway
