// Whether the battery lets a task start or go on, in an operator's words.
#pragma once

#include "drover/driver.h"
#include "drover/snapshot.h"
#include "engine/config.h"

namespace drover::engine {

/// Each empty when there is nothing to say.
struct BatteryVerdict {
  Reason charger;   ///< a task ends, and none starts
  Reason plugged;   ///< no task starts: the charger was connected before the battery fell silent
  Reason critical;  ///< a task ends, and none starts
  Reason low;       ///< no task starts
  Reason present;   ///< no task starts: the last value is beyond a limit, for however short a time
  Reason warning;   ///< told only
  Reason silent;    ///< told only: nothing is known
};

/// Limits count when a value was beyond them without a break for health.battery_hold_s, and no
/// longer when it was back for as long: a sag under load is no empty battery. The first sample
/// counts at once, so that no task starts on an empty one. A start is judged by the last value: a
/// robot at rest has no sag, and what charges it then is a charger.
class BatteryMonitor final {
 public:
  /// `name` begins its texts.
  explicit BatteryMonitor(const HealthConfig& config, const Name& name = "battery")
      : config_(config), name_(name) {}
  /// `stands`: no wheel turns, and none gives back what braking is worth.
  const BatteryVerdict& update(Time now, const BatterySnapshot& battery, const SourceHealth& source,
                               bool stands = true);

 private:
  /// A limit with memory. A value that is not known changes nothing.
  class Limit {
   public:
    void update(bool known, bool beyond, Time now, Duration on, Duration off);
    bool holds() const { return holds_; }
    /// It holds only because the value is not back for long enough yet.
    bool is_past() const { return holds_ && since_ != kNever; }
    double back_s(Time now) const { return to_s(now - since_); }

   private:
    bool begun_ = false;
    bool holds_ = false;
    Time since_ = kNever;  ///< since when the values say the opposite of `holds_`
  };

  void judge(Time now, const BatterySample& sample);
  void judge_charger(Time at, const BatterySample& sample);
  /// What is beyond its limit.
  struct Beyond {
    bool low = false;
    bool critical = false;
    bool hot = false;
    bool too_hot = false;
    bool apart = false;
    bool alarm = false;
  };
  Beyond beyond(const BatterySample& sample) const;
  Reason empty_or_broken(const BatterySnapshot& battery, const Beyond& beyond) const;
  /// Of limits that hold: what is so, or was until a moment ago.
  Reason held_critical(Time now, const BatterySnapshot& battery) const;
  Reason held_low(Time now, const BatterySample& sample) const;
  Reason held_hot(Time now, const BatterySample& sample) const;
  /// "battery was low until 4 s ago, 80 % now"
  Reason past(const Limit& limit, const char* what, Time now, double value, const char* unit) const;

  /// "battery empty: 8 %"
  template <class... Values>
  Reason said(const char* format, Values... values) const;

  HealthConfig config_;
  Name name_;
  BatteryVerdict verdict_;
  Limit low_;
  Limit critical_;
  Limit hot_;
  Limit too_hot_;
  Limit apart_;
  Limit alarm_;
  Time judged_ = kNever;  ///< of the last sample
  Time moved_ = kNever;   ///< when it was last seen to move
  bool charges_ = false;  ///< at rest, by the last sample that was taken at rest
};

}  // namespace drover::engine
