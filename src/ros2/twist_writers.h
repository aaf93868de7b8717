// Whether one program writes /cmd_vel, or two at once. Pure.
#pragma once

#include <array>
#include <cstdint>

#include "drover/time.h"

namespace drover::ros2 {

class TwistWriters final {
 public:
  /// So long after its last message a program still counts as one that writes.
  static constexpr Duration kTogether = std::chrono::seconds(1);

  /// A message of that writer. Returns the other one that writes too; 0: there is none.
  std::uint64_t rival_of(std::uint64_t writer, Time now) {
    // His place, or that of him who was not heard for longer.
    const bool first = last_[0].writer == writer ||
                       (last_[1].writer != writer && last_[0].heard <= last_[1].heard);
    last_[first ? 0 : 1] = {writer, now};
    const Heard& other = last_[first ? 1 : 0];
    return other.heard != kNever && now - other.heard <= kTogether ? other.writer : 0;
  }

 private:
  struct Heard {
    std::uint64_t writer = 0;
    Time heard = kNever;
  };
  std::array<Heard, 2> last_{};
};

}  // namespace drover::ros2
