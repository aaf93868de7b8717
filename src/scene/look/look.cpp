#include "scene/look/look.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "scene/look/free_disc.h"
#include "scene/look/sweeper.h"

namespace drover::scene {
namespace {

constexpr double kHere_m = 0.05;  // a turn that begins so near is the one that is begun
constexpr double kFree = std::numeric_limits<double>::infinity();

bool has_heading(const Standpoint& from) {
  return is_heading(from.pose.yaw_rad, from.yaw_sigma_rad);
}

/// How far, of each metre of distance, a heading that is off throws a thing aside: its chord, which
/// is never more than from one side to the other.
double thrown_aside(const LookSettings& settings, double yaw_sigma_rad) {
  return std::min(settings.sigmas * yaw_sigma_rad, 2.0);
}

/// One way, by two bodies.
struct Swept {
  WayEnd end;
  FreeWay bare;  ///< without the errors of position and heading
};

/// The robot with all that is kept free around it, and with the margin alone.
class Bodies final {
 public:
  Bodies(const Surroundings& around, const LookSettings& settings, const Standpoint& from)
      : whole_(around, body_of(settings, from.position_sigma_m, from.yaw_sigma_rad)),
        bare_(around, body_of(settings, 0, 0)) {}

  double stride_m() const { return whole_.stride_m(); }
  std::string name(const WayEnd& end) const { return whole_.name(end); }
  /// What is free for the larger one is free for the smaller one.
  Swept sweep(std::vector<Step> steps) const {
    const WayEnd end = whole_.sweep(steps);
    if (!end.way.blocked) return {end, end.way};
    for (Step& step : steps) step.off_m = 0;
    return {end, bare_.sweep(steps).way};
  }

