#include "engine/estimate/wheels.h"

#include <algorithm>
#include <cmath>

#include "engine/still.h"

namespace drover::engine::estimate {
namespace {

constexpr Time kFarFuture{Duration{INT64_MAX / 4}};

struct Side {
  double sum_mps = 0;
  double low_mps = 0;
  double high_mps = 0;
  int count = 0;

  void add(double rim_mps) {
    low_mps = count == 0 ? rim_mps : std::min(low_mps, rim_mps);
    high_mps = count == 0 ? rim_mps : std::max(high_mps, rim_mps);
    sum_mps += rim_mps;
    ++count;
  }
};

}  // namespace

void Wheels::set(std::size_t wheel, double rim_mps, Time at) {
  wheels_[wheel] = {.rim_mps = rim_mps, .at = at};
}

WheelMotion Wheels::motion(Time at, Duration stale) const {
  std::array<Side, 2> sides{};
  bool rest = true;
  for (std::size_t i = 0; i < kWheels; ++i) {
    if (at - wheels_[i].at > stale) continue;
    sides[i / kWheelsPerSide].add(wheels_[i].rim_mps);
    rest = rest && std::abs(wheels_[i].rim_mps) < kEncoderRest_mps;
  }
  WheelMotion motion;
  motion.known = sides[0].count > 0 && sides[1].count > 0;
  if (!motion.known) return motion;
  motion.standing = rest;
  if (rest) return motion;
  motion.left_mps = sides[0].sum_mps / sides[0].count;
  motion.right_mps = sides[1].sum_mps / sides[1].count;
  motion.spread_mps =
      std::max(sides[0].high_mps - sides[0].low_mps, sides[1].high_mps - sides[1].low_mps) / 2;
  return motion;
}

Time Wheels::next_stale(Time at, Duration stale) const {
  Time next = kFarFuture;
  for (const Wheel& wheel : wheels_) {
    if (at - wheel.at <= stale) next = std::min(next, wheel.at + stale + Duration{1});
  }
  return next;
}

std::size_t wheel_of(const BaseConfig& base, AxisId axis) {
  for (std::size_t i = 0; i < base.left.size(); ++i) {
    if (base.left[i] == axis) return i;
  }
  for (std::size_t i = 0; i < base.right.size(); ++i) {
    if (base.right[i] == axis) return kWheelsPerSide + i;
  }
  return kWheels;
}

}  // namespace drover::engine::estimate
