// Which parts of a track are driven backwards.
#pragma once

#include <span>

#include "drover/path.h"

namespace drover::store {

/// Sets Path::backwards and Path::either. `looks_rad`: the yaw of each point where one is known,
/// else not a number; only what is driven as recorded needs it. A track is parted at its cusps
/// (turns of more than 120 degrees); a part is recorded backwards when three quarters of its way
/// and more were.
void set_gears(Path& path, std::span<const double> looks_rad, TrackDrive drive);

}  // namespace drover::store
