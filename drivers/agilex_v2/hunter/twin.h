// A simulated Hunter: driven rear wheels, steered front wheels.
#pragma once

#include <array>

#include "drivers/agilex_v2/codec.h"
#include "drivers/agilex_v2/servo.h"
#include "drivers/agilex_v2/steering.h"
#include "drivers/checked_options.h"
#include "drover/options.h"
#include "drover/twin.h"

namespace drover::agilex_v2 {

std::span<const OptionSpec> hunter_twin_option_table();

/// Rear left, rear right, and what steers front left and front right.
inline constexpr std::size_t kHunterShafts = 4;

class HunterTwin final : public CanTwin {
 public:
  HunterTwin(const Options& options, const Steering& steering);

  void set_power(bool on, Time now) override;
  /// "silent", "estop", "exception", "remote" (a person takes it over), "low_battery",
  /// "steering_stuck", "brake_stuck" (locked, whatever it is told).
  bool set_fault(std::string_view name, Time now) override;
  void on_frame(const CanFrame& frame, Time now, TwinFrames& out) override;
  void on_tick(Time now, std::span<Shaft> shafts, TwinFrames& out) override;

 private:
  HunterTwin(const CheckedOptions& own, const Steering& steering);
  bool awake(Time now) const { return powered_ && now >= booted_; }
  bool locked() const { return state_.brake_locked || brake_stuck_; }
  void watch_silence(Time now);
  void drive(std::span<Shaft> shafts, double speed_mps, double dt_s);
  void steer(std::span<Shaft> shafts, double dt_s);
  double steered_radpm(std::span<const Shaft> shafts) const;
  void tell(std::span<const Shaft> shafts, Time now, TwinFrames& out);

  Steering steering_;
  double wheel_radius_m_;
  double max_torque_Nm_;
  double rate_radps_;

  bool powered_ = true;
  bool silent_ = false;
  bool steering_stuck_ = false;
  bool brake_stuck_ = false;
  bool fell_silent_ = false;  ///< it left CAN mode because nobody spoke, and comes back by itself
  Time booted_ = kNever;
  Time last_tick_ = kNever;
  SystemState state_;
  Steered asked_;
  Time last_asked_ = kNever;
  double inner_rad_ = 0;  ///< to which its inner wheel is steered now, left positive
  /// Two motors move what four do in its sibling: a stop must not swing back.
  static constexpr Servo kServo{.integral_Nm_per_rad = 100, .proportional_Nms_per_rad = 20};
  std::array<Servo, 2> servos_{kServo, kServo};
  Time next_state_ = kNever;
  Time next_motion_ = kNever;
  std::uint8_t count_ = 0;
};

}  // namespace drover::agilex_v2
