// A watch with somebody who answers it twenty times a second.
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "engine/clearance/clearance_watch.h"

namespace drover::engine {

using namespace std::chrono_literals;
using testing::HasSubstr;

class AClearance : public testing::Test {
 protected:
  AClearance() {
    found.path = 7;
    found.along_m = found.ahead_m = found.back_m = 5;
    found.left_rad = found.right_rad = 3;
  }
  /// A cycle; each tenth one an answer, 50 ms old.
  void tick(int cycles = 1) {
    for (int i = 0; i < cycles; ++i) {
      now += 5ms;
      if (answers && count++ % 10 == 0) {
        found.t = now - 50ms;
        found.twist = input.commanded;
        watch.on_clearance(found);
      }
      input.now = now;
      input.body = {.twist = input.commanded, .known = true};
      watch.update(input);
    }
  }
  /// Why nothing is permitted; empty: something is.
  std::string why() const {
    const Reason& why = !watch.unknown().empty()   ? watch.unknown()
                        : !watch.unasked().empty() ? watch.unasked()
                                                   : watch.blocked();
    return std::string(why.view());
  }
  bool blocked() const { return !watch.blocked().empty(); }

  LimitsConfig limits;
  StopChain gentle{0.28, 0.5 * limits.deceleration_mps2};
  ClearanceWatch watch{ClearanceConfig{}, limits, true};
  ClearanceInput input;
  Clearance found;
  Time now{100s};
  int count = 0;
  bool answers = true;
};

}  // namespace drover::engine
