// A joint that a motor in MIT mode turns: set points to frames, its answers to motion, and its
// stop. What is no number, or beyond a range, is counted here.
#pragma once

#include "drivers/mit/frame.h"
#include "drover/actuator.h"
#include "drover/fixed_text.h"

namespace drover::mit {

/// How often a stop's frame is sent.
inline constexpr Duration kStopPeriod = std::chrono::milliseconds(10);

/// How a motor's frames become a joint's, and the last limits of what is sent.
struct Joint {
  std::uint8_t id = 1;
  Ranges ranges;
  double sign = 1;             ///< -1: the motor turns against the joint
  double zero_rad = 0;         ///< what the motor says where the joint is 0
  double damping_Nmsprad = 1;  ///< of a stop
  double max_effort_Nm = 0;
  /// Speeds are rounded to the nearest step, not down: where a step of the range is wide.
  bool nearest_speed = false;

  /// What every stop of it is.
  CanFrame damp_frame() const;
  /// The same, played for ever: it does not hold.
  StopRecipe stop_recipe() const;
  /// What of a set point is not cut off.
  ImpedanceRange range() const;
  /// Of what has neither stiffness nor effort; all else does not ask for a velocity alone.
  double setpoint_radps(const CanFrame& frame) const;
  AxisMotion motion_of(const Motion& motion, AxisId axis) const;
};

/// Of a motor with this time-out of its own, 0: none is known; `text` must outlive it.
SilenceBehaviour silence_of(std::uint32_t timeout_ms, const Reason& text);

/// What an MIT frame or a special one does; of the latter the disabling one is a stop.
FrameEffect effect(const CanFrame& frame, std::uint8_t id);

class SetpointPacker final {
 public:
  explicit SetpointPacker(const Joint& joint) : joint_(joint), damp_(joint.damp_frame()) {}

  /// What is no number, or a spring that pushes away, is not followed in any part: it damps.
  CanFrame frame_of(const Setpoint& command);
  /// Set points that were not numbers, or beyond a range.
  std::uint64_t bad() const { return bad_; }

 private:
  double clamped(double value, double limit);

  Joint joint_;
  CanFrame damp_;
  std::uint64_t bad_ = 0;
};

/// Somebody else, the guard, plays the stop of a motor.
class OthersDamping final {
 public:
  void heard(Time now) { last_ = now; }
  /// One of its frames may be late.
  bool goes_on(Time now) const { return last_ != kNever && now - last_ <= 2 * kStopPeriod; }

 private:
  Time last_ = kNever;
};

/// A motor that is to be let go damps first, for as long as that brakes its joint.
class LettingGo final {
 public:
  void begin(Time now);
  /// It is slow, or had its time, or gets faster: what its damping does not brake, or drives on as
  /// in a motor that turns the wrong way, is let go at once. Without a speed the time alone counts.
  bool is_due(double velocity_radps, Time now);

 private:
  Time since_ = kNever;
  double slowest_radps_ = 0;
};

}  // namespace drover::mit
