// What the estimate learned of the robot and knows well enough to begin with next time.
#include <algorithm>
#include <cmath>

#include "drover/angle.h"
#include "engine/estimate/antenna_learning.h"
#include "engine/estimate/estimator.h"

namespace drover::engine {

using namespace estimate;

namespace {

/// How a value is handed over from one program to the next.
struct KeptRule {
  double between;  ///< one sigma of how much it changes meanwhile: screws, air in the tyres, ground
  double known;    ///< with a sigma up to this it is handed over, and has one up to this then
  double least;    ///< what is outside is no such value
  double most;
};

const KeptRule kMountingKept{to_rad(0.1), to_rad(0.2), -to_rad(5), to_rad(5)};
constexpr KeptRule kLateKept{0.01, 0.04, -0.4, 0.4};
constexpr KeptRule kArmKept{0.005, 0.03, -1, 1};
constexpr KeptRule kScaleKept{0.01, 0.01, 0.8, 1.2};
constexpr KeptRule kGainKept{0.05, 0.05, 0.2, 2};
constexpr KeptRule kGyroScaleKept{0.001, 0.003, 0.97, 1.03};

LearnedValue kept(const KeptRule& rule, double value, double sigma) {
  const bool fits = sigma <= rule.known && value >= rule.least && value <= rule.most;
  return fits ? LearnedValue{value, sigma} : LearnedValue{};
}

/// With the sigma that it has by now; absent when it is none that `kept` gives.
LearnedValue recalled(const KeptRule& rule, const LearnedValue& value) {
  if (!(value.sigma > 0) || !kept(rule, value.value, value.sigma).known()) return {};
  return {value.value, std::min(std::hypot(value.sigma, rule.between), rule.known)};
}

void recall_scale(Belief& belief, std::size_t i, const KeptRule& rule, const LearnedValue& value) {
  const LearnedValue now = recalled(rule, value);
  if (now.known()) belief.reset(i, now.value, now.sigma);
}

}  // namespace

void Estimator::recall(const LearnedValues& learned) {
  replay();
  State state = history_.before(history_.size());
  state.heading.receiver = state.gnss.receiver = learned.receiver;
  state.gyro.source = learned.imu;
  const LearnedValue mounting = recalled(kMountingKept, learned.mounting_rad);
  if (mounting.known()) state.mounting.recall(-mounting.value, mounting.sigma, config_);
  const LearnedValue late = recalled(kLateKept, learned.late_s);
  if (late.known() && config_.gnss_late_sigma_s > 0) {
    state.fit.recall_late(late.value, late.sigma);
    state.late_s = state.fit.late_used_s();
  }
  const LearnedValue ahead = recalled(kArmKept, learned.antenna_ahead_m);
  const LearnedValue left = recalled(kArmKept, learned.antenna_left_m);
  if (ahead.known() && left.known()) state.fit.recall_arm(ahead.value, left.value, ahead.sigma);
  const LearnedValue heading = recalled(kLateKept, learned.heading_late_s);
  if (heading.known() && config_.gnss_late_sigma_s > 0)
    state.heading_late.recall(heading.value, heading.sigma);
  recall_scale(state.belief, kScale, kScaleKept, learned.wheel_scale);
  recall_scale(state.belief, kGain, kGainKept, learned.turn_gain);
  recall_scale(state.belief, kGyroScale, kGyroScaleKept, learned.gyro_scale);
  history_.restart(state);
}

/// What it is told of its heading from now on is another one: it is found again, as the place is.
void Estimator::forget_learned() {
  replay();
  State state = history_.before(history_.size());
  const State unlearned = blank();
  state.mounting = {};
  forget_fit(state, config_);
  state.heading_late = unlearned.heading_late;
  for (const std::size_t i : {std::size_t{kScale}, std::size_t{kGain}, std::size_t{kGyroScale}})
    state.belief.reset(i, unlearned.belief.mean[i], std::sqrt(unlearned.belief.covariance[i][i]));
  const bool told = state.heading.last != kNever && state.time - state.heading.last < kHeadingTold;
  state.has_heading = state.has_heading && !told;
  state.has_position = state.has_position && !told;
  state.heading.jumps = {};
  state.gnss.jumps = {};
  state.watch = {};
  history_.restart(state);
  ++estimate_.learned.forgotten;
}

void Estimator::report_kept(const State& state) {
  LearnedValues& learned = estimate_.learned;
  // With one antenna no headings tell whose it is.
  const bool told = state.heading.last != kNever;
  learned.receiver = told ? state.heading.receiver : state.gnss.receiver;
  learned.imu = state.gyro.source;
  const auto sigma_of = [&state](std::size_t i) {
    return std::sqrt(std::max(state.belief.covariance[i][i], 0.0));
  };
  const auto mean_of = [&state](std::size_t i) { return state.belief.mean[i]; };
  const Mounting& mounting = state.mounting;
  const bool taught = mounting.begun && mounting.known(config_);
  learned.mounting_rad =
      taught ? kept(kMountingKept, -mounting.applied_rad, mounting.sigma_rad(config_))
             : LearnedValue{};
  const AntennaFit& fit = state.fit;
  // All is kept under one receiver's name; while another one tells the positions, theirs is not.
  const bool its_own = !told || state.gnss.receiver == state.heading.receiver;
  const auto of_positions = [its_own](LearnedValue value) {
    return its_own ? value : LearnedValue{};
  };
  const bool of_late = config_.gnss_late_sigma_s > 0;
  learned.late_s =
      of_late ? of_positions(kept(kLateKept, fit.late_s(), fit.late_doubt_s())) : LearnedValue{};
  learned.heading_late_s =
      of_late ? kept(kLateKept, state.heading_late.late_s(), state.heading_late.sigma_s())
              : LearnedValue{};
  learned.antenna_ahead_m = of_positions(kept(kArmKept, fit.ahead_m(), fit.arm_sigma_m()));
  learned.antenna_left_m = of_positions(kept(kArmKept, fit.left_m(), fit.arm_sigma_m()));
  learned.wheel_scale = kept(kScaleKept, mean_of(kScale), sigma_of(kScale));
  learned.turn_gain = kept(kGainKept, mean_of(kGain), sigma_of(kGain));
  learned.gyro_scale = kept(kGyroScaleKept, mean_of(kGyroScale), sigma_of(kGyroScale));
}

}  // namespace drover::engine
