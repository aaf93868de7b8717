// Who on a bus hears which frame: found at once, however many devices there are.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "drover/actuator.h"
#include "drover/driver.h"
#include "gateway/input.h"

namespace drover::gateway {

/// One of those who hear a frame.
struct Listener {
  SlotId slot = 0;
  bool sends = false;  ///< it may be told such a frame: who sends one is somebody else
};

/// Built at the start from what each device `listens` to, and what it may be told.
class Listeners final {
 public:
  void add(SlotId slot, std::span<const FrameFilter> filters,
           std::span<const FrameRule> rules = {});
  /// Calls `tell(listener)` once for each that listens to the frame, in the order in which they
  /// came.
  template <class Tell>
  void each(const CanFrame& frame, const Tell& tell) const {
    if (frame.extended) {
      for (const auto& [listener, filters] : extended_)
        if (matches(filters, frame)) tell(listener);
    } else if (frame.id < kStandardIds) {
      const Those& those = standard_[frame.id];
      if (those.count > 0) tell(those.first);
      for (std::size_t i = 1; i < those.count; ++i) tell(others_[those.others + i - 1U]);
    }
  }

 private:
  static constexpr std::size_t kStandardIds = 0x800;
  static bool matches(std::span<const FrameFilter> filters, const CanFrame& frame);

  struct Device {
    SlotId slot = 0;
    std::vector<FrameFilter> filters;
    std::vector<FrameRule> rules;
  };
  std::vector<Device> all_;
  std::vector<std::pair<Listener, std::vector<FrameFilter>>> extended_;
  /// Those of an id: mostly there is one, who is found where his id is.
  struct Those {
    Listener first;
    std::uint8_t count = 0;
    std::uint32_t others = 0;  ///< where the others begin in `others_`
  };
  std::array<Those, kStandardIds> standard_{};
  std::vector<Listener> others_;
};

}  // namespace drover::gateway
