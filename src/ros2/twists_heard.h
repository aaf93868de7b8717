// What came on /cmd_vel since the last look.
#pragma once

#include <optional>
#include <string>

#include "drover/time.h"
#include "drover/twist.h"

namespace drover::ros2 {

struct TwistsHeard {
  std::optional<Twist> twist;  ///< the newest, none where a newer one was refused
  bool moved = false;          ///< one of them was no zero
  std::string refused;         ///< why another one is not followed; empty: all are
  bool rivals = false;         ///< because two programs write
  bool failed = false;         ///< DDS does not give what came
  Time said = kNever;          ///< `twist`: or came, where clocks differ
};

}  // namespace drover::ros2
