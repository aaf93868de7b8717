// What the NMEA 0183 driver says of its receiver, in words for an operator.
#include <cmath>

#include "drivers/nmea0183/driver.h"

namespace drover::nmea0183 {
namespace {

// A receiver at 1 Hz needs more than a second; a person wants to know within two.
constexpr Duration kNoSentence = std::chrono::seconds(2);
constexpr Duration kHeadingLost = std::chrono::seconds(1);
constexpr double kPaceTolerance = 1.5;

}  // namespace

SourceHealth Nmea0183Driver::health(Time now) const {
  SourceHealth health;
  health.last_good = last_news_;
  health.good = good_;
  health.bad = bad_;
  if (last_news_ == kNever) {
    health.state = SourceState::never_heard;
    explain_silence(now, health.reason);
  } else if (now - last_news_ > stale_) {
    health.state = SourceState::stale;
    explain_silence(now, health.reason);
  } else {
    health.state = SourceState::fresh;
    explain_oddity(now, health.reason);
  }
  return health;
}

void Nmea0183Driver::explain_silence(Time now, Reason& reason) const {
  const bool noise = noise_since_ != kNever && now - last_byte_ <= kNoSentence;
  if (last_byte_ == kNever) {
    reason = "no data from the receiver";
  } else if (noise && now - noise_since_ >= kNoSentence) {
    reason = "bytes but no sentence: baud, or another device?";
  } else if (now - last_byte_ > stale_) {
    reason.format("receiver silent for %.1f s", to_s(now - last_byte_));
  } else if (now - last_repeat_ <= stale_) {
    reason = "the receiver's time does not advance";
  } else if (last_position_ != kNever && now - last_position_ <= stale_) {
    reason.format("positions are %.1f s old when they come", to_s(now - last_news_));
  } else if (now - last_sentence_ > stale_) {
    reason = "bytes but no good sentence";
  } else {
    reason = "no position sentence (GGA)";
  }
}

void Nmea0183Driver::explain_oddity(Time now, Reason& reason) const {
  if (last_position_ == kNever) {
    reason = "no position sentence (GGA) yet";
  } else if (gga_oddity_ == Oddity::null_island) {
    reason = "position 0, 0 is not believed";
  } else if (gga_oddity_ == Oddity::position_missing) {
    reason = "the receiver claims a fix without a position";
  } else if (gga_oddity_ == Oddity::absurd_hdop) {
    reason = "the receiver claims a fix with unknown HDOP: not believed";
  } else if (gga_oddity_ == Oddity::unknown_quality) {
    reason = "unknown fix quality, taken as single";
  } else if (epoch_period_s_ * rate_Hz_ > kPaceTolerance ||
             epoch_period_s_ * rate_Hz_ < 1 / kPaceTolerance) {
    reason.format("positions come at %.1f Hz, %.1f Hz expected", 1 / epoch_period_s_, rate_Hz_);
  } else if (last_heading_ != kNever && now - last_heading_ > kHeadingLost) {
    reason = "the receiver gives no heading any more";
  } else if (date_oddity_ == Oddity::bad_date) {
    reason = "the receiver's date does not exist";
  } else if (date_oddity_ == Oddity::old_date) {
    reason = "the receiver's date is in the past (week rollover?)";
  }
}

}  // namespace drover::nmea0183
