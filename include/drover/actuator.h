// What a device that moves something has beside its wire: commands in, and how it is kept in check.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "drover/can_frame.h"
#include "drover/driver_out.h"
#include "drover/fixed_vector.h"
#include "drover/measurement.h"
#include "drover/time.h"
#include "drover/twist.h"

namespace drover {

inline constexpr std::size_t kMaxChannels = 16;

/// What a channel is told: how fast its joint shall turn, or how the whole base shall move.
enum class ChannelMode : std::uint8_t { velocity, twist };

/// One thing that a device moves.
struct Channel {
  std::string_view name;  ///< within the device: "left", "1", "base"
  ChannelMode mode = ChannelMode::velocity;
  /// False: it arms and stops only together with the device's other channels.
  bool alone = true;
};

/// What the gateway wants of a joint, or of a base.
enum class AxisRequest : std::uint8_t {
  rest,  ///< at rest and fed: zero set point; an idle drive is left idle, a running one holds
  run,   ///< arm if needed (zero first), then follow `velocity_radps`
  /// Closed loop again without any motion of its own: armed like `run`, but at the speed that it
  /// has now. `velocity_radps` is no more than that, and only falls. A drive that would have to
  /// turn to find itself stays as it is.
  hold,
  idle,  ///< zero, then power stage off; only for a person's explicit wish: it may coast
};

/// What a joint is to do.
struct AxisCommand {
  AxisRequest request = AxisRequest::rest;
  double velocity_radps = 0;  ///< at the joint
};

/// What a channel is to do: `velocity_radps` or `twist`, as its mode says.
struct Setpoint {
  AxisRequest request = AxisRequest::rest;
  double velocity_radps = 0;  ///< at the joint
  Twist twist;                ///< of the base
};

/// What a frame does to the machine, for the gate.
enum class FrameEffect : std::uint8_t {
  harmless,   ///< reads, configuration the driver may set, arming with a zero set point
  stop,       ///< brings or keeps the axis at rest
  motion,     ///< may move the axis
  forbidden,  ///< must never leave, whatever asks: another state, a new node id, a save to flash
};

/// One frame that may leave: anything that matches no rule is refused by the gate.
struct FrameRule {
  std::uint32_t id = 0;
  bool extended = false;
  bool remote = false;
  std::uint8_t min_len = 0;
  std::uint8_t max_len = 8;
};

/// How a device is brought to rest and kept there, by somebody who knows nothing of it:
/// send all frames each `period`, for ever.
struct StopRecipe {
  FixedVector<CanFrame, 4> frames;
  Duration period = std::chrono::milliseconds(10);  ///< the guard's shortest is 10 ms
  bool holds = false;  ///< true: holds on a slope; false: coasts when the recipe is followed
};

/// What the device does by itself when frames cease.
struct SilenceBehaviour {
  bool stops = false;     ///< a time-out of its own is set by this driver
  Duration after{};       ///< that time-out
  std::string_view text;  ///< for operators: "disarms after 0.1 s (watchdog)"
};

/// One or more channels behind one address.
class Actuator {
 public:
  /// Constant from construction on: those of its DriverEntry.
  virtual std::span<const Channel> channels() const = 0;
  /// The gate's decision for this cycle, one for each channel in their order; before
  /// Device::on_tick.
  virtual void on_setpoints(std::span<const Setpoint> wanted, Time now, DriverOut& out) = 0;
  /// All that it may send.
  virtual std::span<const FrameRule> rules() const = 0;
  /// Only for frames that follow a rule.
  virtual FrameEffect effect(const CanFrame& frame) const = 0;
  /// The velocity that this frame asks of the joint, rad/s; absent when it asks for none. For the
  /// gate, which lets a ramp down to zero pass where it lets no other motion pass.
  virtual double setpoint_radps(const CanFrame&) const { return kAbsent; }
  virtual StopRecipe stop_recipe() const = 0;
  virtual SilenceBehaviour silence() const = 0;

 protected:
  ~Actuator() = default;
};

}  // namespace drover
