// One digital input: an emergency-stop contact, a bumper, a zone of a safety scanner.
//
// Fail-safe by construction: before the first reading, when the line cannot be read and when
// readings cease, the line counts as active.
#pragma once

#include <span>

#include "drover/driver.h"
#include "drover/options.h"

namespace drover::gpio_line {

struct Settings {
  Line line = Line::estop;
  bool active_high = false;
  Duration active_debounce{};   ///< zero: an edge to active counts at once
  Duration release_debounce{};  ///< inactive for so long without a break before it is released
  Duration stale_after{};
};

/// Throws std::runtime_error naming the option, at start-up only.
Settings read_settings(const Options& options, Line line);
std::span<const OptionSpec> option_table();

class GpioLineDriver final : public Device, public LevelFace {
 public:
  explicit GpioLineDriver(const Settings& settings) : settings_(settings) {}

  void on_level(bool high, Time at, DriverOut& out) override;
  void on_lost(Time at, DriverOut& out) override;
  /// The levels themselves tell when the line can be read again.
  void on_link_up(Time) override {}
  void on_tick(Time now, DriverOut& out) override;
  SourceHealth health(Time now) const override;

 private:
  void report(bool active, Time at, DriverOut& out);

  Settings settings_;
  bool reported_ = false;  ///< something was reported at all
  bool active_ = true;     ///< the debounced meaning
  bool lost_ = false;
  bool settled_ = false;  ///< `active_` comes from readings that held, and is not presumed
  bool ever_settled_ = false;
  bool level_active_ = true;   ///< of the last reading
  Time level_since_ = kNever;  ///< since when the readings agree with `level_active_`
  Time last_reading_ = kNever;
  std::uint64_t readings_ = 0;
  std::uint64_t losses_ = 0;
};

}  // namespace drover::gpio_line
