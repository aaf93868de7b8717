// Writing and verifying two parameters by SDO.
#include "drivers/odrive/watchdog_setup.h"

#include <cmath>

namespace drover::odrive {
namespace {

using std::chrono::milliseconds;
/// A drive from firmware 0.6.11 on confirms writes with the same frame that answers reads; the
/// pause keeps a confirmation from being taken for what was read back.
constexpr Duration kReadAfter = milliseconds(20);
constexpr Duration kRound = milliseconds(100);
constexpr int kRounds = 3;

}  // namespace

void WatchdogSetup::begin(Time now) {
  const Settings settings = settings_;
  *this = WatchdogSetup(settings);
  round_since_ = now - kRound;
}

void WatchdogSetup::on_tick(Time now, DriverOut& out) {
  if (done() || failed_) return;
  const auto timeout_s = static_cast<float>(settings_.watchdog_timeout_s);
  if (now - round_since_ >= kRound) {
    if (rounds_ == kRounds) {
      failed_ = true;
      return;
    }
    ++rounds_;
    round_since_ = now;
    reads_sent_ = false;
    out.send(
        encode_sdo_write_float(settings_.node, settings_.watchdog_timeout_endpoint, timeout_s));
    out.send(encode_sdo_write_bool(settings_.node, settings_.watchdog_enable_endpoint, true));
  } else if (!reads_sent_ && now - round_since_ >= kReadAfter) {
    reads_sent_ = true;
    out.send(encode_sdo_read(settings_.node, settings_.watchdog_timeout_endpoint));
    out.send(encode_sdo_read(settings_.node, settings_.watchdog_enable_endpoint));
  }
}

void WatchdogSetup::on_reply(const SdoValue& value) {
  if (!reads_sent_) return;
  if (value.endpoint == settings_.watchdog_timeout_endpoint && value.size == 4) {
    timeout_s_ = value.as_float();
    timeout_agrees_ = std::abs(value.as_float() - settings_.watchdog_timeout_s) <=
                      1e-4 * settings_.watchdog_timeout_s;
  } else if (value.endpoint == settings_.watchdog_enable_endpoint && value.size >= 1) {
    enabled_ = (value.raw & 0xFFU) == 1;
    enable_agrees_ = *enabled_;
  }
}

Reason WatchdogSetup::reason() const {
  Reason reason;
  if (!timeout_s_ || !enabled_) {
    reason = "watchdog not set: the drive does not answer (end point ids of another firmware?)";
  } else {
    reason.format("watchdog not set: the drive has it %s with %.3f s instead of on with %.3f s",
                  *enabled_ ? "on" : "off", static_cast<double>(*timeout_s_),
                  settings_.watchdog_timeout_s);
  }
  return reason;
}

}  // namespace drover::odrive
