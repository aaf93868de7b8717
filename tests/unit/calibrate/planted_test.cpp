// Twenty planted sets of errors on simulated drives: each value is within its interval in at least
// eighteen of them, and the intervals are of use.
#include <gtest/gtest.h>

#include <cstdio>
#include <map>
#include <string>

#include "support/seeds.h"
#include "unit/calibrate/simulated_drive.h"

namespace drover::calibrate {
namespace {

constexpr int kSets = static_cast<int>(test::seeds(20));
constexpr int kLeastWithin = kSets * 9 / 10;

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
  return p;
}

/// As the simulation plants it.
double in_ticks(double late_s) {
  return 0.005 * std::round(late_s / 0.005);
}

/// What the truth is, and how wide an interval may be.
struct Truth {
  double value;
  double widest;
};
std::map<Quantity, Truth> truths(const Planted& p, const Configured& c) {
  const double dead_s = in_ticks(p.dead_s);
  const double radius = c.wheel_radius_m;
  std::map<Quantity, Truth> truth{
      {Quantity::wheel_radius_m, {radius * (p.left_scale + p.right_scale) / 2, 0.01 * radius}},
      {Quantity::left_radius_m, {radius * p.left_scale, 0.01 * radius}},
      {Quantity::right_radius_m, {radius * p.right_scale, 0.01 * radius}},
      {Quantity::yaw_slip_factor, {p.yaw_slip_factor, 0.03 * p.yaw_slip_factor}},
      {Quantity::antenna_x_m, {p.antenna_x_m, 0.03}},
      {Quantity::antenna_y_m, {p.antenna_y_m, 0.03}},
      {Quantity::heading_offset_deg, {p.heading_offset_deg, 0.5}},
      {Quantity::position_late_s, {in_ticks(p.position_late_s), 0.03}},
      {Quantity::heading_late_s, {in_ticks(p.heading_late_s), 0.03}},
      {Quantity::gyro_scale, {p.gyro_scale, 0.01}},
      {Quantity::gyro_bias_radps, {p.gyro_bias_radps, 0.001}},
      {Quantity::drive_lag_s, {dead_s + p.lag_s, 0.03}},
  };
  // Of a speed that is made of positions it is not planted.
  if (!p.speed_by_positions) truth[Quantity::speed_late_s] = {in_ticks(p.speed_late_s), 0.03};
  return truth;
}

constexpr const char* kNames[kQuantities] = {
    "wheel_radius_m", "left_radius_m",  "right_radius_m",  "yaw_slip_factor", "antenna_x_m",
    "antenna_y_m",    "heading_offset", "position_late_s", "heading_late_s",  "gyro_scale",
    "gyro_bias",      "drive_lag_s",    "speed_late_s"};

struct Score {
  int sets = 0;
  int within = 0;
  double widest = 0;
  double square = 0;  ///< of errors over half an interval
};

struct Play {
  Noisy noisy;
  bool gyro = true;
  bool headings = true;
  int sets = kSets;
  std::uint64_t first_seed = 1;
  bool speed_by_positions = false;
};

/// In how many sets it was known where the receiver's speed comes from.
int play(const Play& how, std::map<Quantity, Score>& scores) {
  int sources_right = 0;
  Configured configured;
  configured.antenna_x_m = 0.3;
  configured.heading_baseline_offset_deg = 90;
  for (int i = 0; i < how.sets; ++i) {
    const std::uint64_t seed = how.first_seed + static_cast<std::uint64_t>(i);
    Planted p = planted(seed, configured);
    p.speed_by_positions = how.speed_by_positions;
    Drive drive = SimulatedDrive(p, configured, seed, how.noisy).drive(good_legs());
    if (!how.gyro) drive.gyro_radps.clear();
    if (!how.headings) drive.headings_rad.clear();
    const Calibration result = calibrate(drive, configured);
    EXPECT_EQ(result.refused, "") << "seed " << seed;
    if (!result.refused.empty()) continue;
    EXPECT_FALSE(result.signs.wrong()) << "seed " << seed;
    for (const auto& [what, truth] : truths(p, configured)) {
      const Found& found = result.of(what);
      Score& score = scores[what];
      if (!found.refused.empty()) continue;  // which is not within
      ++score.sets;
      const double off = std::abs(found.value - truth.value);
      score.within += off <= found.interval ? 1 : 0;
      score.widest = std::max(score.widest, found.interval / truth.widest);
      score.square += 4 * off * off / (found.interval * found.interval);
    }
    const auto right = p.speed_by_positions ? SpeedSource::positions : SpeedSource::own;
    sources_right += result.speed_source == right ? 1 : 0;
  }
  return sources_right;
}

void print(const char* name, const std::map<Quantity, Score>& scores) {
  std::printf("%s: within of told, widest interval over the bound, rms of errors over half of it\n",
              name);
  for (const auto& [what, score] : scores)
    std::printf("  %-16s %2d of %2d  %.2f  %.2f\n", kNames[static_cast<std::size_t>(what)],
                score.within, score.sets, score.widest,
                std::sqrt(score.square / std::max(1, score.sets)));
}

void expect_found(const std::map<Quantity, Score>& scores, int least) {
  for (const auto& [what, score] : scores) {
    SCOPED_TRACE(kNames[static_cast<std::size_t>(what)]);
    EXPECT_GE(score.within, least);
    EXPECT_LT(score.widest, 1);
  }
}

TEST(PlantedErrors, AreFoundWithinTheirIntervals) {
  std::map<Quantity, Score> scores;
  EXPECT_GE(play({}, scores), kLeastWithin);
  print("seeds 1 to 20", scores);
  expect_found(scores, kLeastWithin);
}

TEST(PlantedErrors, AreFoundWithAReceiverOfTwoCentimetres) {
  Play how{{}, true, true, kSets / 2, 201, true};
  how.noisy.place_slow_m = 0.02;
  how.noisy.place_white_m = 0.008;
  how.noisy.heading_slow_deg = 0.2;
  std::map<Quantity, Score> scores;
  EXPECT_GE(play(how, scores), kLeastWithin / 2);
  print("seeds 201 to 210, receiver of 2 cm", scores);
  expect_found(scores, kLeastWithin / 2);
}

TEST(PlantedErrors, AreFoundWithoutAGyroAndWithOneAntenna) {
  std::map<Quantity, Score> scores;
  EXPECT_GE(play({{}, false, false, kSets / 2, 301, true}, scores), kLeastWithin / 2);
  for (const auto what : {Quantity::heading_offset_deg, Quantity::heading_late_s,
                          Quantity::gyro_scale, Quantity::gyro_bias_radps})
    scores.erase(what);
  print("seeds 301 to 310, without gyro and headings", scores);
  expect_found(scores, kLeastWithin / 2);
}

TEST(PlantedErrors, AnAntennasXIsOnlyKnownFromThePointThatWheelsSkidAbout) {
  Configured configured;
  const Planted nothing;
  const Drive drive = SimulatedDrive(nothing, configured, 1, {}).drive(good_legs());
  const double sharp = calibrate(drive, configured).of(Quantity::antenna_x_m).interval;
  configured.skids = true;
  const Calibration skids = calibrate(drive, configured);
  EXPECT_LT(sharp, 0.02);
  EXPECT_EQ(skids.of(Quantity::antenna_x_m).refused, "");
  EXPECT_GE(skids.of(Quantity::antenna_x_m).interval, 0.05);
  EXPECT_LT(skids.of(Quantity::antenna_y_m).interval, 0.02);
}

}  // namespace
}  // namespace drover::calibrate
