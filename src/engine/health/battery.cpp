// Whether the battery lets a task start or go on, in an operator's words.
#include "engine/health/battery.h"

#include <cmath>

namespace drover::engine {
namespace {

/// An alarm must stand in two samples: one may be torn inside the device.
constexpr Duration kAlarmOn = std::chrono::milliseconds(500);
/// A pack's current is a mean, and told late: until then it may be of a brake.
constexpr Duration kStood = std::chrono::seconds(1);
constexpr const char* kCharging = "charging: unplug the charger first";
constexpr const char* kWasPlugged = "the charger was connected when the battery was last heard";

}  // namespace

template <class... Values>
Reason BatteryMonitor::said(const char* format, Values... values) const {
  Reason what;
  what.format(format, values...);
  const std::string_view name = name_.view();
  const std::string_view rest = what.view();
  Reason all;
  all.format("%.*s%.*s", static_cast<int>(name.size()), name.data(), static_cast<int>(rest.size()),
             rest.data());
  return all;
}

void BatteryMonitor::Limit::update(bool known, bool beyond, Time now, Duration on, Duration off) {
  if (!known) return;
  if (!begun_) {
    begun_ = true;
    holds_ = beyond;
  }
  if (beyond == holds_) {
    since_ = kNever;
    return;
  }
  if (since_ == kNever) since_ = now;
  if (now - since_ < (beyond ? on : off)) return;
  holds_ = beyond;
  since_ = kNever;
}

/// A value that is not known is beyond nothing.
BatteryMonitor::Beyond BatteryMonitor::beyond(const BatterySample& sample) const {
  Beyond is;
  is.low = sample.soc_percent < config_.battery_low_percent;
  is.critical = sample.soc_percent < config_.battery_critical_percent;
  is.hot = sample.temperature_degC > config_.battery_hot_degC;
  is.too_hot = sample.temperature_degC > config_.battery_too_hot_degC;
  is.apart = sample.max_cell_V - sample.min_cell_V > config_.battery_cell_spread_V;
  is.alarm = sample.alarm == BatteryAlarm::critical;
  return is;
}

void BatteryMonitor::judge(Time now, const BatterySample& sample) {
  const Duration hold = from_s(config_.battery_hold_s);
  const auto limit = [&](Limit& which, double value, bool is_beyond) {
    which.update(!std::isnan(value), is_beyond, now, hold, hold);
  };
  const Beyond is = beyond(sample);
  limit(low_, sample.soc_percent, is.low);
  limit(critical_, sample.soc_percent, is.critical);
  limit(hot_, sample.temperature_degC, is.hot);
  limit(too_hot_, sample.temperature_degC, is.too_hot);
  limit(apart_, sample.max_cell_V - sample.min_cell_V, is.apart);
  alarm_.update(true, is.alarm, now, kAlarmOn, hold);
}

void BatteryMonitor::judge_charger(Time at, const BatterySample& sample) {
  const bool stood = moved_ == kNever || at - moved_ >= kStood;
  if (stood || !sample.charges) charges_ = sample.charges;
}

/// Empty when it is neither.
Reason BatteryMonitor::empty_or_broken(const BatterySnapshot& battery, const Beyond& beyond) const {
  Reason why;
  const BatterySample& sample = battery.sample;
  const auto alarm = battery.alarms.view();
  if (beyond.critical) {
    why = said(" empty: %.0f %%, at least %.0f %% are needed", sample.soc_percent,
               config_.battery_critical_percent);
  } else if (beyond.alarm) {
    why = said(": %.*s", static_cast<int>(alarm.empty() ? 5 : alarm.size()),
               alarm.empty() ? "alarm" : alarm.data());
  } else if (beyond.too_hot) {
    why = said(" too hot: %.0f C", sample.temperature_degC);
  } else if (beyond.apart) {
    why = said(" cells too far apart: %.2f V to %.2f V", sample.min_cell_V, sample.max_cell_V);
  }
  return why;
}

Reason BatteryMonitor::past(const Limit& limit, const char* what, Time now, double value,
                            const char* unit) const {
  if (std::isnan(value)) return said(" %s until %.0f s ago", what, limit.back_s(now));
  return said(" %s until %.0f s ago, %.0f %s now", what, limit.back_s(now), value, unit);
}

Reason BatteryMonitor::held_critical(Time now, const BatterySnapshot& battery) const {
  const BatterySample& sample = battery.sample;
  const auto beyond = [](const Limit& limit) { return limit.holds() && !limit.is_past(); };
  const double soc_percent = sample.soc_percent;
  if (beyond(critical_) && std::isnan(soc_percent)) return said(" empty when its charge was told");
  const Reason is = empty_or_broken(battery, {.critical = beyond(critical_),
                                              .too_hot = beyond(too_hot_),
                                              .apart = beyond(apart_),
                                              .alarm = beyond(alarm_)});
  if (!is.empty()) return is;
  if (critical_.holds()) return past(critical_, "was empty", now, soc_percent, "%");
  if (alarm_.holds()) return said(" had an alarm until %.0f s ago", alarm_.back_s(now));
  if (too_hot_.holds()) return past(too_hot_, "was too hot", now, sample.temperature_degC, "C");
  if (!apart_.holds()) return {};
  return said(" cells were too far apart until %.0f s ago, %.2f V to %.2f V now",
              apart_.back_s(now), sample.min_cell_V, sample.max_cell_V);
}

Reason BatteryMonitor::held_low(Time now, const BatterySample& sample) const {
  if (!low_.holds() || critical_.holds()) return {};
  if (low_.is_past()) return past(low_, "was low", now, sample.soc_percent, "%");
  if (std::isnan(sample.soc_percent)) return said(" low when its charge was told");
  return said(" low: %.0f %%", sample.soc_percent);
}

Reason BatteryMonitor::held_hot(Time now, const BatterySample& sample) const {
  if (!hot_.holds() || too_hot_.holds()) return {};
  if (hot_.is_past()) return past(hot_, "was hot", now, sample.temperature_degC, "C");
  if (std::isnan(sample.temperature_degC)) return said(" hot when its temperature was told");
  return said(" hot: %.0f C", sample.temperature_degC);
}

const BatteryVerdict& BatteryMonitor::update(Time now, const BatterySnapshot& battery,
                                             const SourceHealth& source, bool stands) {
  verdict_ = {};
  if (!stands) moved_ = now;
  const bool old = battery.time != kNever && now - battery.time > from_s(config_.battery_stale_s);
  if (battery.time == kNever || source.state != SourceState::fresh || old) {
    const Reason& why = source.reason;
    verdict_.silent =
        said(" unknown: %.*s", static_cast<int>(why.view().size()), why.view().data());
    if (why.empty()) verdict_.silent = said(" unknown: no answer");
  } else if (!source.reason.empty()) {
    verdict_.silent =
        said(": %.*s", static_cast<int>(source.reason.view().size()), source.reason.view().data());
  }
  if (battery.time == kNever) return verdict_;
  const BatterySample& sample = battery.sample;
  if (battery.time != judged_) {
    judged_ = battery.time;
    judge(battery.time, sample);
    judge_charger(battery.time, sample);
  }
  // What was last known of a limit stays true while nothing new is heard.
  if (sample.charger_connected) {
    if (old) {
      verdict_.plugged = kWasPlugged;
    } else {
      verdict_.charger = kCharging;
    }
  }
  verdict_.critical = held_critical(now, battery);
  const Beyond is = beyond(sample);
  verdict_.present = empty_or_broken(battery, is);
  if (verdict_.present.empty() && is.low)
    verdict_.present = said(" low: %.0f %%", sample.soc_percent);
  if (charges_) verdict_.present = old ? kWasPlugged : kCharging;
  const auto alarm = battery.alarms.view();
  verdict_.low = held_low(now, sample);
  if (sample.alarm == BatteryAlarm::warning) {
    verdict_.warning = said(": %.*s", static_cast<int>(alarm.size()), alarm.data());
  } else {
    verdict_.warning = held_hot(now, sample);
  }
  return verdict_;
}

}  // namespace drover::engine
