// What the WitMotion driver says of its sensor, in words for an operator.
#include <cmath>

#include "drivers/witmotion/driver.h"

namespace drover::witmotion {
namespace {

constexpr Duration kNoFrame = std::chrono::seconds(1);
constexpr Duration kTellFor = std::chrono::seconds(1);

}  // namespace

SourceHealth WitmotionDriver::health(Time now) const {
  SourceHealth health;
  health.last_good = last_good_;
  health.good = good_;
  health.bad = bad_;
  const bool fresh = last_good_ != kNever && now - last_good_ <= stale_;
  if (fresh) {
    health.state = SourceState::fresh;
    explain_oddity(now, health.reason);
  } else {
    health.state = last_good_ == kNever ? SourceState::never_heard : SourceState::stale;
    explain_silence(now, health.reason);
  }
  return health;
}

void WitmotionDriver::explain_silence(Time now, Reason& reason) const {
  const bool talks = last_byte_ != kNever && now - last_byte_ <= kNoFrame;
  const bool samples = last_cycle_ != kNever && now - last_cycle_ <= kTellFor;
  if (last_byte_ == kNever) {
    reason = "no data from the inertial sensor";
  } else if (talks && noise_since_ != kNever && now - noise_since_ >= kNoFrame) {
    reason.format("bytes but no frame at %u: baud, or another device?", setup_.line_baud());
  } else if (now - last_byte_ > stale_) {
    reason.format("inertial sensor silent for %.1f s", to_s(now - last_byte_));
  } else if (gravity_.wrong_axis()) {
    const Vector3 g = gravity_.mean_mps2();
    reason.format("gravity on the wrong axis (x %.1f, y %.1f, z %.1f m/s2): check mount_*", g.x,
                  g.y, g.z);
  } else if (frozen_.frozen() && samples) {
    reason = "the inertial sensor's readings stand still";
  } else if (now - last_saturated_ <= kTellFor) {
    reason = "acceleration or rate is at the end of its range";
  } else if (samples) {
    reason.format("samples come at %.1f Hz, %.1f Hz expected", pace_.pace_Hz(), rate_Hz_);
  } else {
    reason = "frames without acceleration or rate";
  }
}

void WitmotionDriver::explain_oddity(Time now, Reason& reason) const {
  const double pace = pace_.pace_Hz() / rate_Hz_;
  if (now - last_saturated_ <= kTellFor) {
    reason = "acceleration or rate was at the end of its range";
  } else if (setup_.refused()) {
    reason = "the inertial sensor does not take its settings";
  } else if (pace > kPaceTolerance || pace < 1 / kPaceTolerance) {
    reason.format("samples come at %.1f Hz, %.1f Hz expected", pace_.pace_Hz(), rate_Hz_);
  } else if (now - last_bad_quaternion_ <= kTellFor) {
    reason = "the quaternion is not of unit length: not used";
  }
}

}  // namespace drover::witmotion
