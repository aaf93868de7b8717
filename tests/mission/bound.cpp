#include "mission/bound.h"

#include <algorithm>

namespace drover::mission {
namespace {

constexpr double kMoves_mps = 0.02;
constexpr double kTurns_radps = 0.02;
/// Digits, and the way of a message to who stamps it.
constexpr double kRead_m = 0.005;
constexpr double kLongest_s = 0.2;

bool within(const Record& record, Time time) {
  return time >= record.truth.front().time && time <= record.truth.back().time;
}

double until_next_s(const Record& record, std::size_t status) {
  return std::min(to_s(record.statuses[status + 1].time - record.statuses[status].time),
                  kLongest_s);
}

}  // namespace

BeyondBound beyond_bound(const Record& record) {
  BeyondBound beyond;
  for (std::size_t i = 0; i + 1 < record.statuses.size(); ++i) {
    const Status& status = record.statuses[i];
    const auto& nav = status.document.at("nav");
    if (!nav.contains("error_bound_m") || !status.placed || !within(record, status.time)) continue;
    const TruthLine truth = record.truth_at(status.time);
    if (std::abs(truth.vx_mps) <= kMoves_mps) continue;
    const double error_m = std::hypot(status.sim.x_m - truth.x_m, status.sim.y_m - truth.y_m);
    const double over_m = error_m - nav.at("error_bound_m").get<double>();
    if (over_m <= kRead_m) continue;
    beyond.moved_s += until_next_s(record, i);
    beyond.worst_m = std::max(beyond.worst_m, over_m);
  }
  return beyond;
}

Stood stood_in_task(const Record& record) {
  Stood stood;
  bool moved = false;  // in this task: before that it only begins
  bool stands = false;
  for (std::size_t i = 0; i + 1 < record.statuses.size(); ++i) {
    const Status& status = record.statuses[i];
    const bool stood_before = stands;
    stands = false;
    if (status.nav != "NAV_RUN" || !within(record, status.time)) {
      moved = false;
      continue;
    }
    const TruthLine truth = record.truth_at(status.time);
    const bool moves =
        std::abs(truth.vx_mps) > kMoves_mps || std::abs(truth.wz_radps) > kTurns_radps;
    moved = moved || moves;
    stands = moved && !moves && !status.why.empty();
    if (!stands) continue;
    stood.for_s += until_next_s(record, i);
    stood.times += stood_before ? 0 : 1;
  }
  return stood;
}

}  // namespace drover::mission
