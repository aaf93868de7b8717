#include "engine/estimate/model_heading.h"

#include <algorithm>
#include <cmath>

#include "drover/angle.h"

namespace drover::engine::estimate {
namespace {

// The antennas are mounted with an error of their own, which no number of measurements shows.
constexpr double kHeadingFloorShare = 0.2;
// Two headings closer than this are taken as this far apart, so that a burst weighs like one.
constexpr double kShortest_s = 0.01;

void place(State& state, double yaw_rad, double sigma_rad) {
  state.belief.reset(kYaw, yaw_rad, sigma_rad);
  state.has_heading = true;
  state.heading.jumps.accepted();
}

}  // namespace

double yaw_of_baseline_rad(double heading_deg, const AntennaConfig& antenna) {
  return yaw_rad_from_compass_deg(heading_deg - antenna.heading_baseline_offset_deg);
}

void apply_heading(State& state, double told_rad, const EstimateConfig& config) {
  HeadingTrack& track = state.heading;
  const double yaw_rad = wrap_rad(told_rad + state.mounting.applied_rad);
  const double sigma = to_rad(config.heading_sigma_deg);
  const double since_s =
      track.last == kNever ? kShortest_s : std::max(to_s(state.time - track.last), kShortest_s);
  track.last = state.time;
  if (!state.has_heading) {
    place(state, yaw_rad, sigma);
    return;
  }
  const double innovation = wrap_rad(yaw_rad - state.belief.mean[kYaw]);
  const double expected = state.belief.covariance[kYaw][kYaw] + square(sigma);
  if (!(square(innovation) <= square(config.gate_sigma) * expected)) {
    const bool standing = state.standing_since != kNever;
    const double repeats = std::abs(wrap_rad(yaw_rad - track.place_rad));
    track.jumps.refused(state.time, standing && repeats < config.gate_sigma * sigma,
                        !standing && !state.way_unknown);
    track.contradiction_rad = std::abs(innovation);
    ++state.refused;
    if (track.jumps.new_place()) track.place_rad = yaw_rad;
    if (standing && track.jumps.settled(from_s(config.jump_time_s))) place(state, yaw_rad, sigma);
    return;
  }
  track.jumps.accepted();
  // An error that lasts for a time T is, to the filter, white noise of 2 T sigma^2 per second.
  const double repeated = 1 + 2 * config.heading_correlation_s / since_s;
  Vector row{};
  row[kYaw] = 1;
  state.belief.correct(row, innovation, square(sigma) * repeated);
  state.belief.floor_variance(kYaw, square(kHeadingFloorShare * sigma));
}

}  // namespace drover::engine::estimate
