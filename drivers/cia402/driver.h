// One drive of CiA 402, in a velocity mode.
//
// The node is set up anew whenever it may have lost its power, and nothing that it says is believed
// before. It arms only by a new request to run. One message carries the controlword and the target,
// so at rest it is told the word that leaves it as it is.
#pragma once

#include <array>

#include "drivers/canopen/emcy.h"
#include "drivers/canopen/nmt.h"
#include "drivers/cia402/rules.h"
#include "drivers/drives.h"
#include "drover/driver.h"

namespace drover::cia402 {

inline constexpr Channel kChannels[] = {{"motor", ChannelMode::velocity}};

class Cia402Driver final : public Device, public FrameFace, public Actuator {
 public:
  Cia402Driver(const Settings& settings, AxisId axis);

  void on_link_up(Time now) override;
  void on_tick(Time now, DriverOut& out) override;
  SourceHealth health(Time now) const override;
  Reason words(const Measurement& reported) const override { return told_.words(reported); }
  void on_frame(const CanFrame& frame, Time received, DriverOut& out) override;
  std::span<const FrameFilter> listens() const override { return hears_; }
  std::span<const Channel> channels() const override { return kChannels; }
  void on_setpoints(std::span<const Setpoint> wanted, Time now, DriverOut& out) override;
  std::span<const FrameRule> rules() const override { return rules_; }
  Effect effect(const Message& message, Time now) const override;
  double setpoint_radps(const Message& message, std::size_t channel) const override;
  std::size_t messages_per_cycle() const override { return 3; }
  StopRecipe stop_recipe() const override { return recipe_; }
  SilenceBehaviour silence() const override;

 private:
  /// What is known of the node.
  enum class Link : std::uint8_t {
    silent,      ///< asked now and then whether it is there
    setting_up,  ///< objects are written and read back
    starting,    ///< told to be operational
    ready,       ///< it is, and says what was mapped
  };
  /// What is wanted of it.
  enum class Phase : std::uint8_t { resting, arming, running, locked, idling };

  // receive.cpp
  void on_foreign(const CanFrame& frame, Time received);
  bool on_reply(const CanFrame& frame, Time received, DriverOut& out);
  bool on_sdo_answer(const CanFrame& frame, Time received, DriverOut& out);
  void on_heartbeat(canopen::NodeState state, Time received);
  void on_status(const Status& status, Time received, DriverOut& out);
  StatusInWords status(Time now) const;
  void report_status(Time now, bool always, DriverOut& out);

  // driver.cpp
  bool silent(Time now) const;
  bool lacks_status(Duration limit, Time now) const;
  bool attempts_to_run() const { return phase_ == Phase::arming || phase_ == Phase::running; }
  void lock(std::string_view why);
  void begin_setup(Time now);
  void keep_link(Time now, DriverOut& out);
  void feed_blindly(Time now, DriverOut& out);
  void feed(Time now, DriverOut& out);
  void ask_for_the_error(Time now, DriverOut& out);
  void take(AxisRequest request, Time now);
  void follow_status(Time now);
  void control(std::int32_t target, Time now, DriverOut& out);
  std::int32_t target_of(double velocity_radps);
  double radps_of(double units) const;
  void step_towards(canopen::DriveGoal goal, std::int32_t target, Time now, DriverOut& out);
  void send(const Command& command, Time now, DriverOut& out);

  Settings settings_;
  AxisId axis_;
  std::array<FrameFilter, 6> hears_;
  RuleList rules_;
  StepList steps_;
  canopen::SdoSetup setup_;
  StopRecipe recipe_;
  Reason silence_text_;
  Reason no_status_;

  // What the node said.
  Link link_ = Link::silent;
  Time link_since_ = kNever;
  Time next_question_ = kNever;
  Heard heard_;
  Time last_status_ = kNever;
  Status status_;
  std::optional<Position> position_;
  double velocity_radps_ = 0;
  bool may_hold_ = false;    ///< by what it said last, or by what it was told since
  std::uint16_t error_ = 0;  ///< of the emergency message, or 603F
  std::uint64_t bad_setpoints_ = 0;
  ForeignCommand foreign_;

  // What is wanted of it.
  Phase phase_ = Phase::resting;
  AxisRequest request_ = AxisRequest::rest;
  bool commanded_ = false;  ///< since the last tick
  bool held_ = false;       ///< before this driver began, as it was told
  bool was_held_ = false;   ///< it was told so, and has not been heard since
  bool lets_go_ = false;    ///< of what may be on, in silence
  Time phase_since_ = kNever;
  bool fault_ = false;  ///< `lock_reason_` says which
  Reason lock_reason_;
  Time reset_at_ = kNever;  ///< of a fault, for this request
  Command command_;
  Time last_command_ = kNever;
  Time last_step_ = kNever;
  Time last_fed_ = kNever;
  Time last_tick_ = kNever;

  ToldStatus told_;
};

}  // namespace drover::cia402
