#include "engine/estimate/mounting.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "drover/angle.h"
#include "engine/estimate/filter.h"

namespace drover::engine::estimate {
namespace {

constexpr double kKnown_deg = 0.2;
constexpr double kBest_deg = 0.1;  // legs are not as independent as they are taken for
constexpr double kMost_deg = 5.0;  // more is another mistake than a screw
// Of what is fixed to the map, as a share of the way: a wet side slope of five degrees, or a drift
// that nobody noticed; and how much it changes from one leg to the next.
constexpr double kAside = 0.1;
constexpr double kAsideWalk = 0.002;
// Sigmas: beyond, what is fixed to the map is another than before, unless it may be the mounting
// that shows on the first way back.
constexpr double kMapGate = 3.0;
constexpr double kSameWay_rad = kPi / 4;
constexpr double kBackAgain_rad = 0.75 * kPi;
// Sideways on ground that looks level, as a share of the way.
constexpr double kUsualAside = 0.015;

void begin(Mounting& mounting, const EstimateConfig& config) {
  mounting.begun = true;
  mounting.covariance[0][0] = square(to_rad(config.heading_mount_sigma_deg));
  mounting.covariance[1][1] = mounting.covariance[2][2] = square(kAside);
}

/// What is known of it no longer holds.
void forget_aside(Mounting& mounting) {
  for (std::size_t i = 1; i < 3; ++i) {
    for (std::size_t k = 0; k < 3; ++k) mounting.covariance[i][k] = mounting.covariance[k][i] = 0;
    mounting.covariance[i][i] = square(kAside);
    mounting.mean[i] = 0;
  }
}

/// A leg that goes another way than the recalled mounting says.
bool contradicts(const Mounting& mounting, const StraightLeg& leg, double measured_m) {
  const double variance_m2 =
      (mounting.covariance[0][0] + square(kUsualAside)) * square(leg.way_m) + leg.variance_m2;
  return square(measured_m - mounting.mean[0] * leg.way_m) > square(kMapGate) * variance_m2;
}

void prove(Mounting& mounting, const StraightLeg& leg, double measured_m,
           const EstimateConfig& config) {
  using Recalled = Mounting::Recalled;
  if (contradicts(mounting, leg, measured_m)) {
    mounting.recalled = Recalled::refuted;
    mounting.mean = {};
    mounting.covariance = {};
    begin(mounting, config);
  } else if (mounting.recalled == Recalled::unproved) {
    mounting.recalled = Recalled::one_way;
    mounting.first_course_rad = leg.course_rad;
  } else if (std::abs(wrap_rad(leg.course_rad - mounting.first_course_rad)) > kBackAgain_rad) {
    mounting.recalled = Recalled::no;
  }
}

}  // namespace

void Mounting::recall(double crab_rad, double sigma_rad, const EstimateConfig& config) {
  if (config.heading_mount_sigma_deg <= kKnown_deg) return;  // it was calibrated
  *this = {};
  begin(*this, config);
  covariance[0][0] = square(sigma_rad);
  mean[0] = applied_rad = crab_rad;
  recalled = Recalled::unproved;
}

double Mounting::sigma_rad(const EstimateConfig& config) const {
  return begun ? std::sqrt(covariance[0][0]) : to_rad(config.heading_mount_sigma_deg);
}

double Mounting::doubt_rad(const EstimateConfig& config) const {
  const double legs_rad = sigma_rad(config);
  return recalled == Recalled::unproved ? std::max(legs_rad, to_rad(config.heading_mount_sigma_deg))
                                        : legs_rad;
}

bool Mounting::known(const EstimateConfig& config) const {
  return sigma_rad(config) <= to_rad(kKnown_deg);
}

double Mounting::catch_up(const EstimateConfig& config) {
  if (recalled == Recalled::refuted) {
    recalled = Recalled::no;
    return -std::exchange(applied_rad, 0.0);
  }
  if (!known(config)) return 0;
  const double before_rad = applied_rad;
  applied_rad = std::clamp(mean[0], -to_rad(kMost_deg), to_rad(kMost_deg));
  return applied_rad - before_rad;
}

void learn(Mounting& mounting, const StraightLeg& leg, const EstimateConfig& config) {
  if (!mounting.begun) begin(mounting, config);
  auto& p = mounting.covariance;
  for (std::size_t i = 1; i < 3; ++i)
    p[i][i] = std::min(p[i][i] + square(kAsideWalk), square(kAside));
  const std::array<double, 3> row{leg.way_m, -std::sin(leg.course_rad) * leg.way_m,
                                  std::cos(leg.course_rad) * leg.way_m};
  const auto spread_of = [&] {
    std::array<double, 3> spread{};
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t k = 0; k < 3; ++k) spread[i] += p[i][k] * row[k];
    return spread;
  };
  const auto dot = [&](const std::array<double, 3>& v) {
    return row[0] * v[0] + row[1] * v[1] + row[2] * v[2];
  };
  std::array<double, 3> spread = spread_of();
  const double measured_m = leg.across_m + mounting.applied_rad * leg.way_m;
  const bool same_way = std::abs(wrap_rad(leg.course_rad - mounting.course_rad)) < kSameWay_rad;
  mounting.course_rad = leg.course_rad;
  using Recalled = Mounting::Recalled;
  if (mounting.recalled == Recalled::unproved || mounting.recalled == Recalled::one_way) {
    prove(mounting, leg, measured_m, config);
    spread = spread_of();
  }
  const double surprise2 = square(measured_m - dot(mounting.mean));
  if ((same_way || mounting.known(config)) &&
      surprise2 > square(kMapGate) * (dot(spread) + leg.variance_m2)) {
    forget_aside(mounting);
    spread = spread_of();
  }
  const double innovation_m = measured_m - dot(mounting.mean);
  const double total = dot(spread) + leg.variance_m2;
  if (!(total > 0)) return;
  for (std::size_t i = 0; i < 3; ++i) {
    mounting.mean[i] += spread[i] / total * innovation_m;
    for (std::size_t k = 0; k < 3; ++k) p[i][k] -= spread[i] * spread[k] / total;
  }
  const double best_deg = std::min(kBest_deg, config.heading_mount_sigma_deg);
  p[0][0] = std::max(p[0][0], square(to_rad(best_deg)));
}

}  // namespace drover::engine::estimate
