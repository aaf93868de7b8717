// What outlives the program: what stopped the robot until a person acts, and whether it was held.
#pragma once

#include <cstdint>

#include "drover/fixed_text.h"

namespace drover {

/// Where the base stands, in the map of an origin. It is compared with where it is found again.
struct RestPlace {
  bool known = false;
  bool doubted = false;  ///< what the receiver says is not believed, and nobody has accepted it
  std::uint16_t doubt_cm = 0;  ///< so far away it may be beside what its sigma says, cm
  double x_m = 0;
  double y_m = 0;
  double yaw_rad = 0;
  double position_sigma_m = 0;
  double yaw_sigma_rad = 0;
  double origin_latitude_deg = 0;
  double origin_longitude_deg = 0;

  friend bool operator==(const RestPlace&, const RestPlace&) = default;
};

/// Given to the gateway once, before its first cycle, and kept up to date by it from then on.
/// A stop, what joint commands wait for and a power cut outlive a boot; all else ends with it.
struct Remembered {
  Reason stop;                 ///< a latched stop; empty: none
  bool stop_at_robot = false;  ///< that stop can be reset at the robot only, not over the network
  bool power_cut = false;      ///< the gateway opened the enable relay, and nobody has reset it
  bool holding = false;        ///< the drives hold the robot, or are to hold it again
  bool released = false;       ///< a person let the drives go, to push the robot
  bool task = false;           ///< a task was on its way
  /// Wheels, gyro and receiver agreed on a first way, with this configuration.
  bool mechanics_proved = false;
  /// What stopped the base so that joint commands wait until a person acts; empty: nothing. A task
  /// may begin all the same: it is a person's act.
  Reason joints_wait;
  bool at_rest = false;   ///< it was confirmed to rest, and nobody has driven it since
  bool ran_away = false;  ///< that stop, or one before it, is of a wheel that ran away
  RestPlace place;        ///< unknown while a wheel turns

  friend bool operator==(const Remembered&, const Remembered&) = default;
};

}  // namespace drover
