// The host's side of a chassis, whatever its wire: when it is commanded, fed, given up.
//
// There is no frame that arms it: who sends twists drives, unless its remote control has it. So it
// runs from the moment that it is heard and obeys; what was asked of it ends when it falls silent,
// has a fault or is taken over, and begins anew only by a new request to run.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "drivers/drives.h"
#include "drivers/gt01/settings.h"
#include "drover/driver.h"

namespace drover::gt01 {

inline constexpr Channel kChannels[] = {{"base", ChannelMode::twist}};

/// What a chassis said last of itself.
struct Condition {
  Time at = kNever;        ///< when it said so
  bool obeys = true;       ///< false: it says that it waits for somebody to command it
  bool remote_on = false;  ///< somebody may take it over, or already has
  std::uint64_t bits = 0;  ///< of what is wrong, as it sent them
  Reason trouble;          ///< what is wrong, or who else has it; empty: nothing
  bool powered = true;     ///< of a trouble: its motors still have power
  bool stops_all = false;  ///< an emergency stop or a bumper is among it
};

/// What its wire calls what it tells, for operators.
struct Words {
  std::string_view motion;  ///< "no speed (0x10)"
  std::string_view state;
};

class Host final {
 public:
  Host(const Settings& settings, AxisId axis, const Words& words)
      : settings_(settings), axis_(axis), words_(words) {}

  void on_link_up(Time now);
  void on_condition(const Condition& condition, Time received, DriverOut& out);
  /// Its speed, as it tells it; `sigma_mps` of what it contradicts itself by.
  void on_motion(const Twist& told, double sigma_mps, Time received, DriverOut& out);
  void on_supply(double voltage_V, Time received, DriverOut& out);
  /// Somebody else's command on the wire.
  void on_foreign(std::uint32_t id, Time received);
  void on_good(Time received);
  void on_bad() { ++heard_.bad; }

  void on_setpoints(std::span<const Setpoint> wanted, Time now);
  /// What is to be sent now, as the wire says it.
  std::optional<Twist> on_tick(Time now);
  void report_status(Time now, DriverOut& out);
  SourceHealth health(Time now) const;
  Reason words(const Measurement& reported) const { return told_.words(reported); }

  /// From the wire's numbers to true ones.
  Twist true_of(const Twist& told) const;

 private:
  enum class Phase : std::uint8_t { resting, arming, running, locked, idling };

  bool attempts_to_run() const { return phase_ == Phase::arming || phase_ == Phase::running; }
  bool gone(Time now) const;
  /// Of its speed and its state the one that ceased, as `words_` name it.
  struct Missing {
    std::string_view what;  ///< empty: both come
    Time last = kNever;
  };
  Missing missing(Duration limit, Time now) const;
  bool has_let_go() const;
  void lock(std::string_view why);
  void take(AxisRequest request, Time now);
  void follow(Time now);
  void watch_obedience(Time now);
  bool feeds(Time now) const;
  Twist told_of(const Twist& wanted);
  double clamped(double value, double most);
  Reason trouble(Time now) const;
  StatusInWords status(Time now) const;

  Settings settings_;
  AxisId axis_;
  Words words_;

  // What it said.
  Condition condition_;
  Twist measured_;
  Time last_motion_ = kNever;
  Heard heard_;
  double voltage_V_ = kAbsent;
  std::uint64_t bad_setpoints_ = 0;
  ForeignCommand foreign_;

  // What is wanted of it.
  Phase phase_ = Phase::resting;
  AxisRequest request_ = AxisRequest::rest;
  bool commanded_ = false;  ///< since the last tick
  Twist wanted_;
  Time phase_since_ = kNever;
  Reason lock_reason_;
  Twist sent_;
  Time last_sent_ = kNever;
  Time ignored_since_ = kNever;  ///< told to move, and stands

  ToldStatus told_;
};

/// How a stop by zeros ends; what it does in silence.
StopEnds ends_of(const Settings& settings);
SilenceBehaviour silence_of(const Settings& settings, std::string_view text);
Reason silence_text(const Settings& settings);
Effect effect_of(const std::optional<Twist>& asked);

}  // namespace drover::gt01
