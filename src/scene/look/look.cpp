#include "scene/look/look.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "scene/look/free_disc.h"
#include "scene/look/sweeper.h"

namespace drover::scene {
namespace {

constexpr double kStraight_mps = 0.01;  // slower has no curve of its own
constexpr double kFree = std::numeric_limits<double>::infinity();

bool has_heading(const Standpoint& from) {
  return is_heading(from.pose.yaw_rad, from.yaw_sigma_rad);
}

/// From base_link to the farthest corner.
double reach_of(const Piece& body) {
  double reach_m = 0;
  for (const Point2 corner : body.corners) reach_m = std::max(reach_m, length_m(corner));
  return reach_m;
}

/// How far, of each metre of distance, a heading that is off throws a thing aside: its chord, which
/// is never more than from one side to the other.
double thrown_aside(const LookSettings& settings, double yaw_sigma_rad) {
  return std::min(settings.sigmas * yaw_sigma_rad, 2.0);
}

/// Why nothing can be said; empty: something can.
Reason find_unknown(const Surroundings& around, const Standpoint& from) {
  if (!around.problem.empty()) return around.problem;
  if (!std::isfinite(from.twist.vx_mps + from.twist.wz_radps))
    return "how the robot moves is not known";
  if (around.is_empty()) return {};
  if (Reason problem = position_problem(from.pose, from.position_sigma_m); !problem.empty())
    return problem;
  if (from.path == 0) return {};
  if (!has_heading(from)) return "which way the robot looks in its scene is not known";
  if (from.line.empty()) return "what of its track is left is not known";
  return {};
}

/// The track ends within what was asked to look at.
bool is_whole(const LookSettings& settings, const Standpoint& from) {
  if (!from.line_ends || from.line.empty()) return false;
  double length = -from.line_from_m;
  for (std::size_t i = 1; i < from.line.size(); ++i)
    length += length_m(from.line[i] - from.line[i - 1]);
  return length <= settings.along_m;
}

/// As far as was looked: where nothing is, it is free.
void look_at_nothing(const LookSettings& settings, const Standpoint& from, Clearance& found) {
  found.ahead_m = found.back_m = settings.ahead_m;
  found.left_rad = found.right_rad = kFree;
  if (from.path != 0) found.along_m = is_whole(settings, from) ? kFree : settings.along_m;
}

void look_any_way(const Surroundings& around, const LookSettings& settings, const Standpoint& from,
                  Clearance& found) {
  const Piece body = body_of(settings, from.position_sigma_m, 0);  // a disc looks any way
  const FreeDisc disc =
      free_disc(around, place_of(from.pose), reach_of(body) + body.radius_m, settings.ahead_m);
  found.ahead_m = found.back_m = disc.free_m;
  found.left_rad = found.right_rad = disc.free ? kFree : 0;
  if (disc.blocked) found.first = in_the_way(disc.name, "away", disc.free_m);
}

void look_around(const Sweeper& sweeper, const LookSettings& settings, const Standpoint& from,
                 Clearance& found) {
  const double stride_m = sweeper.stride_m();
  const WayEnd ahead = sweeper.sweep(curve_steps(settings, from, false, stride_m));
  const WayEnd back = sweeper.sweep(curve_steps(settings, from, true, stride_m));
  const WayEnd left = sweeper.sweep(pivot_steps(from.pose, std::numbers::pi));
  const WayEnd right = sweeper.sweep(pivot_steps(from.pose, -std::numbers::pi));
  found.ahead_m = ahead.way.free_m;
  found.back_m = back.way.free_m;
  found.left_rad = left.way.blocked ? left.way.free_rad : kFree;
  found.right_rad = right.way.blocked ? right.way.free_rad : kFree;
  const bool backwards = from.twist.vx_mps < 0;
  const WayEnd& end = backwards ? back : ahead;
  if (end.way.blocked)
    found.first = in_the_way(sweeper.name(end), backwards ? "back" : "ahead", end.way.free_m);
}

void look_along(const Sweeper& sweeper, const LookSettings& settings, const Standpoint& from,
                Clearance& found) {
  const TrackPart part{from.line, from.line_from_m, settings.along_m};
  const WayEnd end =
      sweeper.sweep(track_steps(from.pose, part, settings.steering, sweeper.stride_m()));
  found.along_m = !end.way.blocked && is_whole(settings, from) ? kFree : end.way.free_m;
  found.first.clear();
  if (end.way.blocked)
    found.first = in_the_way(sweeper.name(end), "along the track", end.way.free_m);
}

}  // namespace

std::vector<Step> curve_steps(const LookSettings& settings, const Standpoint& from, bool back,
                              double stride_m) {
  const bool drives = std::abs(from.twist.vx_mps) > kStraight_mps;
  const Twist curve = drives ? from.twist : Twist{1, 0};
  const double v_mps = (back ? -1 : 1) * std::abs(curve.vx_mps);
  const double wz_radps = curve.wz_radps * (v_mps * curve.vx_mps < 0 ? -1 : 1);
  auto steps = twist_steps(from.pose, v_mps, wz_radps, settings.ahead_m, stride_m);
  const double aside = thrown_aside(settings, from.yaw_sigma_rad);
  for (Step& step : steps) step.off_m = aside * step.driven_m;
  return steps;
}

Reason position_problem(const Pose2& pose, double position_sigma_m) {
  if (is_finite(place_of(pose)) && std::isfinite(position_sigma_m) && position_sigma_m >= 0)
    return {};
  return "where the robot is in its scene is not known";
}

bool is_heading(double yaw_rad, double yaw_sigma_rad) {
  return std::isfinite(yaw_rad) && std::isfinite(yaw_sigma_rad) && yaw_sigma_rad >= 0;
}

Piece body_of(const LookSettings& settings, double position_sigma_m, double yaw_sigma_rad) {
  const Piece body =
      piece_of(settings.footprint, settings.margin_m + settings.sigmas * position_sigma_m);
  return widened(body, thrown_aside(settings, yaw_sigma_rad) * reach_of(body));
}

Clearance look(const Surroundings& around, const LookSettings& settings, const Standpoint& from) {
  Clearance found;
  found.t = from.t;
  found.scene = around.number;
  found.path = from.path;
  found.twist = from.twist;
  found.unknown = find_unknown(around, from);
  if (!found.unknown.empty()) return found;
  if (around.is_empty()) {
    look_at_nothing(settings, from, found);
    return found;
  }
  if (!has_heading(from)) {
    look_any_way(around, settings, from, found);
    return found;
  }
  const Sweeper sweeper(around, body_of(settings, from.position_sigma_m, from.yaw_sigma_rad));
  look_around(sweeper, settings, from, found);
  if (from.path != 0) look_along(sweeper, settings, from, found);
  return found;
}

}  // namespace drover::scene
