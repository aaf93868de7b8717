#include "scene/constraint/edge.h"

#include <cmath>
#include <utility>

#include "drover/angle.h"
#include "scene/constraint/evaluate.h"
#include "scene/constraint/kinds.h"
#include "scene/message/frames.h"

namespace drover::scene {
namespace {

// What judging at one place costs, in points against primitives: some 70 ns each.
constexpr double kMostCost = 320;
constexpr double kMarginCost = 16;             // a position's margin is a circle of points
constexpr double kVerticesOfAPrimitive = 1.5;  // of a hull, that cost as much
constexpr int kHalvings = 8;                   // of a step of 25 cm: a millimetre
constexpr double kResolved_m = 1e-3;
constexpr int kDirections = 16;

double cost_of(const PositionConstraint& position) {
  double shapes = static_cast<double>(position.constraint_region.primitives.size());
  for (const Mesh& mesh : position.constraint_region.meshes)
    shapes += 1 + static_cast<double>(mesh.vertices.size()) / kVerticesOfAPrimitive;
  return kMarginCost * shapes;
}

/// By its number in the set; 0: a place alone does not break it.
double cost_of(const Constraints& set, std::size_t i) {
  const std::size_t joints = set.joint_constraints.size();
  const std::size_t positions = set.position_constraints.size();
  if (i < joints) return is_of_base(set.joint_constraints[i]) ? 1 : 0;
  if (i < joints + positions) return cost_of(set.position_constraints[i - joints]);
  return i < joints + positions + set.orientation_constraints.size() ? 1 : 0;
}

/// What a turn on the spot changes nothing of.
bool is_of_point(const Constraints& set, std::size_t i) {
  const std::size_t joints = set.joint_constraints.size();
  if (i < joints) return set.joint_constraints[i].joint_name != "base/theta";
  if (i - joints >= set.position_constraints.size()) return false;
  const PositionConstraint& position = set.position_constraints[i - joints];
  const Vector3& offset = position.target_point_offset;
  return same_frame(position.link_name, kBaseLink) && offset.x == 0 && offset.y == 0 &&
         is_global_frame(position.header.frame_id);
}

/// A region that does not go along with the robot.
bool is_on_earth(const Constraints& set, std::size_t i) {
  const std::size_t joints = set.joint_constraints.size();
  if (i < joints || i - joints >= set.position_constraints.size()) return false;
  return is_global_frame(set.position_constraints[i - joints].header.frame_id);
}

}  // namespace

Edges::Edges(const World& world, const RobotModel& robot, const Terms& terms, const Pose2& here)
    : world_(world), robot_(robot), terms_(terms) {
  double cost = 0;
  for (const ConstraintSet& set : world.constraints()) {
    for (std::size_t i = 0; i < count_of(set.message); ++i) {
      const double own = cost_of(set.message, i);
      if (own == 0 || cost + own > kMostCost) continue;
      const Bound bound{&set, i, is_of_point(set.message, i)};
      cost += own;
      if (broken(bound, here).empty()) bounds_.push_back(bound);
    }
  }
}

std::string Edges::broken(const Bound& bound, const Pose2& at) const {
  return broken(bound, at, terms_);
}

std::string Edges::broken(const Bound& bound, const Pose2& at, const Terms& terms) const {
  RobotState state;
  state.base = at;
  std::string which;
  judge_one(bound.set->message, bound.item,
            setting_of(*bound.set, world_, robot_, state, terms, Moment::ahead), false,
            [&which](const Verdict& verdict) {
              if (!verdict.holds) which = verdict.which;
            });
  return which;
}

std::string Edges::broken_about(const Bound& bound, const Pose2& at, double moved_m) const {
  // Of a region on earth all of a disc must be in one shape: who may be moved has a larger disc.
  if (is_on_earth(bound.set->message, bound.item)) {
    Terms terms = terms_;
    terms.extent.margin_m += moved_m;
    return broken(bound, at, terms);
  }
  // What else a place breaks is beyond one or two straight lines, of any direction in the map.
  const double reach_m = moved_m / std::cos(kPi / kDirections);
  for (int i = 0; i < kDirections; ++i) {
    const Point2 there = place_of(at) + reach_m * direction(2 * kPi * i / kDirections);
    if (auto which = broken(bound, {there.x_m, there.y_m, at.yaw_rad}); !which.empty())
      return which;
  }
  return {};
}

std::string Edges::broken_about(const Pose2& at, double moved_m) const {
  for (const Bound& bound : bounds_)
    if (auto which = broken_about(bound, at, moved_m); !which.empty()) return which;
  return {};
}

std::optional<Edge> Edges::around(const Pose2& here, double most_m) const {
  std::string which = broken_about(here, most_m);
  if (which.empty()) return std::nullopt;
  double holds_m = 0;
  double breaks_m = most_m;
  while (breaks_m - holds_m > kResolved_m) {
    const double middle_m = 0.5 * (holds_m + breaks_m);
    auto there = broken_about(here, middle_m);
    if (there.empty()) {
      holds_m = middle_m;
    } else {
      breaks_m = middle_m;
      which = std::move(there);
    }
  }
  return Edge{.driven_m = holds_m, .which = std::move(which)};
}

double Edges::last_held(const Bound& bound, const Pose2& from, const Pose2& to) const {
  double holds = 0;
  double breaks = 1;
  for (int n = 0; n < kHalvings; ++n) {
    const double middle = 0.5 * (holds + breaks);
    (broken(bound, between(from, to, middle)).empty() ? holds : breaks) = middle;
  }
  return holds;
}

std::optional<Edge> Edges::first(std::span<const Step> steps) const {
  const bool on_the_spot = !steps.empty() && steps.back().driven_m == 0;
  for (std::size_t i = 1; i < steps.size(); ++i) {
    const Step& from = steps[i - 1];
    const Step& to = steps[i];
    double least = 1;  // of several that break within this step the nearest
    std::string first;
    for (const Bound& bound : bounds_) {
      if (on_the_spot && bound.of_point) continue;
      std::string which = broken(bound, to.pose);
      if (which.empty()) continue;
      const double holds = last_held(bound, from.pose, to.pose);
      if (!first.empty() && holds >= least) continue;
      least = holds;
      first = std::move(which);
    }
    if (!first.empty())
      return Edge{from.driven_m + least * (to.driven_m - from.driven_m),
                  from.turned_rad + least * (to.turned_rad - from.turned_rad), std::move(first)};
  }
  return std::nullopt;
}

}  // namespace drover::scene
