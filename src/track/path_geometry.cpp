// A polyline as it is driven: walking along it, its true corners, and a smooth line through it.
#include "track/path_geometry.h"

#include <algorithm>

namespace drover::track {
namespace {

constexpr double kShortestChord_m = 0.10;
constexpr double kCornerChord_m = 0.25;
constexpr double kArcPiece_m = kSmoothing_m / 4;

/// So far beyond the end of a leg that ends in an arc; before it where that is negative.
Vector on_arc(const Leg& leg, double out_m) {
  const double bent_m = std::min(out_m, leg.last_m - leg.arc_from_m);
  const double turned_rad = leg.arc_radpm * bent_m;
  const Vector left{-leg.leave.y, leg.leave.x};
  const auto along = [&](double way_m, double rad) {
    return way_m * (std::cos(rad) * leg.leave + std::sin(rad) * left);
  };
  return leg.arc_end + along(chord_m(bent_m, turned_rad), turned_rad / 2) +
         along(out_m - bent_m, turned_rad);
}

/// A walk ahead along a leg. It knows its segment's length, so that a step costs no root.
class Walk final {
 public:
  Walk(const Route& route, const Leg& leg, Station station, double s_m) : route_(route), leg_(leg) {
    enter(seek(route, leg, station, s_m));
  }
  /// Not before the last place.
  Vector at(double s_m) {
    if (s_m < leg_.first_m) return route_.point(leg_.first) + (s_m - leg_.first_m) * leg_.enter;
    if (s_m >= leg_.arc_from_m) return on_arc(leg_, s_m - leg_.last_m);
    if (s_m > leg_.last_m) return route_.point(leg_.last) + (s_m - leg_.last_m) * leg_.leave;
    while (s_m > end_m() && goes_on()) enter({station_.segment + 1, end_m()});
    if (segment_m_ <= 0) return from_;
    return from_ + std::clamp((s_m - station_.start_m) / segment_m_, 0.0, 1.0) * way_;
  }
  /// Of the straight piece that begins at `s_m`: where an end of the leg or a point ends it.
  double straight_until_m(double s_m) {
    if (s_m < leg_.first_m) return leg_.first_m;
    if (s_m >= leg_.arc_from_m) return arc_until_m(s_m);
    if (s_m >= leg_.last_m) return INFINITY;
    while (end_m() <= s_m && goes_on()) enter({station_.segment + 1, end_m()});
    return std::min(end_m() > s_m ? end_m() : INFINITY, leg_.arc_from_m);
  }

 private:
  void enter(Station station) {
    station_ = station;
    from_ = route_.point(station.segment);
    way_ = route_.point(station.segment + 1) - from_;
    segment_m_ = length(way_);
  }
  /// An arc is taken in pieces.
  double arc_until_m(double s_m) const {
    const double past_m = s_m - leg_.arc_from_m;
    if (past_m >= 2 * (leg_.last_m - leg_.arc_from_m)) return INFINITY;
    return leg_.arc_from_m + (std::floor(past_m / kArcPiece_m + 1e-6) + 1) * kArcPiece_m;
  }
  double end_m() const { return station_.start_m + segment_m_; }
  bool goes_on() const { return station_.segment + 1 < leg_.last; }

  const Route& route_;
  const Leg& leg_;
  Station station_;
  Vector from_;
  Vector way_;
  double segment_m_ = 0;
};

/// Means of the line over [from, to]: plain, and weighted by a ramp from `w_from` to `w_to`.
struct Window {
  Vector mean;
  Vector weighted;
  Vector start;
  Vector end;
};

Window integrate(Walk& walk, double from_m, double to_m, double w_from, double w_to) {
  const double per_m = 1 / (to_m - from_m);
  const auto weight = [&](double s) { return w_from + (w_to - w_from) * (s - from_m) * per_m; };
  Window sum;
  double a_m = from_m;
  double w_a = w_from;
  Vector a = walk.at(a_m);
  sum.start = a;
  while (a_m < to_m) {
    const double b_m = std::min(to_m, walk.straight_until_m(a_m));
    const Vector b = walk.at(b_m);
    const double w_b = weight(b_m);
    const double part = (b_m - a_m) * per_m;
    sum.mean = sum.mean + 0.5 * part * (a + b);
    // Exact for a linear weight on a linear piece.
    sum.weighted = sum.weighted + part / 6 * ((2 * w_a + w_b) * a + (w_a + 2 * w_b) * b);
    a_m = b_m;
    w_a = w_b;
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
  if (s_m <= leg.last_m) station = seek(route, leg, station, s_m);
  if (s_m >= leg.arc_from_m) return on_arc(leg, s_m - leg.last_m);
  if (s_m > leg.last_m) return route.point(leg.last) + (s_m - leg.last_m) * leg.leave;
  const Vector a = route.point(station.segment);
  const Vector b = route.point(station.segment + 1);
  const double ab_m = length(b - a);
  if (ab_m <= 0) return a;
  return a + std::clamp((s_m - station.start_m) / ab_m, 0.0, 1.0) * (b - a);
}

void sample(const Route& route, const Leg& leg, Station station, double from_m, double step_m,
            std::span<Vector> places) {
  Walk walk(route, leg, station, from_m);
  for (std::size_t i = 0; i < places.size(); ++i)
    places[i] = walk.at(from_m + step_m * static_cast<double>(i));
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
  Walk walk(route, leg, station, s_m - h_m);
  const Window behind = integrate(walk, s_m - h_m, s_m, 0, 1);
  const Window ahead = integrate(walk, s_m, s_m + h_m, 1, 0);
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

LineFoot find_foot(const Route& route, const Leg& leg, Station station, double s_m, Vector point,
                   int iterations) {
  constexpr double kThere_m = 1e-4;  // over so little the line is an arc
  for (int i = 0; i < iterations; ++i) {
    station = seek(route, leg, station, s_m);
    const Reference r = smooth(route, leg, station, s_m);
    const Vector off = point - r.point;
    const double stretch = std::clamp(1 - r.curvature_radpm * cross(r.ahead, off), 0.3, 3.0);
    const double step_m = std::clamp(dot(r.ahead, off) / stretch, -0.25, 0.25);
    s_m += step_m;
    if (std::abs(step_m) >= kThere_m) continue;
    const Vector left{-r.ahead.y, r.ahead.x};
    const Vector ahead = unit(r.ahead + step_m * r.curvature_radpm * left, r.ahead);
    return {s_m, {r.point + step_m * r.ahead, ahead, r.curvature_radpm}};
  }
  return {s_m, smooth(route, leg, station, s_m)};
}

double offset_m(const Route& route, const Leg& leg, Station station, const LineFoot& foot,
                Vector point) {
  constexpr double kWindow_m = 0.6;
  const double s_m = foot.s_m;
  const Reference& r = foot.line;
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
