// What a driver that moves something may send at all.
#pragma once

#include <algorithm>

#include "drover/actuator.h"

namespace drover::fuzz {

inline bool on_list(const Actuator& actuator, const CanFrame& frame) {
  const auto rules = actuator.rules();
  return std::any_of(rules.begin(), rules.end(), [&](const FrameRule& rule) {
    return rule.id == frame.id && !frame.extended && frame.len >= rule.min_len &&
           frame.len <= rule.max_len;
  });
}

}  // namespace drover::fuzz
