// A Scout, or a Hunter: a base that is told how the whole of it shall move, once it was switched to
// CAN.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>

#include "drivers/agilex_v2/codec.h"
#include "drivers/agilex_v2/steering.h"
#include "drivers/drives.h"
#include "drover/driver.h"

namespace drover::agilex_v2 {

inline constexpr std::array kChannels{Channel{"base", ChannelMode::twist}};

class AgilexV2Driver final : public Device, public FrameFace, public Actuator {
 public:
  /// With `steering` it is a Hunter: it turns on curves only, and has a parking brake.
  /// `zero_holds`: told zero, or in silence, it holds on a slope.
  explicit AgilexV2Driver(AxisId axis, std::optional<Steering> steering = {},
                          bool zero_holds = false);

  void on_link_up(Time now) override;
  void on_tick(Time now, DriverOut& out) override;
  SourceHealth health(Time now) const override;
  Reason words(const Measurement& reported) const override { return told_.words(reported); }

  void on_frame(const CanFrame& frame, Time received, DriverOut& out) override;
  std::span<const FrameFilter> listens() const override;

  std::span<const Channel> channels() const override { return kChannels; }
  void on_setpoints(std::span<const Setpoint> wanted, Time now, DriverOut& out) override;
  std::span<const FrameRule> rules() const override;
  Effect effect(const Message& message, Time now) const override;
  Twist setpoint_twist(const Message& message, std::size_t channel) const override;
  StopRecipe stop_recipe() const override { return recipe_; }
  SilenceBehaviour silence() const override;

 private:
  bool ever_heard() const { return last_state_ != kNever || last_motion_ != kNever; }
  bool talks(Time now) const { return missing(now).empty(); }
  std::string_view missing(Time now) const;
  StatusInWords status(Time now) const;
  AxisState mode_state() const;
  std::string_view why_not_running(AxisState state, Time now) const;
  Model model() const { return steering_ ? Model::hunter : Model::scout; }
  std::optional<Twist> read_twist(const CanFrame& frame) const;
  void hear_state(const SystemState& state, Time received, DriverOut& out);
  void hear_motion(const CanFrame& frame, Time received, DriverOut& out);
  void take_request(AxisRequest request, Time now);
  bool may_move(Time now) const;
  bool at_rest(Time now) const;
  void command(const Twist& twist, Time now, DriverOut& out);
  void steer(const Twist& twist, Time now);
  void ask_for(Mode mode, Time now, DriverOut& out);
  bool mind_brake(Time now, DriverOut& out);

  AxisId axis_;
  std::optional<Steering> steering_;
  StopRecipe recipe_;
  SystemState state_;
  Twist motion_;
  Time last_state_ = kNever;
  Time last_motion_ = kNever;
  Time last_v1_ = kNever;
  bool state_known_ = false;  ///< its state was heard on this link
  bool motion_told_ = false;  ///< that motion is what was reported last
  std::uint64_t good_ = 0;
  std::uint64_t bad_ = 0;

  AxisRequest request_ = AxisRequest::rest;
  bool in_command_ = false;  ///< it was in CAN mode since this request began
  bool held_off_ = false;    ///< and is no more: it moves again by a new request only
  ForeignCommand foreign_;
  Time last_command_ = kNever;
  Time last_mode_command_ = kNever;
  Time zero_until_ = kNever;
  ToldStatus told_;

  // Of a Hunter.
  double inner_rad_ = 0;        ///< as its wheels are steered
  double asked_inner_rad_ = 0;  ///< as they are told to be
  bool was_steered_ = false;    ///< by the command before
  Time still_since_ = kNever;   ///< it rests, and nobody asks it to move
  Time asked_since_ = kNever;   ///< this request
  Time last_brake_command_ = kNever;
};

}  // namespace drover::agilex_v2
