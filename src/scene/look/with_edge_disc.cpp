#include "scene/look/with_edge_disc.h"

#include <algorithm>

namespace drover::scene {
namespace {

constexpr std::size_t kShownOfEdge = 90;

Reason edge_away(const Edge& edge) {
  const FixedText<kShownOfEdge> shown(edge.which);
  Reason words;
  words.format("the edge of constraint %.*s is %.2f m away", static_cast<int>(shown.view().size()),
               shown.view().data(), edge.driven_m);
  return words;
}

}  // namespace

Clearance with_edge_disc(Clearance found, const Edges& edges, const LookSettings& settings,
                         const Standpoint& from) {
  const auto edge = edges.around(from.pose, settings.ahead_m);
  if (!edge) return found;
  const double left_m = std::max(edge->driven_m - settings.margin_m, 0.0);
  if (left_m < std::max(found.ahead_m, found.back_m)) found.first = edge_away(*edge);
  for (double* const way_m :
       {&found.ahead_m, &found.back_m, &found.bare.ahead_m, &found.bare.back_m})
    *way_m = std::min(*way_m, left_m);
  return found;
}

}  // namespace drover::scene
