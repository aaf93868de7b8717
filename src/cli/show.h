// Answers of droverd as text for people.
#pragma once

#include <string>

#include "json/located_json.h"

namespace drover::cli {

/// Several lines: what it does, why it does not move, where it is, and each device with its age.
std::string show_status(const json::Node& status);
/// A line a track.
std::string show_tracks(const json::Node& tracks);
/// A line a point.
std::string show_track(const json::Node& track);

}  // namespace drover::cli
