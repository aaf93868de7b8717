// What scanners saw close to the robot, put together with what is known of the surroundings.
#pragma once

#include <span>
#include <vector>

#include "drover/clearance.h"
#include "drover/fixed_text.h"
#include "scene/look/look.h"
#include "scene/sensor/near_things.h"

namespace drover::scene {

/// So far beyond the turning circle points count: a tight curve can be left before them.
inline constexpr double kNearby_m = 0.5;
/// A curve with less of a bend goes straight ahead, for which the field is.
inline constexpr double kBends_radpm = 0.05;

/// Kept beside a curve and a track: half of the margin. Less may be taken by a robot that leaves
/// what was looked along before the next look (engine::ClearanceConfig::beside_m).
double slim_margin_m(const LookSettings& settings);
/// Of the footprint's farthest corner from base_link, with its margin.
double turning_circle_m(const LookSettings& settings);

/// The points bound turns on the spot and the way back as an object does; the curve ahead, where it
/// bends, and the track, with half of the margin: what is beside a robot that drives straight on is
/// the field's business. They need no position. What no scanner sees bounds nothing. `scanners`:
/// their names, by SeenPoint::scanner; `now`: what is older than a turn is told as seen before;
/// `track`: its track_way(), in base_link.
Clearance with_points(Clearance found, std::span<const sensor::SeenPoint> points,
                      std::span<const Name> scanners, const LookSettings& settings, Time now,
                      std::span<const Step> track = {});

}  // namespace drover::scene
