// A polyline as it is driven: walking along it, its true corners, and a smooth line through it.
#include "track/path_geometry.h"

#include <algorithm>

namespace drover::track {
namespace {

constexpr double kShortestChord_m = 0.10;
constexpr double kCornerChord_m = 0.25;

/// Means of the line over [from, to]: plain, and weighted by a ramp from `w_from` to `w_to`.
struct Window {
  Vector mean;
  Vector weighted;
  Vector start;
  Vector end;
};

Window integrate(const Route& route, const Leg& leg, Station& station, double from_m, double to_m,
                 double w_from, double w_to) {
  const double width_m = to_m - from_m;
  const auto weight = [&](double s) { return w_from + (w_to - w_from) * (s - from_m) / width_m; };
  Window sum;
  double a_m = from_m;
  Vector a = position(route, leg, station, a_m);
  sum.start = a;
  while (a_m < to_m) {
    // The end of the straight piece that holds a: an end of the leg, a point, or the window's.
    double b_m = to_m;
    if (a_m < leg.first_m) {
      b_m = std::min(b_m, leg.first_m);
    } else if (a_m < leg.last_m) {
      station = seek(route, leg, station, a_m);
      double end_m = station.start_m + route.segment_m(station.segment);
      while (end_m <= a_m && station.segment + 1 < leg.last) {
        station = {station.segment + 1, end_m};
        end_m += route.segment_m(station.segment);
      }
      if (end_m > a_m) b_m = std::min(b_m, end_m);
    }
    const Vector b = position(route, leg, station, b_m);
    const Vector middle = 0.5 * (a + b);
    const double part = (b_m - a_m) / width_m;
    const double w_middle = weight(0.5 * (a_m + b_m));
    sum.mean = sum.mean + part * middle;
    // Simpson's rule is exact here: a linear weight on a linear piece.
    sum.weighted =
        sum.weighted + part / 6 * (weight(a_m) * a + 4 * w_middle * middle + weight(b_m) * b);
    a_m = b_m;
    a = b;
  }
  sum.end = a;
  return sum;
}

Vector chord(Vector from, Vector to) {
  const Vector d = to - from;
  const double d_m = length(d);
  return d_m < kShortestChord_m ? Vector{} : 1 / d_m * d;
}

}  // namespace

Vector unit(Vector a, Vector otherwise) {
  const double a_m = length(a);
  return a_m > 1e-9 ? 1 / a_m * a : otherwise;
}

Station seek(const Route& route, const Leg& leg, Station station, double s_m) {
  while (station.segment > leg.first && s_m < station.start_m) {
    --station.segment;
    station.start_m -= route.segment_m(station.segment);
  }
  while (station.segment + 1 < leg.last) {
    const double end_m = station.start_m + route.segment_m(station.segment);
    if (s_m <= end_m) break;
    station = {station.segment + 1, end_m};
  }
  return station;
}

Vector position(const Route& route, const Leg& leg, Station& station, double s_m) {
  if (s_m < leg.first_m) return route.point(leg.first) + (s_m - leg.first_m) * leg.enter;
  if (s_m > leg.last_m) return route.point(leg.last) + (s_m - leg.last_m) * leg.leave;
  station = seek(route, leg, station, s_m);
  const Vector a = route.point(station.segment);
  const Vector b = route.point(station.segment + 1);
  const double ab_m = length(b - a);
  if (ab_m <= 0) return a;
  return a + std::clamp((s_m - station.start_m) / ab_m, 0.0, 1.0) * (b - a);
}

Vector chord_before(const Route& route, std::size_t point, std::size_t first, double reach_m) {
  const Vector here = route.point(point);
  for (double left_m = reach_m; point > first; --point) {
    const double step_m = route.segment_m(point - 1);
    if (step_m >= left_m) {
      const Vector back = route.point(point - 1) - route.point(point);
      return chord(route.point(point) + left_m / step_m * back, here);
    }
    left_m -= step_m;
  }
  return chord(route.point(point), here);
}

Vector chord_after(const Route& route, std::size_t point, std::size_t last, double reach_m) {
  const Vector here = route.point(point);
  for (double left_m = reach_m; point < last; ++point) {
    const double step_m = route.segment_m(point);
    if (step_m >= left_m) {
      const Vector on = route.point(point + 1) - route.point(point);
      return chord(here, route.point(point) + left_m / step_m * on);
    }
    left_m -= step_m;
  }
  return chord(here, route.point(point));
}

double corner_rad(const Route& route, std::size_t point, std::size_t first) {
  const Vector before = chord_before(route, point, first, kCornerChord_m);
  const Vector after = chord_after(route, point, route.size() - 1, kCornerChord_m);
  if (dot(before, before) == 0 || dot(after, after) == 0) return 0;
  return std::abs(std::atan2(cross(before, after), dot(before, after)));
}

Reference smooth(const Route& route, const Leg& leg, Station station, double s_m) {
  constexpr double h_m = kSmoothing_m;
  const Window behind = integrate(route, leg, station, s_m - h_m, s_m, 0, 1);
  const Window ahead = integrate(route, leg, station, s_m, s_m + h_m, 1, 0);
  const Vector slope = 1 / h_m * (ahead.mean - behind.mean);
  const Vector bend = 1 / (h_m * h_m) * (ahead.end - 2 * behind.end + behind.start);
  const double slope_size = std::max(length(slope), 0.3);
  Reference r;
  r.ahead = unit(slope, leg.enter);
  r.curvature_radpm = cross(slope, bend) / (slope_size * slope_size * slope_size);
  // The mean under the triangle of an arc lies this much inside of it.
  const double cut_m = std::clamp(r.curvature_radpm, -4.0, 4.0) * h_m * h_m / 12;
  r.point = behind.weighted + ahead.weighted + cut_m * Vector{r.ahead.y, -r.ahead.x};
  return r;
}

double foot_m(const Route& route, const Leg& leg, Station station, double s_m, Vector point,
              int iterations) {
  for (int i = 0; i < iterations; ++i) {
    station = seek(route, leg, station, s_m);
    const Reference r = smooth(route, leg, station, s_m);
    const Vector off = point - r.point;
    const double stretch = std::clamp(1 - r.curvature_radpm * cross(r.ahead, off), 0.3, 3.0);
    const double step_m = std::clamp(dot(r.ahead, off) / stretch, -0.25, 0.25);
    s_m += step_m;
    if (std::abs(step_m) < 1e-4) break;
  }
  return s_m;
}

double offset_m(const Route& route, const Leg& leg, Station station, double s_m, Vector point) {
  constexpr double kWindow_m = 0.6;
  const Reference r = smooth(route, leg, station, s_m);
  if (s_m <= leg.first_m || s_m >= leg.last_m) return cross(r.ahead, point - r.point);
  station = seek(route, leg, station, s_m - kWindow_m);
  Vector best;
  double best_m2 = INFINITY;
  while (true) {
    const Vector a = route.point(station.segment);
    const Vector ab = route.point(station.segment + 1) - a;
    const double ab_m2 = dot(ab, ab);
    const double t = ab_m2 > 0 ? std::clamp(dot(point - a, ab) / ab_m2, 0.0, 1.0) : 0.0;
    const Vector off = point - (a + t * ab);
    if (dot(off, off) < best_m2) {
      best_m2 = dot(off, off);
      best = off;
    }
    const double end_m = station.start_m + std::sqrt(ab_m2);
    if (end_m > s_m + kWindow_m || station.segment + 1 >= leg.last) break;
    station = {station.segment + 1, end_m};
  }
  return std::copysign(std::sqrt(best_m2), cross(r.ahead, best));
}

}  // namespace drover::track
