// What a device that moves something has beside its wire: commands in, and how it is kept in check.
#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <string_view>

#include "drover/can_frame.h"
#include "drover/driver_out.h"
#include "drover/fixed_vector.h"
#include "drover/measurement.h"
#include "drover/message.h"
#include "drover/time.h"
#include "drover/twist.h"

namespace drover {

inline constexpr std::size_t kMaxChannels = 16;

/// What a channel is told: how fast its joint shall turn, how the whole base shall move, or all
/// that a JointCommand has: place, speed and effort, and how stiffly they are kept.
enum class ChannelMode : std::uint8_t { velocity, twist, impedance };

/// One thing that a device moves. What one device moves is armed, fed and stopped together: it
/// belongs to one group.
struct Channel {
  std::string_view name;  ///< within the device: "left", "1", "base"
  ChannelMode mode = ChannelMode::velocity;
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

/// The law that a drive with impedance keeps, at the joint: its torque is
/// stiffness * (position - measured) + damping * (velocity - measured) + effort.
struct Impedance {
  double position_rad = 0;
  double effort_Nm = 0;
  double stiffness_Nmprad = 0;  ///< not negative; 0: the position has no weight
  double damping_Nmsprad = 0;   ///< not negative
};

/// What a drive with impedance can be told at all, at the joint; beyond, the value is cut off.
struct ImpedanceRange {
  double min_rad = -std::numeric_limits<double>::infinity();
  double max_rad = std::numeric_limits<double>::infinity();
  double velocity_radps = std::numeric_limits<double>::infinity();
  double effort_Nm = std::numeric_limits<double>::infinity();
  double stiffness_Nmprad = std::numeric_limits<double>::infinity();
  double damping_Nmsprad = std::numeric_limits<double>::infinity();
};

/// What a joint is to do. Of a channel with impedance `velocity_radps` is a part of its law.
struct AxisCommand {
  AxisRequest request = AxisRequest::rest;
  double velocity_radps = 0;  ///< at the joint
  Impedance impedance{};
  /// It held the robot when it was heard last, also by the program before this one, and nothing has
  /// ended that since. One that is not heard may obey all the same: it is fed with what keeps it
  /// so, and never with what arms it.
  bool held = false;
};

/// What a channel is to do, as its mode says. One with impedance, at AxisRequest::rest: a drive
/// that runs damps, with what its driver was told for that.
struct Setpoint {
  AxisRequest request = AxisRequest::rest;
  double velocity_radps = 0;  ///< at the joint
  Twist twist{};              ///< of the base
  Impedance impedance{};
  bool held = false;  ///< as in AxisCommand
};

/// What a message does to the machine, for the gate.
enum class FrameEffect : std::uint8_t {
  harmless,   ///< reads, configuration the driver may set, arming with a zero set point
  stop,       ///< brings or keeps its channels at rest
  motion,     ///< may move some
  forbidden,  ///< must never leave, whatever asks: another state, a new node id, a save to flash
};

/// A bit for each channel.
using ChannelMask = std::uint16_t;
inline constexpr ChannelMask kAllChannels = 0xFFFF;
constexpr ChannelMask channel_bit(std::size_t channel) {
  return static_cast<ChannelMask>(1U << channel);
}

struct Effect {
  FrameEffect kind = FrameEffect::forbidden;
  ChannelMask moves = 0;  ///< of motion: the channels that it may move; each must be permitted
};

/// One frame that may leave: anything that matches no rule is refused by the gate.
struct FrameRule {
  std::uint32_t id = 0;
  bool extended = false;
  bool remote = false;
  std::uint8_t min_len = 0;
  std::uint8_t max_len = 8;
  /// Other devices of the bus send it too (NMT, SYNC): what is in it tells whom it means. Then it
  /// must be shared by all of them.
  bool shared = false;
};

/// How a stop ends that is played for ever.
enum class StopEnds : std::uint8_t {
  coasts,  ///< the power stage is off, or will be
  damps,   ///< braked, and it creeps on a slope
  holds,   ///< at rest, on a slope too
};

/// Sent at once. On a CAN bus frames, on a byte stream packets.
struct StopRound {
  FixedVector<CanFrame, 4> frames;
  FixedVector<Packet, 4> packets;
};

/// How a device is brought to rest and kept there, by somebody who knows nothing of it: a round
/// each period, and after the last the first again, for ever. A counter or a checksum needs
/// several.
struct StopRecipe {
  FixedVector<StopRound, 16> rounds;
  Duration period = std::chrono::milliseconds(10);  ///< the guard's shortest is 10 ms
  StopEnds ends = StopEnds::coasts;
};

/// What the device does by itself when messages cease.
struct SilenceBehaviour {
  bool stops = false;                ///< a time-out of its own is set by this driver
  Duration after{};                  ///< that time-out
  std::string_view text;             ///< for operators: "disarms after 0.1 s (watchdog)"
  StopEnds ends = StopEnds::coasts;  ///< how that stop ends
  bool assumed = false;              ///< the maker does not say how: the worse was taken
};

/// One or more channels behind one address.
class Actuator {
 public:
  /// Constant from construction on: those of its DriverEntry.
  virtual std::span<const Channel> channels() const = 0;
  /// The gate's decision for this cycle, one for each channel in their order; before
  /// Device::on_tick.
  virtual void on_setpoints(std::span<const Setpoint> wanted, Time now, DriverOut& out) = 0;
  /// On a CAN bus: all that it may send.
  virtual std::span<const FrameRule> rules() const = 0;
  /// Of frames that follow a rule, and of packets: of those nothing else is looked at, so that a
  /// packet which is not whole, or that is none of its own, is forbidden. May go by what the device
  /// said last.
  virtual Effect effect(const Message& message, Time now) const = 0;
  /// The velocity that this message asks of a channel's joint, rad/s; absent when it asks for none.
  /// For the gate, which lets a ramp down to zero pass where it lets no other motion pass.
  virtual double setpoint_radps(const Message&, std::size_t /*channel*/) const { return kAbsent; }
  /// The same of a channel that takes a twist, as it stands on the wire. A driver rounds towards
  /// rest: what asks for more than was measured is no ramp.
  virtual Twist setpoint_twist(const Message&, std::size_t /*channel*/) const {
    return {kAbsent, kAbsent};
  }
  /// Of a channel with impedance: what `--check` holds a joint's limits against.
  virtual ImpedanceRange impedance_range(std::size_t /*channel*/) const { return {}; }
  /// The most that it sends in one cycle, reads with it: what is more would grow old in a queue.
  virtual std::size_t messages_per_cycle() const { return 2; }
  virtual StopRecipe stop_recipe() const = 0;
  virtual SilenceBehaviour silence() const = 0;

 protected:
  ~Actuator() = default;
};

}  // namespace drover
