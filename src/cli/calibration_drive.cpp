#include "cli/calibration_drive.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "drover/angle.h"
#include "engine/base/kinematics.h"

namespace drover::cli {
namespace {

using namespace std::chrono_literals;

constexpr Duration kEachKey = 40ms;     // a terminal repeats up to 30 a second
constexpr Duration kEachRest = 100ms;   // while no key is held
constexpr Duration kFixLasts = 1500ms;  // of a receiver of 1 Hz
constexpr double kStill_mps = 0.01;
constexpr double kStill_radps = 0.02;
constexpr double kLongestStep_s = 0.2;
constexpr Duration kFreshKey = 100ms;  // it counts for kKeyHeld from when it came

calibrate::DriveLimits limits_of(const engine::EngineConfig& config) {
  const auto& limits = config.limits;
  return {limits.max_speed_mps, limits.max_yaw_rate_radps, limits.deceleration_mps2};
}

}  // namespace

/// One that steers drives wider ones than it is asked for, to what the area is measured by.
std::string not_calibrated(const engine::BaseConfig& base) {
  if (auto rollers = rollers_of(base); !rollers.empty()) return rollers;
  const double widest_m = calibrate::kWider * calibrate::kCircle_m;
  const double needs_m = engine::limits(engine::kinematics_of(base)).smallest_radius_m;
  if (needs_m <= widest_m) return {};
  std::array<char, 120> text{};
  std::snprintf(text.data(), text.size(),
                "its circles have a radius of %.2f m at the most, and this base needs %.2f m",
                widest_m, needs_m);
  return text.data();
}

CalibrationDrive::CalibrationDrive(const engine::EngineConfig& config)
    : config_(config),
      configured_(configured_of(config)),
      recipe_(limits_of(config)),
      taken_(config.base) {}

bool CalibrationDrive::has_fix() const {
  return fixed_at_ != kNever && seen_at_ - fixed_at_ <= kFixLasts;
}

void CalibrationDrive::end(std::string problem) {
  ended_ = true;
  problem_ = std::move(problem);
}

/// What it did in a gap, in which nobody looked: by where it was before and is now. While its
/// heading is unknown: the last key counted to its end, then a ramp followed.
calibrate::Moved CalibrationDrive::moved_in_gap(const Snapshot& seen, double gap_s) const {
  const double held_s = std::min(gap_s, to_s(kKeyHeld));
  const double ramp_s = std::abs(before_.pose.vx_mps) / config_.limits.deceleration_mps2;
  const double ramps_s = std::min(gap_s - held_s, ramp_s);
  const double rolled_s = held_s + (ramp_s > 0 ? ramps_s - ramps_s * ramps_s / (2 * ramp_s) : 0.0);
  calibrate::Moved moved;
  moved.way_m = before_.pose.vx_mps * rolled_s;
  moved.turn_rad = before_.pose.wz_radps * rolled_s;
  const double turn_rad = -to_rad(seen.gnss.pose_heading_deg - before_.gnss.pose_heading_deg);
  const double way_m =
      std::hypot(seen.pose.x_m - before_.pose.x_m, seen.pose.y_m - before_.pose.y_m);
  if (!std::isfinite(turn_rad) || !std::isfinite(way_m)) return moved;
  moved.turn_rad += wrap_rad(turn_rad - moved.turn_rad);
  moved.way_m = std::copysign(way_m, moved.way_m);
  return moved;
}

/// What has happened since the last look.
void CalibrationDrive::follow(const Snapshot& seen) {
  if (seen.time == kNever || (seen_at_ != kNever && seen.time <= seen_at_)) return;
  const double since_s = seen_at_ == kNever ? 0 : to_s(seen.time - seen_at_);
  seen_at_ = seen.time;
  calibrate::Moved moved;
  moved.way_m = seen.pose.vx_mps * since_s;
  moved.turn_rad = seen.pose.wz_radps * since_s;
  if (since_s > kLongestStep_s) moved = moved_in_gap(seen, since_s);
  before_ = seen;
  if (seen.gnss.position.quality == FixQuality::rtk_fixed) fixed_at_ = seen.gnss.position_time;
  if (!begun_) return;
  taken_.take(seen);
  moved.dt_s = std::min(since_s, kLongestStep_s);
  // What is driven or stood without a fix is of no use.
  moved.still = has_fix() && std::abs(seen.pose.vx_mps) < kStill_mps &&
                std::abs(seen.pose.wz_radps) < kStill_radps;
  recipe_.look(moved);
}

void CalibrationDrive::judge_signs() {
  signs_ = calibrate::signs_of(taken_.drive, configured_);
  if (signs_.wrong()) return end("signs are wrong: put them right first, then drive again");
  if (signs_.contradict) return end(signs_.refused);
  // A receiver without headings shows them at a higher speed only. The first way, on which droverd
  // compares wheels, gyro and receiver, has shown as much.
  const bool compared = !slow_ && config_.navigate.first_way_m > 0;
  if (!signs_.refused.empty() && !compared) return end(signs_.refused);
  recipe_.proved();
}

void CalibrationDrive::judge_all() {
  const auto found = calibrate::calibrate(taken_.drive, configured_);
  if (found.signs.wrong() || found.signs.contradict) return end({});
  missing_ = calibrate::worth_driving_for(found, taken_.drive);
  const bool enough = found.refused.empty() && missing_.empty();
  if (enough || !recipe_.again()) end({});
}

Twist CalibrationDrive::wanted(Time now) const {
  const bool fresh = fresh_at_ != kNever && now - fresh_at_ <= kKeyHeld;
  if (let_go_ || !has_fix() || !fresh) return {};
  return recipe_.wanted();
}

std::optional<Twist> CalibrationDrive::look(Time now, Time key, const Snapshot& seen) {
  now_ = now;
  const bool pressed = key != kNever;
  if (pressed) key_at_ = key;
  const bool fresh = pressed && now - key <= kFreshKey;
  if (fresh) fresh_at_ = key;
  begun_ = begun_ || pressed;
  if (!held(now)) let_go_ = false;
  follow(seen);
  if (!ended_ && recipe_.asks_for_signs()) judge_signs();
  if (!ended_ && recipe_.over()) judge_all();
  if (!begun_) return std::nullopt;
  const Duration since = said_at_ == kNever ? kEachRest : now - said_at_;
  const Twist twist = ended_ ? Twist{} : wanted(now);
  // Motion is asked for with each key, and never without one; rest goes on by itself.
  const bool due = is_zero(twist) ? since >= kEachRest : fresh && since >= kEachKey;
  if (!due) return std::nullopt;
  said_at_ = now;
  asked_to_move_ = !is_zero(twist);
  return twist;
}

void CalibrationDrive::answered(bool ok, const std::string& text) {
  refused_ = !ok;
  if (!ok) stopped_by_ = text;
  if (ok) slow_ = !text.empty();
  if (ok && asked_to_move_) stopped_by_.clear();
  if (!ok && now_ != kNever && held(now_)) let_go_ = true;
}

std::string CalibrationDrive::line() const {
  if (recipe_.over()) return "done";
  const auto& piece = recipe_.pieces()[recipe_.at()];
  const bool stands = piece.stand_s > 0;
  const bool turns = !stands && !(piece.way_m > 0);
  const double scale = turns ? to_deg(1) : 1;
  char text[160];
  std::snprintf(text, sizeof text, "%2zu/%zu %-26.*s %5.*f of %.*f %-3s %5.2f m/s  ",
                recipe_.at() + 1, recipe_.pieces().size(), static_cast<int>(piece.what.size()),
                piece.what.data(), turns ? 0 : 1, scale * recipe_.done(), turns ? 0 : 1,
                scale * recipe_.of(),
                stands  ? "s"
                : turns ? "deg"
                        : "m",
                std::isfinite(before_.pose.vx_mps) ? before_.pose.vx_mps : 0.0);
  const bool holds = now_ != kNever && held(now_);
  if (!begun_) return std::string(text) + (has_fix() ? "hold the space key" : "no RTK fix yet");
  if (!has_fix()) return std::string(text) + "stands: no RTK fix";
  const std::string why = stopped_by_.empty() ? "" : " (" + stopped_by_ + ")";
  if (refused_) return std::string(text) + "stands" + why;
  if (let_go_) return std::string(text) + "let the key go first" + why;
  if (stands) return std::string(text) + "wait";
  if (!holds) return std::string(text) + "paused: hold the space key" + why;
  if (fresh_at_ == kNever || now_ - fresh_at_ > kKeyHeld)
    return std::string(text) + "stands: droverd answers too slowly for a key" + why;
  return std::string(text) + (slow_ ? "drives slowly" : "drives");
}

}  // namespace drover::cli
