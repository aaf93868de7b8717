// A snapshot as a view may show it now: what is old is not shown as the present.
#pragma once

#include <string_view>

#include "drover/snapshot.h"

namespace drover::publish {

/// A control cycle takes 1 to 20 ms. Longer than this without a new snapshot: nobody looks.
inline constexpr Duration kSnapshotLimit = std::chrono::milliseconds(250);

/// `snapshot` at `now` (monotonic). One that is older than `limit` tells nothing of the present:
/// its sources are stale, its speeds absent, `locate` lost, `status` an error, and `why` begins
/// with how long the control thread has stood still. Last known values (pose, position, charge)
/// stay. One that was never written comes back as it is.
Snapshot as_seen(const Snapshot& snapshot, Time now, Duration limit = kSnapshotLimit);

/// Puts a reason after all others of `why`, only counted when there is no room; nothing when it is
/// told already.
void tell_last(Snapshot& snapshot, std::string_view reason);

/// Puts a reason before all others of `why`; the last one makes room when there is none, and is
/// counted.
void tell_first(Snapshot& snapshot, std::string_view reason);

}  // namespace drover::publish
