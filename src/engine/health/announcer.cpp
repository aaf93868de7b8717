// Tells the journal when something begins to be wrong and when it is over.
#include "engine/health/announcer.h"

namespace drover::engine {
namespace {

constexpr Duration kAtMostEach = std::chrono::seconds(1);
/// Nothing was heard yet in the first moments: that is no news, unless it stays so.
constexpr Duration kQuietStart = std::chrono::seconds(1);

std::string_view over(Cause cause) {
  switch (cause) {
    case Cause::estop: return "e-stop released";
    case Cause::line_lost: return "safety lines readable again";
    case Cause::guard_has_bus: return "the guard gave the drives back";
    case Cause::bumper: return "bumper free";
    case Cause::tilt: return "no tilt beyond the limit any more";
    case Cause::drive_silent: return "all drives answer";
    case Cause::guard_silent: return "the guard answers";
    case Cause::drive_fault: return "no drive reports a fault";
    case Cause::latched: return "ready for a new start";
    case Cause::steep: return "on level ground again";
    case Cause::charger: return "charger unplugged";
    case Cause::program: return "droverd runs undisturbed again";
    case Cause::battery_critical: return "battery good for driving again";
    case Cause::near_zone: return "near zone free";
    case Cause::moved: return "the robot rests again";
    case Cause::foreign: return "nobody else commands the drives";
    case Cause::bus: return "CAN buses good";
    case Cause::origin: return "an origin is set";
    case Cause::receiver: return "receiver heard";
    case Cause::imu: return "IMU heard";
    case Cause::sensors: return "wheels, gyro and receiver do not contradict each other any more";
    case Cause::locate: return "position good";
    case Cause::jumped: return "a person has confirmed where the robot stands";
    case Cause::far_zone: return "far zone free";
    case Cause::battery_low: return "battery charged";
    case Cause::battery_warning: return "battery without a warning";
    case Cause::battery_silent: return "battery heard";
  }
  return "over";
}

}  // namespace

void Announcer::update(Time now, const HealthReport& report, EventQueue& events) {
  if (begun_ == kNever) begun_ = now;
  if (now - begun_ < kQuietStart) return;
  for (std::size_t i = 0; i < kCauseCount; ++i) {
    const std::uint32_t bit = 1U << i;
    const bool holds = (report.causes & bit) != 0;
    if (holds == ((told_ & bit) != 0)) continue;
    if (holds && now - told_at_[i] < kAtMostEach) continue;
    told_ ^= bit;
    if (holds) told_at_[i] = now;
    const auto cause = static_cast<Cause>(i);
    const auto level = !holds                        ? Notice::Level::info
                       : cause <= Cause::drive_fault ? Notice::Level::error
                                                     : Notice::Level::warning;
    events.notice(now, level, holds ? report.texts[i] : Reason(over(cause)));
  }
}

}  // namespace drover::engine
