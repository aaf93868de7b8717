// A second opinion on whether a body and a robot overlap, on other principles than the product's
// sections and separating axes: in space, with a proof either way. Projecting by turns onto the one
// and the other convex body finds a point of both, or a plane between them; each of the two proves
// itself. Nothing of the product but its messages is used.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include "scene/message/header.h"
#include "scene/message/shapes.h"

namespace drover::scene::witness {

struct Xyz {
  double x = 0;
  double y = 0;
  double z = 0;
};
inline Xyz operator+(Xyz a, Xyz b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
inline Xyz operator-(Xyz a, Xyz b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
inline Xyz operator*(double k, Xyz a) {
  return {k * a.x, k * a.y, k * a.z};
}
inline double dot(Xyz a, Xyz b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
inline double norm(Xyz a) {
  return std::sqrt(dot(a, a));
}

/// Nearest point of a convex polygon (counter-clockwise), and the farthest in a direction.
struct Polygon {
  std::vector<std::array<double, 2>> corners;

  std::array<double, 2> nearest(double x, double y) const {
    bool inside = true;
    std::array<double, 2> best{};
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const auto [ax, ay] = corners[i];
      const auto [bx, by] = corners[(i + 1) % corners.size()];
      const double ux = bx - ax;
      const double uy = by - ay;
      if (ux * (y - ay) - uy * (x - ax) < 0) inside = false;
      const double part =
          std::clamp((ux * (x - ax) + uy * (y - ay)) / (ux * ux + uy * uy), 0.0, 1.0);
      const std::array<double, 2> there{ax + part * ux, ay + part * uy};
      const double away = std::hypot(there[0] - x, there[1] - y);
      if (away >= least) continue;
      least = away;
      best = there;
    }
    return inside ? std::array<double, 2>{x, y} : best;
  }
  double reach(double x, double y) const {
    double most = -std::numeric_limits<double>::infinity();
    for (const auto& corner : corners) most = std::max(most, x * corner[0] + y * corner[1]);
    return most;
  }
};

/// The robot: what is within `margin` of a polygon, seen from above, between two heights.
struct Robot {
  Polygon footprint;  ///< in map
  double margin = 0;
  double low = 0;
  double high = 0;

  Xyz nearest(Xyz p) const {
    const auto [x, y] = footprint.nearest(p.x, p.y);
    const double away = std::hypot(p.x - x, p.y - y);
    const double part = away > margin ? margin / away : 1;
    return {x + part * (p.x - x), y + part * (p.y - y), std::clamp(p.z, low, high)};
  }
  double reach(Xyz d) const {
    return footprint.reach(d.x, d.y) + margin * std::hypot(d.x, d.y) +
           std::max(d.z * low, d.z * high);
  }
};

/// A primitive with its pose.
struct Body {
  SolidPrimitive shape;
  Pose pose;

  Xyz nearest(Xyz p) const { return out(nearest_inside(in(p))); }
  double reach(Xyz d) const {
    return reach_inside(in_direction(d)) +
           dot(d, {pose.position_m.x, pose.position_m.y, pose.position_m.z});
  }

 private:
  using P = SolidPrimitive;

  /// By Rodrigues' form of a quaternion's turn, not by a matrix.
  static Xyz turn(const Quaternion& q, Xyz v) {
    const Xyz u{q.x, q.y, q.z};
    const auto crossed = [](Xyz a, Xyz b) {
      return Xyz{a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
    };
    const Xyz t = 2.0 * crossed(u, v);
    return v + q.w * t + crossed(u, t);
  }
  Xyz in_direction(Xyz d) const {
    const Quaternion& q = pose.orientation;
    return turn({q.w, -q.x, -q.y, -q.z}, d);
  }
  Xyz in(Xyz p) const {
    return in_direction(p - Xyz{pose.position_m.x, pose.position_m.y, pose.position_m.z});
  }
  Xyz out(Xyz p) const {
    return turn(pose.orientation, p) + Xyz{pose.position_m.x, pose.position_m.y, pose.position_m.z};
  }
  /// Cylinder and cone as what turns round the axis: radius over height.
  Polygon profile() const {
    const double h = 0.5 * shape.dimensions[0];
    const double r = shape.dimensions[1];
    if (shape.type == P::CONE) return {{{0, -h}, {r, -h}, {0, h}}};
    return {{{0, -h}, {r, -h}, {r, h}, {0, h}}};
  }
  Xyz nearest_inside(Xyz p) const {
    const auto& d = shape.dimensions;
    if (shape.type == P::BOX)
      return {std::clamp(p.x, -d[0] / 2, d[0] / 2), std::clamp(p.y, -d[1] / 2, d[1] / 2),
              std::clamp(p.z, -d[2] / 2, d[2] / 2)};
    if (shape.type == P::SPHERE) return norm(p) > d[0] ? d[0] / norm(p) * p : p;
    const double r = std::hypot(p.x, p.y);
    const auto [radius, height] = profile().nearest(r, p.z);
    return r > 0 ? Xyz{p.x * radius / r, p.y * radius / r, height} : Xyz{radius, 0, height};
  }
  double reach_inside(Xyz v) const {
    const auto& d = shape.dimensions;
    if (shape.type == P::BOX)
      return 0.5 * (std::abs(v.x) * d[0] + std::abs(v.y) * d[1] + std::abs(v.z) * d[2]);
    if (shape.type == P::SPHERE) return d[0] * norm(v);
    return profile().reach(std::hypot(v.x, v.y), v.z);
  }
};

enum class Verdict { overlap, apart, unknown };

/// overlap: a point was found that is in both. apart: a plane was found with both strictly beside
/// it. unknown: they nearly touch.
inline Verdict judge(const Body& body, const Robot& robot, int turns = 500) {
  constexpr double kSame = 1e-9;
  Xyz p = robot.nearest({body.pose.position_m.x, body.pose.position_m.y, body.pose.position_m.z});
  for (int i = 0; i < turns; ++i) {
    const Xyz on_body = body.nearest(p);
    const Xyz gap = on_body - p;
    if (norm(gap) < kSame) return Verdict::overlap;
    if (robot.reach(gap) + body.reach(-1.0 * gap) < 0) return Verdict::apart;
    // Beyond the body is still towards both, and sooner in both.
    p = robot.nearest(p + (i % 8 == 7 ? 1.0 : 1.9) * gap);
  }
  return Verdict::unknown;
}

}  // namespace drover::scene::witness
