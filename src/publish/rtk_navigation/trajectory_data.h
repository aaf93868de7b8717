// The `trajectory_data` topic: all tracks in one message.
#pragma once

#include <span>
#include <string>

#include "store/track.h"

namespace drover::publish {

/// RTK navigation protocol, "轨迹反馈 trajectory_data": a list, `[]` when there is no track.
/// Numbers are written as given (NaN, from an impossible latitude, as 0); so is the order.
std::string trajectory_data_text(std::span<const store::Track> tracks);

}  // namespace drover::publish
