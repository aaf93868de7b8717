// What a cycle tells of the base and the ground, for those who judge whether it rests.
#pragma once

#include <span>

#include "drover/snapshot.h"

namespace drover::engine {

struct RestInput {
  Time now = kNever;
  Duration dt{};
  std::span<const AxisSnapshot> axes;  ///< with the commands of the last cycle
  bool power_is_off = false;           ///< by the e-stop's own circuit: there is nothing to cut
  bool rolls_unpowered = false;        ///< the ground falls, and nothing but the drives holds it
  bool released = false;               ///< by a person, who may push it: there is nothing to cut
  /// Drives that had let go are being taken back: their commands follow a roll, nobody drives.
  bool caught = false;
  bool drives_on_in_silence = false;  ///< a drive that says nothing keeps its last command
  bool stop_creeps = false;           ///< told to stand it only brakes, on a slope
  bool found_powered = false;         ///< it may have one of the program before this one
  /// Sine of how the ground falls on its way ahead; 0: hardly. Absent: unknown.
  double falls_ahead = kAbsent;
  double yaw_rad = kAbsent;  ///< of the base, as far as it is known
};

}  // namespace drover::engine
