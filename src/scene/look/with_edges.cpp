#include "scene/look/with_edges.h"

#include <algorithm>
#include <numbers>
#include <string>
#include <vector>

#include "scene/look/with_edge_disc.h"
#include "scene/plane/sweep.h"

namespace drover::scene {
namespace {

constexpr double kMargin_rad = 0.05;
constexpr double kTurnStep_rad = to_rad(8.0);  // a point 1 m away is 3 mm farther out in between
constexpr std::size_t kShownEdge = 90;

/// Lower, and by an edge. How well the position is known is not in it.
bool end_at(double& way, double& bare, double edge, double margin) {
  const double left = std::max(edge - margin, 0.0);
  bare = std::min(bare, left);
  if (!(left < way)) return false;
  way = left;
  return true;
}

Reason edge_ahead(const std::string& which, const char* where, double way_m) {
  const FixedText<kShownEdge> shown(which);
  Reason words;
  words.format("the edge of constraint %.*s is %.2f m %s", static_cast<int>(shown.view().size()),
               shown.view().data(), way_m, where);
  return words;
}

void bound_way(double& way_m, double& bare_m, std::span<const Step> steps, const Edges& edges,
               double margin_m, const char* where, Reason* first) {
  const auto edge = edges.first(steps);
  if (edge && end_at(way_m, bare_m, edge->driven_m, margin_m) && first != nullptr)
    *first = edge_ahead(edge->which, where, edge->driven_m);
}

void bound_turn(double& turn_rad, double& bare_rad, const Pose2& from, double by_rad,
                const Edges& edges) {
  std::vector<Step> steps;
  for (const Step& step : pivot_steps(from, by_rad))
    if (steps.empty() || step.turned_rad > steps.back().turned_rad + kTurnStep_rad)
      steps.push_back(step);
  const auto edge = edges.first(steps);
  if (edge) end_at(turn_rad, bare_rad, edge->turned_rad, kMargin_rad);
}

}  // namespace

Clearance with_edges(Clearance found, const Edges& edges, const LookSettings& settings,
                     const Standpoint& from) {
  if (!found.unknown.empty() || edges.empty()) return found;
  const double stride = stride_m(body_of(settings, from.position_sigma_m, from.yaw_sigma_rad));
  if (from.path != 0) {
    const TrackPart part{from.line, from.line_from_m, std::min(settings.along_m, settings.ahead_m)};
    bound_way(found.along_m, found.bare.along_m,
              track_steps(from.pose, part, settings.steering, stride), edges, settings.margin_m,
              "along the track", &found.first);
    return found;
  }
  if (!is_heading(from.pose.yaw_rad, from.yaw_sigma_rad))
    return with_edge_disc(found, edges, settings, from);
  const bool backwards = from.twist.vx_mps < 0;
  bound_way(found.ahead_m, found.bare.ahead_m, unguided_steps(settings, from, false, stride), edges,
            settings.margin_m, "ahead", backwards ? nullptr : &found.first);
  bound_way(found.back_m, found.bare.back_m, unguided_steps(settings, from, true, stride), edges,
            settings.margin_m, "back", backwards ? &found.first : nullptr);
  bound_turn(found.left_rad, found.bare.left_rad, from.pose, std::numbers::pi, edges);
  bound_turn(found.right_rad, found.bare.right_rad, from.pose, -std::numbers::pi, edges);
  return found;
}

}  // namespace drover::scene
