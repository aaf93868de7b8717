// How the peer's settings are found: one after the other, what makes its errors least, twice.
#pragma once

#include <cmath>
#include <vector>

#include "bench/usual_filter.h"

namespace drover::bench {

/// `error` of settings is to be least.
template <class Error>
UsualTuning tuned(UsualTuning best, const Error& error) {
  struct Choice {
    double UsualTuning::*value;
    std::vector<double> of;
  };
  const std::vector<Choice> choices{
      {&UsualTuning::gate_sigma, {3, 5, 8, 1e6}},
      {&UsualTuning::gnss_scale, {1, 2, 4}},
      {&UsualTuning::heading_rad2, {1e-7, 1e-6, 1e-5, 1e-4}},
      {&UsualTuning::place_m2, {1e-6, 1e-5, 1e-4, 1e-3}},
      {&UsualTuning::speed_m2ps2, {0.01, 0.1, 1}},
      {&UsualTuning::rate_rad2ps2, {0.1, 1, 10}},
      {&UsualTuning::acceleration_m2ps4, {0.1, 1}},
      {&UsualTuning::wheel_yaw_radps, {0.1, 0.5}},
  };
  double least = error(best);
  for (int pass = 0; pass < 2; ++pass) {
    for (const Choice& choice : choices) {
      for (const double value : choice.of) {
        if (value == best.*choice.value) continue;
        UsualTuning tried = best;
        tried.*choice.value = value;
        const double now = error(tried);
        if (!(now < least)) continue;
        least = now;
        best = tried;
      }
    }
  }
  return best;
}

}  // namespace drover::bench
