// A task's report as one picture that needs nothing else: for a phone, or an e-mail.
#pragma once

#include <cstdint>
#include <string>

#include "json/located_json.h"

namespace drover::cli {

/// What the colour of the driven way tells.
enum class DrawnBy : std::uint8_t { cross_track, quality };

/// Of droverd's answer to `report`: the track, the driven way, pauses with their reasons, a scale,
/// north and a legend. Names and reasons are foreign text, and are escaped.
std::string report_svg(const json::Node& answer, DrawnBy by);

}  // namespace drover::cli
