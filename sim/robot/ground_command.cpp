// Commands to the ground under the robot, and the shove: command.cpp lists them.
#include <algorithm>
#include <cmath>

#include "drover/angle.h"
#include "sim/robot/robot.h"
#include "sim/robot/words.h"

namespace drover::sim {
namespace {

constexpr double kMostSlip = 0.95;
constexpr double kMostSideslip = 0.5;
constexpr double kMostSlope_deg = 15;
// So long a slip takes to come and to go.
constexpr double kSlipRamp_s = 0.1;

/// An optional word; nothing: it is no number.
std::optional<double> number_or(std::string_view word, double otherwise) {
  return word.empty() ? otherwise : number(word);
}

}  // namespace

// What is missing while it comes is made up for while it goes: over all it is the whole share.
double Slip::level(Time now) const {
  const double past_s = to_s(now - begin);
  const auto ramp = [](double since_s) { return std::clamp(since_s / kSlipRamp_s, 0.0, 1.0); };
  return share * (ramp(past_s) - ramp(past_s - lasts_s));
}

bool Slip::over(Time now) const {
  return to_s(now - begin) >= lasts_s + kSlipRamp_s;
}

std::string Robot::command_shove(std::span<const std::string_view> words) {
  const auto ahead_m = number(words[0]);
  const auto left_m = number(words[1]);
  const auto lasts_s = number(words[2]);
  const auto turn_deg = number_or(words[3], 0);
  if (!ahead_m || !left_m || !turn_deg || !lasts_s || !(*lasts_s > 0))
    return error("say: shove DX DY SECONDS [DEGREES]");
  plant_.shove({*ahead_m, *left_m, to_rad(*turn_deg), *lasts_s});
  return "ok";
}

std::string Robot::command_slip(std::span<const std::string_view> words) {
  const auto share = number(words[0]);
  const auto lasts_s = number(words[1]);
  const bool side = words[2] == "left" || words[2] == "right";
  if (!share || !(*share >= 0 && *share <= kMostSlip) || !lasts_s || !(*lasts_s > 0) ||
      (!side && !words[2].empty()))
    return error("say: slip SHARE SECONDS [left|right], SHARE from 0 to 0.95");
  slip_ = Slip{now_, *share, *lasts_s, words[2] != "right", words[2] != "left"};
  return "ok";
}

std::string Robot::command_sideslip(std::span<const std::string_view> words) {
  const auto share = number(words[0]);
  const double left_deg = to_deg(plant_.pose().yaw_rad) + 90;
  const auto direction_deg = number_or(words[1], left_deg);
  if (!share || std::abs(*share) > kMostSideslip || !direction_deg)
    return error("say: sideslip SHARE [DEGREES], SHARE from -0.5 to 0.5");
  plant_.set_sideslip(*share, to_rad(*direction_deg));
  return "ok";
}

std::string Robot::command_slope(std::string_view word) {
  const auto tilt_deg = number(word);
  if (!tilt_deg || std::abs(*tilt_deg) > kMostSlope_deg)
    return error("say: slope DEGREES, from -15 to 15");
  return plant_.set_side_slope(to_rad(*tilt_deg)) ? "ok" : error("the world has no side slope");
}

void Robot::make_slip(Time now) {
  if (!slip_) return;
  const double level = slip_->over(now) ? 0 : slip_->level(now);
  for (std::size_t joint = 0; joint < plant_.joints().size(); ++joint) {
    const bool slips = plant_.is_left(joint) ? slip_->left : slip_->right;
    plant_.set_slip(joint, slips ? level : 0);
  }
  if (slip_->over(now)) slip_.reset();
}

}  // namespace drover::sim