 private:
  Sweeper whole_;
  Sweeper bare_;
};

double turn_rad(const FreeWay& way) {
  return way.blocked ? way.free_rad : kFree;
}

/// Why nothing can be said; empty: something can.
Reason find_unknown(const Surroundings& around, const Standpoint& from) {
  if (!around.problem.empty()) return around.problem;
  if (!std::isfinite(from.twist.vx_mps + from.twist.wz_radps + from.twist.vy_mps))
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
  if (settings.aside) found.aside_left_m = found.aside_right_m = settings.ahead_m;
  found.bare = {found.along_m,   found.ahead_m,      found.back_m,       found.left_rad,
                found.right_rad, found.aside_left_m, found.aside_right_m};
}

void look_any_way(const Surroundings& around, const LookSettings& settings, const Standpoint& from,
                  Clearance& found) {
  const auto disc_of = [&](double position_sigma_m) {
    const Piece body = body_of(settings, position_sigma_m, 0);  // a disc looks any way
    return free_disc(around, place_of(from.pose), reach_m(body.corners) + body.radius_m,
                     settings.ahead_m);
  };
  const FreeDisc disc = disc_of(from.position_sigma_m);
  found.ahead_m = found.back_m = disc.free_m;
  found.left_rad = found.right_rad = disc.free ? kFree : 0;
  const FreeDisc bare = disc.blocked ? disc_of(0) : disc;
  const double bare_rad = bare.free ? kFree : 0;
  found.bare = {0, bare.free_m, bare.free_m, bare_rad, bare_rad};
  if (settings.aside) {
    found.aside_left_m = found.aside_right_m = disc.free_m;
    found.bare.aside_left_m = found.bare.aside_right_m = bare.free_m;
  }
  if (disc.blocked)
    found.first = disc.free ? in_the_way(disc.name, "away", disc.free_m) : is_there(disc.name);
}

Reason in_words(const Bodies& bodies, const WayEnd& end, const char* where) {
  if (end.way.at_start) return is_there(bodies.name(end));
  return in_the_way(bodies.name(end), where, end.way.free_m);
}

/// What is there already hinders every turn.
Reason in_turn_words(const Bodies& bodies, const WayEnd& end, double turn_rad, bool left) {
  if (end.way.at_start) return is_there(bodies.name(end));
  return in_the_turn(bodies.name(end), "is", turn_rad, left);
}

void look_aside(const Bodies& bodies, const LookSettings& settings, const Standpoint& from,
                Clearance& found) {
  for (const bool to_left : {true, false}) {
    const auto [end, bare] = bodies.sweep(aside_way(settings, from, to_left, bodies.stride_m()));
    (to_left ? found.aside_left_m : found.aside_right_m) = end.way.free_m;
    (to_left ? found.bare.aside_left_m : found.bare.aside_right_m) = bare.free_m;
    if (end.way.blocked && asks_aside(from.twist, to_left))
      found.first = in_words(bodies, end, to_left ? "to the left" : "to the right");
  }
}

void look_around(const Bodies& bodies, const LookSettings& settings, const Standpoint& from,
                 std::span<const Step> track, Clearance& found) {
  const double stride_m = bodies.stride_m();
  const Swept ahead = bodies.sweep(curve_way(settings, from, false, stride_m));
  const Swept back = bodies.sweep(curve_way(settings, from, true, stride_m));
  const Swept left = bodies.sweep(pivot_steps(from.pose, looked_around_rad(true, track)));
  const Swept right = bodies.sweep(pivot_steps(from.pose, looked_around_rad(false, track)));
  found.ahead_m = ahead.end.way.free_m;
  found.back_m = back.end.way.free_m;
  found.left_rad = turn_rad(left.end.way);
  found.right_rad = turn_rad(right.end.way);
  found.bare = {0, ahead.bare.free_m, back.bare.free_m, turn_rad(left.bare), turn_rad(right.bare)};
  if (settings.aside) look_aside(bodies, settings, from, found);
  if (is_turn(from.twist)) {
    const bool to_left = from.twist.wz_radps > 0;
    const WayEnd& end = to_left ? left.end : right.end;
    if (end.way.blocked) found.turn = in_turn_words(bodies, end, end.way.free_rad, to_left);
    found.first = found.turn;
    return;
  }
  const bool backwards = from.twist.vx_mps < 0;
  if (!asks_straight(from.twist, backwards)) return;
  const WayEnd& end = backwards ? back.end : ahead.end;
  if (end.way.blocked) found.first = in_words(bodies, end, backwards ? "back" : "ahead");
}

void look_along(const Bodies& bodies, const LookSettings& settings, const Standpoint& from,
                std::span<const Step> track, Clearance& found) {
  const auto [end, bare] = bodies.sweep({track.begin(), track.end()});
  const bool whole = is_whole(settings, from);
  found.along_m = !end.way.blocked && whole ? kFree : end.way.free_m;
  found.bare.along_m = !bare.blocked && whole ? kFree : bare.free_m;
  found.first.clear();
  if (!end.way.blocked) return;
  const double turned_rad = wrap_rad(end.way.pose.yaw_rad - from.pose.yaw_rad);
  if (const double turn = in_first_turn(from.twist, track, end.way.free_m); turn != 0)
    found.first = in_turn_words(bodies, end, std::abs(turned_rad), turn > 0);
  else
    found.first = in_words(bodies, end, "along the track");
}

}  // namespace

std::vector<Step> curve_steps(const Pose2& from, const Twist& twist, bool back, double length_m,
                              double stride_m) {
  const Twist curve = drives(twist) ? twist : Twist{1, 0};
  const double v_mps = (back ? -1 : 1) * std::abs(curve.vx_mps);
  const double wz_radps = curve.wz_radps * (v_mps * curve.vx_mps < 0 ? -1 : 1);
  return twist_steps(from, v_mps, wz_radps, length_m, stride_m);
}

std::vector<Step> curve_way(const LookSettings& settings, const Standpoint& from, bool back,
                            double stride_m) {
  auto steps = curve_steps(from.pose, from.twist, back, settings.ahead_m, stride_m);
  if (from.path != 0) return steps;
  const double aside = thrown_aside(settings, from.yaw_sigma_rad);
  for (Step& step : steps) step.off_m = aside * step.driven_m;
  return steps;
}

std::vector<Step> aside_way(const LookSettings& settings, const Standpoint& from, bool left,
                            double stride_m) {
  Pose2 across = from.pose;
  across.yaw_rad += left ? kPi / 2 : -kPi / 2;
  auto steps = twist_steps(across, 1, 0, settings.ahead_m, stride_m);
  const double off = thrown_aside(settings, from.yaw_sigma_rad);
  for (Step& step : steps) {
    step.pose.yaw_rad = from.pose.yaw_rad;
    step.off_m = off * step.driven_m;
  }
  return steps;
}

std::vector<Step> track_way(const LookSettings& settings, const Standpoint& from) {
  if (from.path == 0 || from.line.empty() || !has_heading(from) ||
      !position_problem(from.pose, from.position_sigma_m).empty())
    return {};
  const Piece body = body_of(settings, from.position_sigma_m, from.yaw_sigma_rad);
  const TrackPart part{from.line, from.line_from_m, settings.along_m, from.line_backwards};
  return track_steps(from.pose, part, settings.steering, stride_m(body));
}

double first_turn_rad(std::span<const Step> track) {
  const auto turns = [track](std::size_t i) { return track[i].driven_m == track[i - 1].driven_m; };
  std::size_t i = 1;
  while (i < track.size() && track[i].driven_m <= kTurnsAt_m && !turns(i)) ++i;
  if (i >= track.size() || !turns(i)) return 0;
  while (i + 1 < track.size() && turns(i + 1)) ++i;
  return wrap_rad(track[i].pose.yaw_rad - track.front().pose.yaw_rad);
}

double looked_around_rad(bool left, std::span<const Step> track) {
  const double sign = left ? 1 : -1;
  const double turn_rad = sign * first_turn_rad(track);
  return sign * (turn_rad > 0 ? std::min(turn_rad + kTurnsOver_rad, kPi) : kPi);
}

double in_first_turn(const Twist& twist, std::span<const Step> track, double free_m) {
  if (free_m >= kHere_m) return 0;
  if (is_turn(twist)) return twist.wz_radps;
  for (std::size_t i = 1; i < track.size() && track[i - 1].driven_m <= free_m; ++i)
    if (track[i - 1].driven_m == free_m && track[i].driven_m == free_m)
      return first_turn_rad(track);
  return 0;
}

bool shorten(double& way, double& bare, double free) {
  bare = std::min(bare, free);
  if (way <= free) return false;
  way = free;
  return true;
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
  return widened(body, thrown_aside(settings, yaw_sigma_rad) * reach_m(body.corners));
}

Clearance look(const Surroundings& around, const LookSettings& settings, const Standpoint& from,
               std::span<const Step> track) {
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
  const Bodies bodies(around, settings, from);
  look_around(bodies, settings, from, track, found);
  if (from.path != 0) look_along(bodies, settings, from, track, found);
  return found;
}

}  // namespace drover::scene
