#include "drivers/hipnuc_can/driver.h"

#include <algorithm>

#include "drover/rotation.h"

namespace drover::hipnuc_can {
namespace {

using std::chrono::milliseconds;

/// Older than a few samples it is another attitude.
constexpr Duration kOrientationStale = milliseconds(50);
constexpr Duration kTellFor = milliseconds(1000);

}  // namespace

HipnucCanDriver::HipnucCanDriver(const Settings& settings)
    : settings_(settings), listens_(filters_of(settings.address)) {}

void HipnucCanDriver::on_link_up(Time) {
  acceleration_.waits = false;
  rates_.waits = false;
  last_orientation_ = kNever;
}

void HipnucCanDriver::on_frame(const CanFrame& frame, Time received, DriverOut& out) {
  const auto content = content_of(settings_.address, frame);
  if (!content) return;
  const Dialect dialect = settings_.address.dialect;
  switch (*content) {
    case Content::acceleration:
      return take(acceleration_,
                  read_acceleration(dialect, frame, settings_.acceleration_range_mps2), received,
                  out);
    case Content::rates:
      return take(rates_, read_rates(dialect, frame, settings_.rate_range_radps), received, out);
    case Content::quaternion:
      if (const auto orientation = read_quaternion(frame)) {
        ++good_;
        orientation_ = *orientation;
        last_orientation_ = received;
      } else {
        ++bad_;
      }
      return;
    case Content::temperature:
      if (const auto temperature_degC = read_temperature_degC(frame)) {
        ++good_;
        temperature_degC_ = *temperature_degC;
      } else {
        ++bad_;
      }
      return;
  }
}

void HipnucCanDriver::take(Half& half, const std::optional<Triple>& triple, Time received,
                           DriverOut& out) {
  if (!triple) {
    ++bad_;
    return;
  }
  ++good_;
  half = {*triple, received, true};
  const Time other = &half == &rates_ ? acceleration_.received : rates_.received;
  if (acceleration_.waits && rates_.waits && received - other <= settings_.pair_window)
    report_pair(received, out);
}

void HipnucCanDriver::report_pair(Time received, DriverOut& out) {
  acceleration_.waits = false;
  rates_.waits = false;
  last_sample_ = received;
  ImuSample sample;
  sample.acceleration_mps2 = rotate(settings_.mount, acceleration_.triple.value);
  sample.angular_velocity_radps = rotate(settings_.mount, rates_.triple.value);
  sample.saturated = acceleration_.triple.saturated || rates_.triple.saturated;
  // One that stands at its end tells nothing: another sensor has to take over.
  (sample.saturated ? last_saturated_ : last_good_) = received;
  sample.temperature_degC = temperature_degC_;
  if (received - last_orientation_ <= kOrientationStale) {
    sample.has_orientation = true;
    sample.orientation = orientation_ * conjugate(settings_.mount);
  }
  // It has no clock of its own in these frames: the first half came when it was true.
  const Time taken = std::min(acceleration_.received, rates_.received);
  out.report({taken, received, sample});
}

SourceHealth HipnucCanDriver::health(Time now) const {
  SourceHealth health{.state = SourceState::fresh,
                      .last_good = last_good_,
                      .good = good_,
                      .bad = bad_,
                      .reason = {}};
  if (now - last_good_ <= settings_.stale) {
    if (now - last_saturated_ <= kTellFor)
      health.reason = "acceleration or rate was at the end of its range";
    return health;
  }
  health.state = last_good_ == kNever ? SourceState::never_heard : SourceState::stale;
  const bool accelerations = now - acceleration_.received <= settings_.stale;
  const bool rates = now - rates_.received <= settings_.stale;
  if (now - last_saturated_ <= settings_.stale) {
    health.reason = "acceleration or rate is at the end of its range";
  } else if (accelerations && rates) {
    health.reason = "accelerations and rates do not come together: is their output rate the same?";
  } else if (accelerations) {
    health.reason = "accelerations come, but no rates: switch their output on";
  } else if (rates) {
    health.reason = "rates come, but no accelerations: switch their output on";
  } else if (last_sample_ != kNever) {
    health.reason.format("silent for %.1f s", to_s(now - last_sample_));
  } else if (settings_.address.dialect == Dialect::canopen) {
    health.reason =
        "never heard: bit rate, node, wires? With CANopen frames it waits for an NMT start";
  } else {
    health.reason = "never heard: bit rate, node, wires? Or it is set to answer on request only";
  }
  return health;
}

}  // namespace drover::hipnuc_can
