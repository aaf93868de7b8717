// What outlives the program: what stopped the robot until a person acts, and whether it was held.
#pragma once

#include "drover/fixed_text.h"

namespace drover {

/// Given to the gateway once, before its first cycle, and kept up to date by it from then on.
/// A stop and a power cut outlive a boot of the computer; all else ends with it.
struct Remembered {
  Reason stop;                 ///< a latched stop; empty: none
  bool stop_at_robot = false;  ///< that stop can be reset at the robot only, not over the network
  bool power_cut = false;      ///< the gateway opened the enable relay, and nobody has reset it
  bool holding = false;        ///< the drives hold the robot, or are to hold it again
  bool released = false;       ///< a person let the drives go, to push the robot
  bool task = false;           ///< a task was on its way
  /// Wheels, gyro and receiver agreed on a first way, with this configuration.
  bool mechanics_proved = false;

  friend bool operator==(const Remembered&, const Remembered&) = default;
};

}  // namespace drover
