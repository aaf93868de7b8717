// Ways to sweep: poses one after the other, close enough together.
#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "drover/angle.h"
#include "scene/plane/piece.h"

namespace drover::scene {

/// A pose on the way, and what was driven and turned until there, both growing.
struct Step {
  Pose2 pose;
  double driven_m = 0;  ///< arc length of base_link
  double turned_rad = 0;
  double off_m = 0;  ///< so far beside this pose the robot may be when it has come there
};

/// No step of the makers below turns by more.
inline constexpr double kStepTurn_rad = to_rad(3.0);
/// How long a step may be for a body of this size: a quarter of its reach from base_link, from 2 to
/// 25 cm. Nothing slips through longer ones either, they only find more too early.
double stride_m(const Piece& footprint);

/// Between two poses at constant speed and turn rate, the shorter way round; part from 0 to 1.
Pose2 between(const Pose2& from, const Pose2& to, double part);

/// A way of which there are no numbers: it is met at once.
std::vector<Step> unknown_way(const Pose2& from);
/// On an arc: negative lengths are backwards, positive turns to the left; length 0 is a pivot. More
/// than one turn is one: the rest is the same again.
std::vector<Step> arc_steps(const Pose2& from, double length_m, double turn_rad, double stride_m);
/// The way of a twist over a length (taken as positive), also backwards. A twist without speed has
/// no such way: the pose alone.
std::vector<Step> twist_steps(const Pose2& from, double v_mps, double wz_radps, double length_m,
                              double stride_m);
std::vector<Step> pivot_steps(const Pose2& from, double turn_rad);

/// How the robot drives along a line.
struct Steering {
  double pivot_rad = to_rad(60.0);  ///< where the line turns by more it turns on the spot
  double lookahead_m = 0.5;         ///< from beside the line it gets onto it in about twice of this
};

/// Of a line, in the order of travel, what is driven.
struct TrackPart {
  std::span<const Point2> line;
  double near_m = 0;  ///< as arc length: the robot is about there on it (1 m)
  double most_m = std::numeric_limits<double>::infinity();  ///< so far along it, or to its end
  std::span<const std::uint8_t> backwards = {};  ///< of each segment; empty: none is driven so
};

/// Who is farther from a line than this drives to it straight; no task begins so far from its
/// track.
inline constexpr double kFarBeside_m = 25.0;

/// Along a line, ahead, as the engine's tracker drives it: on a smooth line from one true corner to
/// the next, facing as that does; from beside it, or turned away from it, by its law of steering. A
/// line that begins ahead of the robot begins straight. A step's driven_m is the line's arc length
/// from the robot on; the last step is where the part ends.
std::vector<Step> track_steps(const Pose2& from, const TrackPart& part, const Steering& steering,
                              double stride_m);
/// All of the line from the robot on, which is somewhere on its first 2 m, or before it.
std::vector<Step> track_steps(const Pose2& from, std::span<const Point2> line, double stride_m,
                              double pivot_rad = to_rad(60.0));

}  // namespace drover::scene
