#include "scene/look/with_edges.h"

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

namespace drover::scene {
namespace {

constexpr double kMargin_rad = 0.05;
constexpr double kTurnStep_rad = to_rad(8.0);  // a point 1 m away is 3 mm farther out in between
constexpr std::size_t kShownEdge = 90;

double left_before(double edge, double margin) {
  return std::max(edge - margin, 0.0);
}

Reason edge_ahead(const std::string& which, const char* where, double way_m) {
  const FixedText<kShownEdge> shown(which);
  Reason words;
  words.format("the edge of constraint %.*s is %.2f m %s", static_cast<int>(shown.view().size()),
               shown.view().data(), way_m, where);
  return words;
}

Reason edge_in_turn(const std::string& which, double turn_rad, bool left) {
  const FixedText<kShownEdge> shown(which);
  Reason words;
  words.format("the edge of constraint %.*s is after %.0f deg of the turn to the %s",
               static_cast<int>(shown.view().size()), shown.view().data(), to_deg(turn_rad),
               left ? "left" : "right");
  return words;
}

/// The edge that makes the way shorter. What all errors leave free the margin alone does, too.
std::optional<Edge> end_at_edge(double& way, double& bare, std::span<const Step> steps,
                                const EdgesToKeep& edges, double Edge::*measure, double margin) {
  auto edge = edges.all.first(steps);
  if (!edge) return std::nullopt;
  if (const auto truly = edges.bare.first(steps))
    bare = std::min(bare, left_before((*truly).*measure, margin));
  const double left = left_before((*edge).*measure, margin);
  if (!(left < way)) return std::nullopt;
  way = left;
  return edge;
}

/// To what is looked at of a way, or a step farther.
std::span<const Step> begin_of(std::span<const Step> track, double most_m) {
  std::size_t count = 0;
  while (count < track.size() && (count == 0 || track[count - 1].driven_m < most_m)) ++count;
  return track.first(count);
}

void bound_track(Clearance& found, std::span<const Step> track, const EdgesToKeep& edges,
                 double margin_m) {
  const auto edge =
      end_at_edge(found.along_m, found.bare.along_m, track, edges, &Edge::driven_m, margin_m);
  if (!edge) return;
  if (const double turn = in_first_turn(found.twist, track, edge->driven_m); turn != 0)
    found.first = found.turn = edge_in_turn(edge->which, edge->turned_rad, turn > 0);
  else
    found.first = edge_ahead(edge->which, "along the track", edge->driven_m);
}

/// `asked`: it goes there, or would.
void bound_way(double& way_m, double& bare_m, bool asked, const char* where, Clearance& found,
               std::span<const Step> steps, const EdgesToKeep& edges, double margin_m) {
  const auto edge = end_at_edge(way_m, bare_m, steps, edges, &Edge::driven_m, margin_m);
  if (edge && asked) found.first = edge_ahead(edge->which, where, edge->driven_m);
}

void bound_straight(bool back, Clearance& found, std::span<const Step> steps,
                    const EdgesToKeep& edges, double margin_m) {
  bound_way(back ? found.back_m : found.ahead_m, back ? found.bare.back_m : found.bare.ahead_m,
            asks_straight(found.twist, back), back ? "back" : "ahead", found, steps, edges,
            margin_m);
}

void bound_aside(bool left, Clearance& found, std::span<const Step> steps, const EdgesToKeep& edges,
                 double margin_m) {
  bound_way(left ? found.aside_left_m : found.aside_right_m,
            left ? found.bare.aside_left_m : found.bare.aside_right_m,
            asks_aside(found.twist, left), left ? "to the left" : "to the right", found, steps,
            edges, margin_m);
}

void bound_turn(bool left, Clearance& found, const Pose2& from, const EdgesToKeep& edges) {
  std::vector<Step> steps;
  for (const Step& step : pivot_steps(from, left ? kPi : -kPi))
    if (steps.empty() || step.turned_rad > steps.back().turned_rad + kTurnStep_rad)
      steps.push_back(step);
  double& way_rad = left ? found.left_rad : found.right_rad;
  double& bare_rad = left ? found.bare.left_rad : found.bare.right_rad;
  const auto edge = end_at_edge(way_rad, bare_rad, steps, edges, &Edge::turned_rad, kMargin_rad);
  const bool asked = is_turn(found.twist) && left == (found.twist.wz_radps > 0);
  if (edge && asked) found.first = found.turn = edge_in_turn(edge->which, edge->turned_rad, left);
}

/// Whoever does not know where he looks keeps off the edge whichever way he drives; a turn takes
/// nothing out of what already holds wherever it looks.
Clearance bound_any_way(Clearance found, const Edges& edges, const LookSettings& settings,
                        const Standpoint& from) {
  const auto edge = edges.around(from.pose, settings.ahead_m);
  if (!edge) return found;
  const double left_m = left_before(edge->driven_m, settings.margin_m);
  if (left_m < std::max(found.ahead_m, found.back_m))
    found.first = edge_ahead(edge->which, "away", edge->driven_m);
  for (double* const way_m : {&found.ahead_m, &found.back_m, &found.aside_left_m,
                              &found.aside_right_m, &found.bare.ahead_m, &found.bare.back_m,
                              &found.bare.aside_left_m, &found.bare.aside_right_m})
    *way_m = std::min(*way_m, left_m);
  return found;
}

}  // namespace

Clearance with_edges(Clearance found, const EdgesToKeep& edges, const LookSettings& settings,
                     const Standpoint& from, std::span<const Step> track) {
  if (!found.unknown.empty() || edges.all.empty()) return found;
  if (from.path != 0) {
    bound_track(found, begin_of(track, settings.ahead_m), edges, settings.margin_m);
    return found;
  }
  if (!is_heading(from.pose.yaw_rad, from.yaw_sigma_rad))
    return bound_any_way(found, edges.all, settings, from);
  const double stride = stride_m(body_of(settings, from.position_sigma_m, from.yaw_sigma_rad));
  for (const bool back : {false, true})
    bound_straight(back, found, curve_way(settings, from, back, stride), edges, settings.margin_m);
  for (const bool left : {true, false}) {
    bound_turn(left, found, from.pose, edges);
    if (!settings.aside) continue;
    bound_aside(left, found, aside_way(settings, from, left, stride), edges, settings.margin_m);
  }
  return found;
}

}  // namespace drover::scene
