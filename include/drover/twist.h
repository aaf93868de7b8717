// How fast a base moves, or is to move.
#pragma once

namespace drover {

/// Twist in base_link (REP 103): m/s ahead, rad/s counter-clockwise.
struct Twist {
  double vx_mps = 0;
  double wz_radps = 0;
};

}  // namespace drover
