// What droverd tells of a drive (`drive_values`), as a snapshot that has just that. Pure.
#pragma once

#include "drover/snapshot.h"
#include "json/located_json.h"

namespace drover::cli {

/// Of the reply's member `values`; what is not told stays as in a snapshot that was never written.
Snapshot snapshot_of(const json::Node& values);

}  // namespace drover::cli
