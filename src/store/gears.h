// Which parts of a track are driven backwards.
#pragma once

#include <cstdint>
#include <span>

#include "drover/path.h"

namespace drover::store {

/// How tracks are driven (`navigate.drive`).
enum class TrackDrive : std::uint8_t {
  ahead,     ///< the robot looks where it drives, and turns round at a cusp
  recorded,  ///< backwards where the angles of the points say that it was recorded so
  either,    ///< as it stands at the start; at a cusp it goes on the other way, and does not turn
};

/// Sets Path::backwards and Path::either. `looks_rad`: the yaw of each point where one is known,
/// else not a number. A track is parted at its cusps (turns of more than 120 degrees); a part is
/// recorded backwards when three quarters of its way and more were.
void set_gears(Path& path, std::span<const double> looks_rad, TrackDrive drive);

}  // namespace drover::store
