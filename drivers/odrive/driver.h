// One axis of an ODrive on CANSimple, in velocity control.
//
// It arms only by a new request to run, never by itself: not after a reboot of the drive, a gap in
// its heartbeat, a fault or a new link. Set points of zero are sent in every state once the node
// was heard, or where it is known to have held, because they feed the drive's watchdog and a drive
// that expires coasts.
#pragma once

#include "drivers/drives.h"
#include "drivers/odrive/errors.h"
#include "drivers/odrive/poller.h"
#include "drivers/odrive/watchdog_setup.h"
#include "drover/driver.h"

namespace drover::odrive {

inline constexpr Channel kChannels[] = {{"axis"}};

class OdriveDriver final : public Device, public FrameFace, public Actuator {
 public:
  OdriveDriver(const Settings& settings, AxisId axis);

  void on_frame(const CanFrame& frame, Time received, DriverOut& out) override;
  void on_tick(Time now, DriverOut& out) override;
  void on_setpoints(std::span<const Setpoint> wanted, Time now, DriverOut& out) override;
  void on_link_up(Time now) override;
  SourceHealth health(Time now) const override;
  Reason words(const Measurement& reported) const override { return told_.words(reported); }
  std::span<const FrameFilter> listens() const override { return {&hears_, 1}; }
  std::span<const Channel> channels() const override { return kChannels; }
  std::span<const FrameRule> rules() const override { return rules_; }
  Effect effect(const Message& message, Time now) const override;
  double setpoint_radps(const Message& message, std::size_t channel) const override;
  StopRecipe stop_recipe() const override { return recipe_; }
  SilenceBehaviour silence() const override;

  /// Set points that were not numbers (sent as zero) or beyond the limit (clamped).
  std::uint64_t bad_setpoints() const { return bad_setpoints_; }

 private:
  enum class Phase : std::uint8_t {
    resting,      ///< zero, whatever state the drive is in
    configuring,  ///< the watchdog is being set
    arming,       ///< zero, asking for closed loop
    running,      ///< set points go out
    locked,       ///< still asked to run, but only a new request will arm again
    idling,       ///< zero until slow, then power stage off
  };

  // receive.cpp
  bool on_reply(std::uint8_t command, const CanFrame& frame, Time received, DriverOut& out);
  void on_foreign(const CanFrame& frame, Time received);
  bool on_heartbeat(const CanFrame& frame, Time received, DriverOut& out);
  bool on_estimates(const CanFrame& frame, Time received, DriverOut& out);
  bool on_errors(std::uint8_t command, const CanFrame& frame);
  bool on_effort(const CanFrame& frame, double Nm_per_unit, Time received);
  StatusInWords status(Time now) const;
  bool only_unfed() const;
  void report_status(Time now, bool always, DriverOut& out);

  // driver.cpp
  bool silent(Time now) const;
  bool attempts_to_run() const;
  void start_arming(Time now, DriverOut& out);
  void follow_heartbeat(Time now);
  void lock(std::string_view why);
  double motor_turnps(double velocity_radps);
  bool has_room(const DriverOut& out) const;
  void send_setpoint(double turnps, Time now, bool at_once, DriverOut& out);
  void arm(Time now, DriverOut& out);
  void take(const Setpoint& command, Time now, DriverOut& out);
  void control(const Setpoint& command, Time now, DriverOut& out);
  void feed_blindly(bool held, Time now, DriverOut& out);

  Settings settings_;
  AxisId axis_;

  // What the drive said. What each of its frames changes lies together: of many drives no more than
  // that has to stay in the cache.
  Heard heard_;  ///< alive: its heartbeat
  Time last_estimates_ = kNever;
  double velocity_radps_ = 0;
  double effort_Nm_ = kAbsent;
  Time effort_at_ = kNever;

  bool may_hold_ = false;  ///< closed loop, by what it said last, also before its link was lost

  FrameFilter hears_;  ///< all of its node
  RuleList rules_;
  StopRecipe recipe_;
  Reason silence_text_;
  Poller poller_;
  WatchdogSetup watchdog_;

  Heartbeat heartbeat_;
  ErrorReport errors_;
  ForeignCommand foreign_;

  // What is wanted of it.
  Phase phase_ = Phase::resting;
  AxisRequest request_ = AxisRequest::rest;
  double holding_turnps_ = 0;  ///< what a hold asks of the motor while it is being armed
  bool commanded_ = false;     ///< since the last tick
  std::size_t before_ = 0;     ///< frames of others in this cycle's output
  Time phase_since_ = kNever;
  Time last_attempt_ = kNever;
  bool attempted_ = false;
  enum class ArmingStep : std::uint8_t { first, mode, state };
  ArmingStep arming_step_ = ArmingStep::first;  ///< the next one
  Time cleared_at_ = kNever;                    ///< errors, for this request
  bool fault_ = false;                          ///< `lock_reason_` says which
  Reason lock_reason_;
  Time last_setpoint_ = kNever;
  double last_turnps_ = 0;
  std::uint64_t bad_setpoints_ = 0;

  ToldStatus told_;
};

}  // namespace drover::odrive
