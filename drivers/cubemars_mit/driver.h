// One CubeMars motor in MIT mode: a joint that follows position, velocity, effort, stiffness and
// damping.
//
// It says nothing by itself, and never whether it is enabled: each frame to it is answered by one
// feedback. What is believed of its power stage is what it was told last and answered to. A stop is
// a command that only damps. It is enabled only by a new request to run, never by itself: not after
// a gap, a fault, a new link or somebody else's command.
#pragma once

#include "drivers/cubemars_mit/settings.h"
#include "drivers/drives.h"
#include "drivers/mit/talk.h"
#include "drover/driver.h"
#include "drover/fixed_vector.h"

namespace drover::cubemars_mit {

inline constexpr Channel kChannels[] = {{"joint", ChannelMode::impedance}};

class CubemarsDriver final : public Device, public FrameFace, public Actuator {
 public:
  CubemarsDriver(const Settings& settings, AxisId axis);

  void on_frame(const CanFrame& frame, Time received, DriverOut& out) override;
  void on_tick(Time now, DriverOut& out) override;
  void on_setpoints(std::span<const Setpoint> wanted, Time now, DriverOut& out) override;
  void on_link_up(Time now) override;
  SourceHealth health(Time now) const override;
  Reason words(const Measurement& reported) const override { return told_.words(reported); }
  std::span<const FrameFilter> listens() const override { return {hears_.data(), hears_.size()}; }
  std::span<const Channel> channels() const override { return kChannels; }
  std::span<const FrameRule> rules() const override { return {rules_.data(), rules_.size()}; }
  Effect effect(const Message& message, Time now) const override;
  double setpoint_radps(const Message& message, std::size_t channel) const override;
  ImpedanceRange impedance_range(std::size_t) const override { return settings_.joint.range(); }
  StopRecipe stop_recipe() const override { return recipe_; }
  SilenceBehaviour silence() const override {
    return mit::silence_of(settings_.timeout_ms, silence_text_);
  }

 private:
  /// It is told to enable itself more than once: no answer tells whether it did.
  static constexpr int kAttempts = 3;

  enum class Phase : std::uint8_t {
    resting,  ///< damps, unless it is off
    arming,   ///< damps, and is enabled
    running,  ///< set points go out
    locked,   ///< still asked to run, but only a new request will arm again
    idling,   ///< damps until slow, then off
  };
  /// What is known of its power stage.
  enum class Power : std::uint8_t {
    unknown,  ///< may be on: nothing but damping
    leaving,  ///< is told to let go, and nothing else; its answer has not come
    off,
    on,
  };

  // receive.cpp
  void on_command(const CanFrame& frame, Time received);
  void on_feedback(const Feedback& feedback, Time received, DriverOut& out);
  void follow_feedback(Time now);
  bool carries() const;
  void report_temperature(Time received, DriverOut& out);
  StatusInWords status(Time now) const;
  StatusInWords fault_status(StatusInWords status) const;
  void report_status(Time now, DriverOut& out);

  // driver.cpp
  bool silent(Time now) const;
  bool attempts_to_run() const;
  void lock(std::string_view why);
  void start_arming(Time now);
  void take(const Setpoint& command, Time now, DriverOut& out);
  void control(const Setpoint& command, Time now, DriverOut& out);
  void look_at_gaps(Time now);
  void arm(Time now, DriverOut& out);
  void let_go(Time now);
  void damp_alone(Time now, DriverOut& out);
  void keep_alive(Time now, DriverOut& out);
  void leave(Duration period, Time now, DriverOut& out);
  void send_command(const CanFrame& frame, Time now, DriverOut& out);

  Settings settings_;
  AxisId axis_;
  mit::SetpointPacker packer_;
  FixedVector<FrameFilter, 2> hears_;
  FixedVector<FrameRule, 2> rules_;
  StopRecipe recipe_;
  CanFrame damp_;
  Reason silence_text_;

  // What the motor said.
  Heard heard_;                ///< alive: since the link came up
  Time heard_since_ = kNever;  ///< without a gap
  Feedback feedback_;
  AxisTemperature temperature_;
  Time temperature_at_ = kNever;
  ForeignCommand foreign_;

  // What is wanted of it.
  Phase phase_ = Phase::resting;
  AxisRequest request_ = AxisRequest::rest;
  bool commanded_ = false;  ///< since the last tick
  Time phase_since_ = kNever;
  mit::LettingGo letting_go_;
  int attempts_ = 0;  ///< to enable it
  Time last_attempt_ = kNever;
  bool fault_ = false;  ///< `lock_reason_` says which
  Reason lock_reason_;

  // What it was told.
  Power power_ = Power::leaving;
  Time leaving_since_ = kNever;    ///< the first frame of it
  Time listening_since_ = kNever;  ///< for who else may feed it
  mit::Talk talk_;
  mit::OthersDamping guard_;

  ToldStatus told_;
};

}  // namespace drover::cubemars_mit
