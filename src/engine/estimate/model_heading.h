// How the direction of an antenna baseline corrects the state.
#pragma once

#include "engine/config.h"
#include "engine/estimate/state.h"

namespace drover::engine::estimate {

/// Yaw of base_link, rad, for a baseline that points `heading_deg` clockwise from true north.
double yaw_of_baseline_rad(double heading_deg, const AntennaConfig& antenna);

/// Applies the yaw to a state that stands at the measurement's own time.
void apply_heading(State& state, double yaw_rad, const EstimateConfig& config);

}  // namespace drover::engine::estimate
