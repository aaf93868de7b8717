// Twenty planted sets of errors on simulated drives: each value is within its interval in at least
// eighteen of them, and the intervals are of use.
#include <gtest/gtest.h>

#include <cstdio>
#include <map>
#include <string>

#include "unit/calibrate/simulated_drive.h"

namespace drover::calibrate {
namespace {

constexpr int kSets = 20;
constexpr int kLeastWithin = 18;

double uniform(std::mt19937_64& random, double from, double to) {
  return from + (to - from) * static_cast<double>(random() >> 11) / 9007199254740992.0;
}

Planted planted(std::uint64_t seed, const Configured& configured) {
  std::mt19937_64 random(1000 + seed);
  Planted p;
  const double common = uniform(random, 0.96, 1.04);
  const double apart = uniform(random, -0.015, 0.015);
  p.left_scale = common - apart;
  p.right_scale = common + apart;
  p.yaw_slip_factor = uniform(random, 1.0, 1.5);
  p.antenna_x_m = configured.antenna_x_m + uniform(random, -0.25, 0.25);
  p.antenna_y_m = configured.antenna_y_m + uniform(random, -0.15, 0.15);
  p.heading_offset_deg = configured.heading_baseline_offset_deg + uniform(random, -6, 6);
  p.position_late_s = uniform(random, 0, 0.25);
  p.heading_late_s = uniform(random, 0, 0.3);
  p.gyro_scale = uniform(random, 0.99, 1.01);
  p.gyro_bias_radps = uniform(random, -0.01, 0.01);
  p.dead_s = uniform(random, 0, 0.06);
  p.lag_s = uniform(random, 0.04, 0.2);
  p.speed_late_s = p.position_late_s;
  p.speed_by_positions = seed % 2 == 1;
  return p;
}

/// What the truth is, and how wide an interval may be.
struct Truth {
  double value;
  double widest;
};
std::map<Quantity, Truth> truths(const Planted& p, const Configured& c) {
  const double dead_s = std::lround(p.dead_s / 0.005) * 0.005;
  const double radius = c.wheel_radius_m;
  std::map<Quantity, Truth> truth{
      {Quantity::wheel_radius_m,
       {radius * (p.left_scale + p.right_scale) / 2, 0.01 * radius}},
      {Quantity::left_radius_m, {radius * p.left_scale, 0.01 * radius}},
      {Quantity::right_radius_m, {radius * p.right_scale, 0.01 * radius}},
      {Quantity::yaw_slip_factor, {p.yaw_slip_factor, 0.03 * p.yaw_slip_factor}},
      {Quantity::antenna_x_m, {p.antenna_x_m, 0.03}},
      {Quantity::antenna_y_m, {p.antenna_y_m, 0.03}},
      {Quantity::heading_offset_deg, {p.heading_offset_deg, 0.5}},
      {Quantity::position_late_s, {std::lround(p.position_late_s / 0.005) * 0.005, 0.03}},
      {Quantity::heading_late_s, {std::lround(p.heading_late_s / 0.005) * 0.005, 0.03}},
      {Quantity::gyro_scale, {p.gyro_scale, 0.01}},
      {Quantity::gyro_bias_radps, {p.gyro_bias_radps, 0.001}},
      {Quantity::drive_lag_s, {dead_s + p.lag_s, 0.03}},
  };
  if (!p.speed_by_positions)
    truth[Quantity::speed_late_s] = {std::lround(p.speed_late_s / 0.005) * 0.005, 0.03};
  return truth;
}

constexpr const char* kNames[kQuantities] = {
    "wheel_radius_m", "left_radius_m",   "right_radius_m", "yaw_slip_factor", "antenna_x_m",
    "antenna_y_m",    "heading_offset",  "position_late_s", "heading_late_s",  "gyro_scale",
    "gyro_bias",      "drive_lag_s",     "speed_late_s"};

struct Score {
  int sets = 0;
  int within = 0;
  double widest = 0;
  double square = 0;  ///< of errors over half an interval
};

void play(const Noisy& noisy, bool gyro, bool headings, int sets, std::uint64_t first_seed,
          std::map<Quantity, Score>& scores, int* sources_right) {
  Configured configured;
  configured.antenna_x_m = 0.3;
  configured.heading_baseline_offset_deg = 90;
  for (int i = 0; i < sets; ++i) {
    const std::uint64_t seed = first_seed + static_cast<std::uint64_t>(i);
    const Planted p = planted(seed, configured);
    Drive drive = SimulatedDrive(p, configured, seed, noisy).drive(good_legs());
    if (!gyro) drive.gyro_radps.clear();
    if (!headings) drive.headings_rad.clear();
    const Calibration result = calibrate(drive, configured);
    ASSERT_EQ(result.refused, "") << "seed " << seed;
    EXPECT_FALSE(result.signs.wrong()) << "seed " << seed;
    for (const auto& [what, truth] : truths(p, configured)) {
      const Found& found = result.of(what);
      if (!found.refused.empty()) {
        if (std::getenv("SHOW")) std::printf("seed %lu %s: %s\n", seed, kNames[(int)what], found.refused.c_str());
        continue;
      }
      Score& score = scores[what];
      ++score.sets;
      if (std::getenv("SHOW")) std::printf("   %s off %.5f of %.5f\n", kNames[(int)what], found.value - truth.value, found.interval);
      const double off = std::abs(found.value - truth.value);
      score.within += off <= found.interval ? 1 : 0;
      score.widest = std::max(score.widest, found.interval / truth.widest);
      score.square += 4 * off * off / (found.interval * found.interval);
    }
    const auto right = p.speed_by_positions ? SpeedSource::positions : SpeedSource::own;
    if (sources_right != nullptr) *sources_right += result.speed_source == right ? 1 : 0;
    if (std::getenv("SHOW")) std::printf("seed %lu white %.4f slow %.4f head %.4f outl %zu src %d %s\n", seed, result.facts.place_white_m, result.facts.place_slow_m, result.facts.heading_white_rad, result.facts.outliers, (int)result.speed_source, result.speed_source_refused.c_str());
  }
}

void print(const char* name, const std::map<Quantity, Score>& scores) {
  std::printf("%s: within of told, widest interval over the bound, rms of errors over half of it\n",
              name);
  for (const auto& [what, score] : scores)
    std::printf("  %-16s %2d of %2d  %.2f  %.2f\n", kNames[static_cast<std::size_t>(what)],
                score.within, score.sets, score.widest,
                std::sqrt(score.square / std::max(1, score.sets)));
}

TEST(PlantedErrors, AreFoundWithinTheirIntervals) {
  std::map<Quantity, Score> scores;
  int sources_right = 0;
  play({}, true, true, kSets, 1, scores, &sources_right);
  print("seeds 1 to 20", scores);
  for (const auto& [what, score] : scores) {
    SCOPED_TRACE(kNames[static_cast<std::size_t>(what)]);
    EXPECT_GE(score.within, what == Quantity::speed_late_s ? 9 : kLeastWithin);
    EXPECT_LT(score.widest, 1);
  }
  EXPECT_GE(sources_right, kLeastWithin);
}

}  // namespace
}  // namespace drover::calibrate
