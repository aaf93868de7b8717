#include "engine/health/learned_notices.h"

#include <cmath>

#include "drover/angle.h"

namespace drover::engine {
namespace {

constexpr double kLargeMounting_deg = 1.0;             // what is little is nobody's business
constexpr Duration kLasts = std::chrono::seconds(20);  // and is not this piece of ground
constexpr double kScaleStep = 0.02;
constexpr double kDelayStep_s = 0.08;
constexpr double kArmStep_m = 0.1;
constexpr double kShoved_m = 0.05;  // less is a bump
constexpr const char* kMountingUnknown =
    "how the antenna line is mounted is not known before it was driven there and back: until then "
    "a slow drift of the position is noticed after 0.2 m or not at all";
// What is measured late tells the same shove at almost the same time.
constexpr Duration kSameShove = std::chrono::seconds(1);

}  // namespace

bool LearnedNotices::anew(Said& said, double value, double step) {
  if (!std::isfinite(value) || std::abs(value - said) < step) return false;
  said = value;
  return true;
}

void LearnedNotices::tell(Time now, const Estimate& estimate, const AntennaConfig& antenna,
                          EventQueue& events) {
  tell_mounting(now, estimate, antenna, events);
  tell_delays(now, estimate, events);
  tell_arm(now, estimate, antenna, events);
  tell_shove(now, estimate, events);
  if (!std::isfinite(estimate.wheel_scale))
    scale_since_ = kNever;
  else if (scale_since_ == kNever)
    scale_since_ = now;
  const bool lasts = scale_since_ != kNever && now - scale_since_ > kLasts;
  if (!lasts || !anew(scale_, estimate.wheel_scale, kScaleStep)) return;
  Reason text;
  text.format("the wheels roll %.1f %% %s than wheel_radius_m says; it is made up for",
              100 * std::abs(estimate.wheel_scale - 1), estimate.wheel_scale < 1 ? "less" : "more");
  events.notice(now, Notice::Level::warning, text);
}

void LearnedNotices::tell_unknown(Time now, const Estimate& estimate, EventQueue& events) {
  if (std::isfinite(estimate.mounting_sigma_rad) && !estimate.mounting_known)
    events.notice(now, Notice::Level::info, kMountingUnknown);
  if (!std::isfinite(estimate.arm_unknown_m)) return;
  Reason text;
  text.format(
      "where the antenna is is not known before the robot has turned: until then it may go %.2f m "
      "beside its track",
      estimate.arm_unknown_m);
  events.notice(now, Notice::Level::info, text);
}

void LearnedNotices::tell_mounting(Time now, const Estimate& estimate, const AntennaConfig& antenna,
                                   EventQueue& events) {
  const bool large = std::abs(estimate.mounting_rad) >= to_rad(kLargeMounting_deg);
  const bool known = estimate.mounting_known && large;
  if (!known || !anew(mounting_rad_, estimate.mounting_rad, to_rad(kLargeMounting_deg))) return;
  const double left_deg = to_deg(estimate.mounting_rad);
  Reason text;
  text.format(
      "the antenna line is mounted %.1f degrees to the %s of what heading_baseline_offset_deg "
      "says: %.1f would be right; it is made up for",
      std::abs(left_deg), left_deg > 0 ? "left" : "right",
      antenna.heading_baseline_offset_deg - left_deg);
  events.notice(now, Notice::Level::warning, text);
}

void LearnedNotices::tell_delays(Time now, const Estimate& estimate, EventQueue& events) {
  const auto say = [&](const char* what, double late_s) {
    Reason text;
    text.format(
        "%s of the receiver come %.0f ms %s than the gateway takes them for; it is made up for",
        what, 1e3 * std::abs(late_s), late_s > 0 ? "later" : "earlier");
    events.notice(now, Notice::Level::warning, text);
  };
  if (anew(late_s_, estimate.late_s, kDelayStep_s)) say("positions", estimate.late_s);
  if (anew(heading_late_s_, estimate.heading_late_s, kDelayStep_s))
    say("headings", estimate.heading_late_s);
}

void LearnedNotices::tell_arm(Time now, const Estimate& estimate, const AntennaConfig& antenna,
                              EventQueue& events) {
  const bool ahead = anew(arm_ahead_m_, estimate.arm_ahead_m, kArmStep_m);
  const bool left = anew(arm_left_m_, estimate.arm_left_m, kArmStep_m);
  if (!ahead && !left) return;
  Reason text;
  text.format(
      "the antenna is not where it is configured: x %.2f m, y %.2f m would fit to how it goes "
      "round "
      "when the base turns, not %.2f, %.2f",
      antenna.x_m + estimate.arm_ahead_m, antenna.y_m + estimate.arm_left_m, antenna.x_m,
      antenna.y_m);
  events.notice(now, Notice::Level::warning, text);
}

void LearnedNotices::tell_shove(Time now, const Estimate& estimate, EventQueue& events) {
  const bool another =
      estimate.shoved != kNever && (shoved_ == kNever || estimate.shoved - shoved_ > kSameShove);
  if (!another) return;
  shoved_ = estimate.shoved;
  if (std::abs(estimate.shoved_m) < kShoved_m) return;
  Reason text;
  text.format("shoved %.2f m to the %s, by the inertial sensor", std::abs(estimate.shoved_m),
              estimate.shoved_m > 0 ? "left" : "right");
  events.notice(now, Notice::Level::warning, text);
}

}  // namespace drover::engine
