#include "mission/bound.h"

#include <algorithm>

namespace drover::mission {
namespace {

constexpr double kMoves_mps = 0.02;
/// Digits, and the way of a message to who stamps it.
constexpr double kRead_m = 0.005;
constexpr double kLongest_s = 0.2;

}  // namespace

BeyondBound beyond_bound(const Record& record) {
  BeyondBound beyond;
  for (std::size_t i = 0; i + 1 < record.statuses.size(); ++i) {
    const Status& status = record.statuses[i];
    const auto& nav = status.document.at("nav");
    if (!nav.contains("error_bound_m") || !status.placed) continue;
    if (status.time < record.truth.front().time || status.time > record.truth.back().time) continue;
    const TruthLine truth = record.truth_at(status.time);
    if (std::abs(truth.vx_mps) <= kMoves_mps) continue;
    const double error_m = std::hypot(status.sim.x_m - truth.x_m, status.sim.y_m - truth.y_m);
    const double over_m = error_m - nav.at("error_bound_m").get<double>();
    if (over_m <= kRead_m) continue;
    beyond.moved_s += std::min(to_s(record.statuses[i + 1].time - status.time), kLongest_s);
    beyond.worst_m = std::max(beyond.worst_m, over_m);
  }
  return beyond;
}

}  // namespace drover::mission
