// Sets the drive's watchdog over CAN (firmware 0.6) and believes only what is read back.
#pragma once

#include <optional>

#include "drivers/odrive/settings.h"
#include "drover/driver.h"

namespace drover::odrive {

/// One round: write time-out and enable, a little later read both. Three rounds, then it failed.
class WatchdogSetup {
 public:
  explicit WatchdogSetup(const Settings& settings) : settings_(settings) {}

  void begin(Time now);
  void on_tick(Time now, DriverOut& out);
  void on_reply(const SdoValue& value);
  bool done() const { return enable_agrees_ && timeout_agrees_; }
  bool failed() const { return failed_; }
  /// For people, when failed().
  Reason reason() const;

 private:
  Settings settings_;
  Time round_since_ = kNever;
  int rounds_ = 0;
  bool reads_sent_ = false;
  bool failed_ = false;
  bool enable_agrees_ = false;
  bool timeout_agrees_ = false;
  std::optional<float> timeout_s_;  ///< as read back
  std::optional<bool> enabled_;
};

}  // namespace drover::odrive
