// Numbers of a mission that its seed draws, within the bounds that the scenario states.
#pragma once

#include <nlohmann/json.hpp>

#include <cstdint>

namespace drover::sim {

/// Each `{"from": 0, "to": 0.5}` below the document's "mission" becomes a number between the two,
/// to a millionth. What it becomes depends on the seed and on where it stands, so that a new one
/// leaves the others as they were. Throws std::runtime_error naming the place.
void draw_mission(nlohmann::json& document, std::uint64_t seed);

}  // namespace drover::sim
