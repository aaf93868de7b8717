// Where a route is too tight for a robot that steers.
#include "track/tight.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "track/legs.h"

namespace drover::track {
namespace {

constexpr double kReach_m = 1.0;  // a curve is seen over that, to each side
constexpr double kEach_m = 0.25;
// What a robot that goes on the other way may be turned against its next leg.
constexpr double kCrooked_rad = 0.35;  // 20 degrees
constexpr double kRecorded = 1.05;     // noise of a recording

/// Of the circle through three points.
double curvature_radpm(Vector a, Vector b, Vector c) {
  const double sides = length(b - a) * length(c - b) * length(c - a);
  return sides > 0 ? 2 * std::abs(cross(b - a, c - b)) / sides : 0;
}

/// Of two directions.
double between_rad(Vector a, Vector b) {
  return std::abs(std::atan2(cross(a, b), dot(a, b)));
}

Tight find_curve(const Route& route, const Leg& leg, double radius_m) {
  Station behind{leg.first, leg.first_m};
  Station here = behind;
  Station ahead = behind;
  Tight tightest;
  // At its ends it goes on straight: what is seen there of a curve is a part of it.
  for (double s_m = leg.first_m; s_m <= leg.last_m; s_m += kEach_m) {
    const Vector a = position(route, leg, behind, s_m - kReach_m);
    const Vector b = position(route, leg, here, s_m);
    const Vector c = position(route, leg, ahead, s_m + kReach_m);
    const double radpm = curvature_radpm(a, b, c);
    if (!(radpm * radius_m > kRecorded)) {
      if (tightest.kind != Tight::Kind::none) break;
      continue;
    }
    if (tightest.kind != Tight::Kind::none && radpm * tightest.radius_m <= 1) continue;
    const bool nearer_next =
        here.segment + 1 < route.size() && s_m - here.start_m > route.segment_m(here.segment) / 2;
    tightest = {Tight::Kind::curve, route.index(here.segment + (nearer_next ? 1 : 0)), 0,
                1 / radpm};
  }
  return tightest;
}

}  // namespace

Tight find_tight(const Route& route, std::size_t first, double sharp_rad, double radius_m) {
  double end_m = 0;
  for (std::size_t k = first; k + 1 < route.size(); ++k) end_m += route.segment_m(k);
  Leg leg = leg_to_target(route, first, 0, end_m);
  CornerScan scan{{first, 0}, 0};
  while (true) {
    const Station corner = find_corner(route, leg, sharp_rad, end_m, scan);
    const bool last = corner.segment == 0;
    if (!last) leg = leg_to_corner(route, leg, corner);
    if (const Tight curve = find_curve(route, leg, radius_m); curve.kind != Tight::Kind::none)
      return curve;
    if (last) return {};
    const Leg next = leg_to_target(route, corner.segment, corner.start_m, end_m);
    const double turn_rad = between_rad(leg.leave, next.enter);
    const bool other_way = is_backwards(route, leg) != is_backwards(route, next);
    const double turned_rad = other_way ? std::numbers::pi - turn_rad : turn_rad;
    if (turned_rad > kCrooked_rad)
      return {Tight::Kind::corner, route.index(corner.segment), turned_rad, 0};
    leg = next;
  }
}

}  // namespace drover::track
