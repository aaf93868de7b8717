#include "drivers/robomaster_c620/loose.h"

#include <algorithm>
#include <cmath>

namespace drover::robomaster {
namespace {

constexpr double kTurns_radps = 0.5;
constexpr double kMean_s = 0.1;
// Of what a wheel needs to go on turning: the shaft alone needs less, and always something.
constexpr double kLeastFree = 0.15;
constexpr double kMostFree = 1.1;
// And what the others do meanwhile, in which a wheel that carries anything would take part.
constexpr double kPulls = 2.5;
constexpr double kChanges = 2.5;
// Healthy wheels were free for 1.7 s at the most, and the effort of the others changed by as much
// as the friction in that.
constexpr double kFree_s = 5;
constexpr double kForgets = 4;  ///< times as fast

}  // namespace

void LooseWatch::step(const std::array<Load, kMotors>& loads, Duration dt) {
  const double dt_s = to_s(dt);
  const double share = std::min(dt_s / kMean_s, 1.0);
  for (std::size_t i = 0; i < kMotors; ++i) {
    Wheel& wheel = wheels_[i];
    const double along_Nm = std::copysign(1.0, loads[i].velocity_radps) * loads[i].effort_Nm;
    const bool turns = std::abs(loads[i].velocity_radps) > kTurns_radps;
    wheel.along_Nm = turns ? wheel.along_Nm + share * (along_Nm - wheel.along_Nm) : friction_Nm_;
  }
  for (std::size_t i = 0; i < kMotors; ++i) judge(i, loads[i], dt_s);
}

void LooseWatch::judge(std::size_t channel, const Load& load, double dt_s) {
  Wheel& wheel = wheels_[channel];
  if (!(std::abs(load.velocity_radps) > kTurns_radps)) return;
  const bool free =
      wheel.along_Nm > kLeastFree * friction_Nm_ && wheel.along_Nm < kMostFree * friction_Nm_;
  if (!free) {
    wheel.free_s = std::max(wheel.free_s - kForgets * dt_s, 0.0);
    return;
  }
  double pulls_Nm = 0;
  for (std::size_t i = 0; i < kMotors; ++i)
    if (i != channel) pulls_Nm = std::max(pulls_Nm, std::abs(wheels_[i].along_Nm));
  const bool begins = wheel.free_s == 0;
  wheel.least_Nm = begins ? pulls_Nm : std::min(wheel.least_Nm, pulls_Nm);
  wheel.most_Nm = begins ? pulls_Nm : std::max(wheel.most_Nm, pulls_Nm);
  if (pulls_Nm > kPulls * friction_Nm_) wheel.free_s += dt_s;
}

bool LooseWatch::is_loose(std::size_t channel) const {
  const Wheel& wheel = wheels_[channel];
  return wheel.free_s > kFree_s && wheel.most_Nm - wheel.least_Nm > kChanges * friction_Nm_;
}

}  // namespace drover::robomaster
