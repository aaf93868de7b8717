// What lamp, buzzer and enable relay show: patterns of the robot's state, for people near it.
#pragma once

#include <array>

#include "drover/snapshot.h"

namespace drover::engine {

/// What a person near the robot must know, worst first.
enum class Mood : std::uint8_t {
  stopped,  ///< an e-stop is pressed, or a stop is latched: three short flashes, then a pause
  paused,   ///< waits and goes on by itself: four flashes a second
  about,    ///< somebody owns the drives, motion is about to begin: light on, two beeps at first
  moving,   ///< light on, and the beeps to their end
  ready,    ///< one short flash every two seconds
};

/// Levels as they are to be shown: true is on.
class Signals final {
 public:
  /// `moving`: any axis is commanded to move; `armed`: somebody owns the drives; `power`: the
  /// drives are to have it.
  const std::array<bool, kOutputCount>& step(Time now, const Snapshot& snapshot, bool moving,
                                             bool armed, bool power);

 private:
  std::array<bool, kOutputCount> levels_{};
  Mood mood_ = Mood::ready;
  Time since_ = kNever;
  Time motion_since_ = kNever;  ///< about to move or moving
};

}  // namespace drover::engine
