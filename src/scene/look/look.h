// What is free about the robot: objects, keep-out and keep-in zones against its footprint, along
// its track, along its present curve ahead and back, and turning on the spot.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "drover/clearance.h"
#include "drover/fixed_text.h"
#include "drover/twist.h"
#include "scene/look/surroundings.h"
#include "scene/plane/piece.h"
#include "scene/plane/steps.h"

namespace drover::scene {

struct LookSettings {
  std::vector<Point2> footprint;  ///< convex, in base_link
  double margin_m = 0.1;          ///< around it
  double sigmas = 2;              ///< of position and heading, around that
  double ahead_m = 3;             ///< how far to look along the curve, each way
  double along_m = 10;            ///< and along the track
  bool aside = false;             ///< it goes sideways, too: as far to each side as ahead
  Steering steering;
};

/// Where the robot was at `t`, and what it does.
struct Standpoint {
  Time t = kNever;
  Pose2 pose;
  double position_sigma_m = 0;  ///< absent or not finite: the position is not known
  double yaw_sigma_rad = 0;     ///< likewise the heading
  Twist twist;  ///< whose curve is looked along; at rest, and turning, it looks straight ahead
  std::uint64_t path = 0;  ///< 0: no track
  /// Of the track what is near and ahead, in the order of travel.
  std::span<const Point2> line;
  std::span<const std::uint8_t> line_backwards = {};  ///< of each segment; empty: none is
  double line_from_m = 0;  ///< the robot is about there on it (1 m), as arc length
  bool line_ends = true;   ///< its last point is the goal: beyond it nothing is driven
};

/// What is driven of its track, to its end or for `along_m`. Empty: it is on none, or nobody knows
/// where it is on it.
std::vector<Step> track_way(const LookSettings& settings, const Standpoint& from);
/// Who turns on the spot at a corner stands a little before or behind it, and is done when he looks
/// along what comes then.
inline constexpr double kTurnsAt_m = 0.15;
inline constexpr double kTurnsOver_rad = 0.1;
/// Of a track that begins with a turn on the spot the angle to that one's end, positive to the
/// left; 0: it begins with none.
double first_turn_rad(std::span<const Step> track);
/// So far around a turn is looked at, to the left positive: on a track that begins with it a little
/// farther than to its end, since what is beyond hinders nobody; else all around.
double looked_around_rad(bool left, std::span<const Step> track);

/// What was not looked at is not free: a way ends with what was asked to look at, but that of a
/// track that ends before, with nothing in between, is free for ever. Where nothing is placed and
/// nothing constrained, no position is needed. Without a heading, on no track, it says how far the
/// robot may go in any direction, and turn: what a search for the heading needs. `track` is its
/// track_way().
Clearance look(const Surroundings& around, const LookSettings& settings, const Standpoint& from,
               std::span<const Step> track);
inline Clearance look(const Surroundings& around, const LookSettings& settings,
                      const Standpoint& from) {
  return look(around, settings, from, track_way(settings, from));
}

/// What ends a track so near, while the robot turns or comes to its corner, is in the way of the
/// turn and not ahead: which way it turns, 0 when it is ahead.
double in_first_turn(const Twist& twist, std::span<const Step> track, double free_m);

/// Along the curve of a twist, at rest straight on: ahead, or the same curve back.
std::vector<Step> curve_steps(const Pose2& from, const Twist& twist, bool back, double length_m,
                              double stride_m);
/// The same for `ahead_m`. Where nobody keeps the robot on that curve by the map, as the tracker
/// does on its line, it comes off by as much of its way as it looks otherwise than it believes.
std::vector<Step> curve_way(const LookSettings& settings, const Standpoint& from, bool back,
                            double stride_m);

/// Straight to the side with the same heading, likewise; of a robot that goes so.
std::vector<Step> aside_way(const LookSettings& settings, const Standpoint& from, bool left,
                            double stride_m);
/// The way that it goes, or would go.
inline bool asks_aside(const Twist& twist, bool left) {
  return !drives(twist) && goes_sideways(twist) && left == (twist.vy_mps > 0);
}
inline bool asks_straight(const Twist& twist, bool back) {
  return !is_turn(twist) && (drives(twist) || !goes_sideways(twist)) && back == (twist.vx_mps < 0);
}

/// No more is free than this, by the margin alone neither; true: the way had been longer.
bool shorten(double& way, double& bare, double free);

/// Nothing can be said by a position like this one; empty: it is one.
Reason position_problem(const Pose2& pose, double position_sigma_m);
/// The robot knows which way it looks.
bool is_heading(double yaw_rad, double yaw_sigma_rad);
/// Footprint with its margin and the errors of position and heading: a heading that is off throws
/// the corner that is farthest from base_link farthest aside.
Piece body_of(const LookSettings& settings, double position_sigma_m, double yaw_sigma_rad);

}  // namespace drover::scene
