// What a replay found, for people and for programs.
#pragma once

#include <string>

#include "gateway/recording/replay.h"

namespace drover::cli {

/// One JSON object, without a line end.
std::string replay_json(const gateway::Replayed& it);
/// Of one that is equal or differs: lines.
std::string show_replay(const gateway::Replayed& it);

}  // namespace drover::cli
