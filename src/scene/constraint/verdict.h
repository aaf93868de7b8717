// Whether one constraint holds, and how badly not.
#pragma once

#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace drover::scene {

/// Of one constraint, as its kind says it.
struct Finding {
  bool holds = false;
  /// How far beyond what is allowed, in rad or m; 0 when it holds; infinite when it cannot be
  /// judged, and 1 for a view that something stands in.
  double error = std::numeric_limits<double>::infinity();
  std::string why;  ///< empty when it holds
};

inline Finding holding() {
  return {true, 0, {}};
}
/// What cannot be judged does not hold.
inline Finding unknown(std::string why) {
  return {.why = std::move(why)};
}

struct Verdict {
  bool holds = false;
  double error = 0;
  double weight = 1;  ///< 0 or absent counts as 1: a weight switches nothing off
  std::string which;  ///< like `yard.position_constraints[0] (base_link)`
  std::string why;

  /// Or something is not known that it needs.
  bool can_be_judged() const { return std::isfinite(error); }
};

}  // namespace drover::scene
