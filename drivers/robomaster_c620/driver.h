// Four RoboMaster motors, commanded by one frame of currents. The controllers take a current and
// nothing else, so the speed loop is here (motor.h).
//
// They need no arming, so the latch is here as well: they move only by a new request to run, and
// arm and stop together. A controller keeps the last current that it heard, so a frame leaves in
// every cycle, once one of them was heard.
#pragma once

#include "drivers/drives.h"
#include "drivers/robomaster_c620/loose.h"
#include "drivers/robomaster_c620/motor.h"
#include "drover/driver.h"

namespace drover::robomaster {

inline constexpr Channel kChannels[kMotors] = {{"1", ChannelMode::velocity},
                                               {"2", ChannelMode::velocity},
                                               {"3", ChannelMode::velocity},
                                               {"4", ChannelMode::velocity}};

class RobomasterDriver final : public Device, public FrameFace, public Actuator {
 public:
  RobomasterDriver(const Settings& settings, const std::array<AxisId, kMotors>& axes);
  // The motors look at its settings.
  RobomasterDriver(const RobomasterDriver&) = delete;
  RobomasterDriver& operator=(const RobomasterDriver&) = delete;

  void on_link_up(Time now) override;
  void on_tick(Time now, DriverOut& out) override;
  SourceHealth health(Time now) const override;
  Reason words(const Measurement& reported) const override;
  void on_frame(const CanFrame& frame, Time received, DriverOut& out) override;
  std::span<const FrameFilter> listens() const override { return hears_; }
  std::span<const Channel> channels() const override { return kChannels; }
  void on_setpoints(std::span<const Setpoint> wanted, Time now, DriverOut& out) override;
  std::span<const FrameRule> rules() const override { return {&rule_, 1}; }
  Effect effect(const Message& message, Time now) const override;
  std::size_t messages_per_cycle() const override { return 1; }
  StopRecipe stop_recipe() const override { return recipe_; }
  SilenceBehaviour silence() const override;

 private:
  enum class Phase : std::uint8_t {
    resting,  ///< braked, if it ran before
    arming,   ///< until each motor was heard anew
    running,  ///< set points are followed
    locked,   ///< braked; only a new request will run again
    idling,   ///< braked until slow, then without current
  };

  // receive.cpp
  void on_foreign(const CanFrame& frame, Time received);
  void report_motor(std::size_t channel, Time received, DriverOut& out);
  StatusInWords status(std::size_t channel, Time now) const;
  void report_status(Time now, bool always, DriverOut& out);
  Time oldest() const;
  Reason name_of(std::size_t channel) const;
  /// Of the motor that is silent for so long; nothing: none is.
  Reason silence_of_any(Duration limit, Time now) const;

  // driver.cpp
  bool attempts_to_run() const { return phase_ == Phase::arming || phase_ == Phase::running; }
  void lock(const Reason& why);
  bool is_any_loose() const;
  void start_arming(Time now);
  void take(AxisRequest request, Time now);
  void look_at_motors(Time now);
  void watch_loads(Duration dt);
  Reason fault_of(std::size_t channel) const;
  bool none_has_current() const;
  bool all_slow() const;
  void let_go_after(Duration limit, Time now);
  void control(std::span<const Setpoint> wanted, Time now, DriverOut& out);
  void command(std::size_t channel, const Setpoint& wanted, Duration dt, Time now);

  Settings settings_;
  std::array<AxisId, kMotors> axes_;
  std::array<Motor, kMotors> motors_;
  LooseWatch loose_;
  std::array<FrameFilter, kMotors + 1> hears_;
  FrameRule rule_;
  StopRecipe recipe_;

  Heard heard_;
  ForeignCommand foreign_;
  std::uint64_t bad_setpoints_ = 0;

  Phase phase_ = Phase::resting;
  AxisRequest request_ = AxisRequest::rest;
  bool commanded_ = false;  ///< since the last tick
  bool engaged_ = false;    ///< it ran, and brakes; else its motors get no current
  bool doubtful_ = false;   ///< something was not heard for a while: engaged only until it stands
  Time phase_since_ = kNever;
  Time last_control_ = kNever;
  Reason lock_reason_;
  std::size_t faulty_ = kMotors;  ///< the motor that has it; kMotors: none, or it is not one's

  struct Told {
    ToldStatus status;
    double degC = kAbsent;
  };
  std::array<Told, kMotors> told_;
};

}  // namespace drover::robomaster
