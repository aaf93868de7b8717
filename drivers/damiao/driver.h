// One DAMIAO motor in MIT mode: a joint that follows position, velocity, effort, stiffness and
// damping.
//
// It says nothing by itself: each frame to it is answered by one feedback. While it is off it is
// asked for one, while it is on it is fed with commands; a stop is a command that only damps. It is
// enabled only by a new request to run, never by itself: not after a power cycle, a gap, a fault or
// a new link.
#pragma once

#include <array>

#include "drivers/damiao/settings.h"
#include "drivers/damiao/setup.h"
#include "drivers/drives.h"
#include "drivers/mit/talk.h"
#include "drover/driver.h"

namespace drover::damiao {

inline constexpr Channel kChannels[] = {{"joint", ChannelMode::impedance}};

class DamiaoDriver final : public Device, public FrameFace, public Actuator {
 public:
  DamiaoDriver(const Settings& settings, AxisId axis);

  void on_frame(const CanFrame& frame, Time received, DriverOut& out) override;
  void on_tick(Time now, DriverOut& out) override;
  void on_setpoints(std::span<const Setpoint> wanted, Time now, DriverOut& out) override;
  void on_link_up(Time now) override;
  SourceHealth health(Time now) const override;
  Reason words(const Measurement& reported) const override { return told_.words(reported); }
  std::span<const FrameFilter> listens() const override { return hears_; }
  std::span<const Channel> channels() const override { return kChannels; }
  std::span<const FrameRule> rules() const override { return rules_; }
  Effect effect(const Message& message, Time now) const override;
  /// Of what has neither stiffness nor effort; all else does not ask for a velocity alone.
  double setpoint_radps(const Message& message, std::size_t channel) const override;
  ImpedanceRange impedance_range(std::size_t) const override { return settings_.joint.range(); }
  StopRecipe stop_recipe() const override { return recipe_; }
  SilenceBehaviour silence() const override {
    return mit::silence_of(settings_.timeout_ms, silence_text_);
  }

  /// Set points that were not numbers (sent as damping) or beyond a range (clamped).
  std::uint64_t bad_setpoints() const { return packer_.bad(); }

 private:
  enum class Phase : std::uint8_t {
    resting,  ///< damps when it is on, is asked when it is off
    arming,   ///< registers, then errors, then enabling; damps all the while
    running,  ///< set points go out
    locked,   ///< still asked to run, but only a new request will arm again
    idling,   ///< damps until slow, then off
  };

  // receive.cpp
  void on_command(const CanFrame& frame, Time received);
  void on_request(const CanFrame& frame, Time received);
  void on_answer(const CanFrame& frame, Time received, DriverOut& out);
  void on_feedback(const Feedback& feedback, Time received, DriverOut& out);
  void follow_feedback(Time now);
  void report_temperature(Time received, DriverOut& out);
  StatusInWords status(Time now) const;
  StatusInWords fault_status(StatusInWords status) const;
  void report_status(Time now, bool always, DriverOut& out);

  // driver.cpp
  bool silent(Time now) const;
  bool attempts_to_run() const;
  void lock(std::string_view why);
  void start_arming(Time now, DriverOut& out);
  void take(const Setpoint& command, Time now, DriverOut& out);
  void control(const Setpoint& command, Time now, DriverOut& out);
  void look_at_arming(Time now);
  void arm(Time now, DriverOut& out);
  void keep_alive(Time now, DriverOut& out);
  void look_for_it(Time now, DriverOut& out);
  void send_command(const CanFrame& frame, Time now, DriverOut& out);

  Settings settings_;
  mit::SetpointPacker packer_;
  AxisId axis_;
  std::array<FrameFilter, 3> hears_;
  std::array<FrameRule, 2> rules_;
  StopRecipe recipe_;
  CanFrame damp_;
  Reason silence_text_;
  Setup setup_;

  // What the motor said.
  Heard heard_;                ///< alive: its feedback
  Time heard_since_ = kNever;  ///< without a gap
  Feedback feedback_;
  AxisTemperature temperature_;
  Time temperature_at_ = kNever;
  ForeignCommand foreign_;

  // What is wanted of it.
  Phase phase_ = Phase::resting;
  AxisRequest request_ = AxisRequest::rest;
  bool commanded_ = false;  ///< since the last tick
  std::size_t before_ = 0;  ///< frames of others in this cycle's output
  Time phase_since_ = kNever;
  mit::LettingGo letting_go_;
  Time first_attempt_ = kNever;
  Time last_attempt_ = kNever;
  Time cleared_at_ = kNever;  ///< errors, for this request
  bool fault_ = false;        ///< `lock_reason_` says which
  Reason lock_reason_;
  mit::Talk talk_;
  Time last_sought_ = kNever;  ///< by a question, since the link came up
  mit::OthersDamping guard_;

  ToldStatus told_;
};

}  // namespace drover::damiao
