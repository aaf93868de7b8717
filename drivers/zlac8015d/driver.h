// Both wheels of a ZLAC8015D, in velocity control (CiA 402).
//
// One controlword is for both, so they arm and stop together. The node is set up anew whenever it
// may have lost its power, and nothing that it says is believed before. It arms only by a new
// request to run. Targets of zero are sent in every state once it is set up: they feed its
// time-out. So they are in silence, to one that may hold the robot.
#pragma once

#include "drivers/canopen/emcy.h"
#include "drivers/canopen/nmt.h"
#include "drivers/drives.h"
#include "drivers/zlac8015d/rules.h"
#include "drover/driver.h"

namespace drover::zlac8015d {

inline constexpr Channel kChannels[] = {{"left", ChannelMode::velocity},
                                        {"right", ChannelMode::velocity}};

class Zlac8015dDriver final : public Device, public FrameFace, public Actuator {
 public:
  Zlac8015dDriver(const Settings& settings, std::array<AxisId, kWheels> axes);

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
  void on_heartbeat(canopen::NodeState state, Time received);
  void on_status(const Status& status, Time received);
  void report_motion(const Pair& speeds, Time received, DriverOut& out);
  StatusInWords status(Time now) const;
  AxisState state_of_drive() const;
  Reason fault_text() const;
  void report_status(Time now, bool always, DriverOut& out);

  // driver.cpp
  bool silent(Time now) const;
  bool lacks_status(Duration limit, Time now) const;
  bool attempts_to_run() const { return phase_ == Phase::arming || phase_ == Phase::running; }
  void lock(std::string_view why);
  void begin_setup(bool booted, Time now);
  void keep_link(Time now, DriverOut& out);
  void feed_blindly(Time now, DriverOut& out);
  void take(AxisRequest request, Time now);
  void start_arming(Time now);
  void follow_status(Time now);
  void control(const Pair& targets, Time now, DriverOut& out);
  Pair targets_of(std::span<const Setpoint> wanted, AxisRequest request);
  std::int32_t target_of(std::size_t wheel, double velocity_radps);
  double radps_of(std::size_t wheel, double rpm) const;
  void send_controlword(canopen::DriveGoal goal, Time now, DriverOut& out);
  void send_targets(const Pair& targets, Time now, bool at_once, DriverOut& out);

  Settings settings_;
  std::array<AxisId, kWheels> axes_;
  std::array<FrameFilter, 5> hears_;
  RuleList rules_;
  StepList steps_;
  StepList fed_steps_;
  canopen::SdoSetup setup_;
  StopRecipe recipe_;
  Reason silence_text_;
  Reason no_status_;

  // What the node said.
  Link link_ = Link::silent;
  Time link_since_ = kNever;
  Time next_question_ = kNever;
  bool may_hold_ = false;  ///< by what it said last, or by what it was told since
  bool held_ = false;      ///< before this driver began, as it was told
  Heard heard_;
  Time last_answer_ = kNever;  ///< by its service channel
  Time last_speeds_ = kNever;
  Time last_status_ = kNever;
  Status status_;
  Pair positions_{};
  bool positions_known_ = false;
  std::array<double, kWheels> velocity_radps_{};
  std::uint16_t emergency_ = 0;
  std::uint64_t bad_setpoints_ = 0;
  ForeignCommand foreign_;

  // What is wanted of it.
  Phase phase_ = Phase::resting;
  AxisRequest request_ = AxisRequest::rest;
  bool commanded_ = false;  ///< since the last tick
  Time phase_since_ = kNever;
  bool fault_ = false;  ///< `lock_reason_` says which
  Reason lock_reason_;
  Time reset_at_ = kNever;  ///< of a fault, for this request
  std::uint16_t controlword_ = 0;
  Time last_controlword_ = kNever;
  Pair target_{};
  Time last_targets_ = kNever;

  ToldStatus told_;
};

}  // namespace drover::zlac8015d
