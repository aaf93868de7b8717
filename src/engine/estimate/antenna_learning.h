// What RTK positions teach of the antenna that they are of, and what follows for the estimate.
#pragma once

#include "engine/estimate/model_gnss.h"

namespace drover::engine::estimate {

/// Of a position as it came, what it tells of the antenna. Nothing on slopes, where wheels slip, or
/// where it is suspected to drift. `point` has the arm.
void learn_fit(State& state, const AntennaPosition& raw, AntennaPoint point, const Twist& twist,
               const EstimateConfig& config);
/// They are of another receiver from now on: nothing is known of it.
void forget_fit(State& state, const EstimateConfig& config);
/// A position as it would be without delay.
AntennaPosition in_time(const State& state, AntennaPosition position, const Twist& twist);
/// Whoever believed in positions that were late is behind by so much of the way.
void correct_lateness(State& state, const Twist& twist);
/// The heading turns by what was learned of the mounting; the antenna stays where it is.
void correct_mounting(State& state, const LeverArm& arm, const EstimateConfig& config);

}  // namespace drover::engine::estimate
