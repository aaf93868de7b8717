// The driver seam: pure codecs and state machines between bytes and measurements.
//
// A driver does no I/O, reads no clock, starts no thread, and after construction allocates nothing
// and throws nothing. Everything it has to say goes into a DriverOut that the caller owns and
// empties.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "drover/can_frame.h"
#include "drover/fixed_vector.h"
#include "drover/measurement.h"

namespace drover {

/// What a driver says in answer to one call.
struct DriverOut {
  FixedVector<Measurement, 64> measurements;
  FixedVector<CanFrame, 32> frames;      ///< CAN drivers: to be sent, in this order
  FixedVector<std::uint8_t, 512> bytes;  ///< byte drivers: to be written, in this order
  /// Byte drivers: not 0: close the line and open it again at this speed, once `bytes` have left.
  std::uint32_t reopen_baud = 0;
  std::uint32_t overflows = 0;  ///< things that did not fit and were dropped

  void report(const Measurement& m) { overflows += measurements.push_back(m) ? 0 : 1; }
  void send(const CanFrame& f) { overflows += frames.push_back(f) ? 0 : 1; }
  void clear() {
    measurements.clear();
    frames.clear();
    bytes.clear();
    reopen_baud = 0;
    overflows = 0;
  }
};

enum class SourceState : std::uint8_t { never_heard, fresh, stale };

/// Whether a device talks, and how well.
struct SourceHealth {
  SourceState state = SourceState::never_heard;
  Time last_good = kNever;
  std::uint64_t good = 0;       ///< frames or sentences understood
  std::uint64_t bad = 0;        ///< malformed, wrong checksum, wrong length, absurd values
  Reason reason;                ///< why it is not fresh, or what is odd; empty when all is well
  std::uint64_t overflows = 0;  ///< counted by who empties its DriverOut
};

/// What the gateway wants of an axis.
enum class AxisRequest : std::uint8_t {
  rest,  ///< at rest and fed: zero set point; an idle drive is left idle, a running one holds
  run,   ///< arm if needed (zero first), then follow `velocity_radps`
  /// Closed loop again without any motion of its own: armed like `run`, but at the speed that it
  /// has now. `velocity_radps` is no more than that, and only falls. A drive that would have to
  /// turn to find itself stays as it is.
  hold,
  idle,  ///< zero, then power stage off; only for a person's explicit wish: it may coast
};

struct AxisCommand {
  AxisRequest request = AxisRequest::rest;
  double velocity_radps = 0;  ///< at the joint
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
  Duration period = std::chrono::milliseconds(10);
  bool holds = false;  ///< true: holds on a slope; false: coasts when the recipe is followed
};

/// What the device does by itself when frames cease.
struct SilenceBehaviour {
  bool stops = false;     ///< a time-out of its own is set by this driver
  Duration after{};       ///< that time-out
  std::string_view text;  ///< for operators: "disarms after 0.1 s (watchdog)"
};

/// One drive on a CAN bus: one axis.
class CanDriver {
 public:
  virtual ~CanDriver() = default;
  /// Any frame of the bus; foreign ids are ignored without counting as bad.
  virtual void on_frame(const CanFrame& frame, Time received, DriverOut& out) = 0;
  /// Once a control cycle, after on_command.
  virtual void on_tick(Time now, DriverOut& out) = 0;
  /// The gate's decision for this cycle.
  virtual void on_command(const AxisCommand& command, Time now, DriverOut& out) = 0;
  /// The link came (back): the device may have been power-cycled meanwhile.
  virtual void on_link_up(Time now) = 0;
  virtual SourceHealth health(Time now) const = 0;
  virtual std::span<const FrameRule> allow_list() const = 0;
  /// Only for frames on the allow-list.
  virtual FrameEffect effect(const CanFrame& frame) const = 0;
  /// The velocity that this frame asks of the joint, rad/s; absent when it asks for none. For the
  /// gate, which lets a ramp down to zero pass where it lets no other motion pass.
  virtual double setpoint_radps(const CanFrame&) const { return kAbsent; }
  virtual StopRecipe stop_recipe() const = 0;
  virtual SilenceBehaviour silence() const = 0;
};

/// Of a serial line as every receiver and sensor here uses it: start, eight data bits, stop.
inline constexpr double kBitsPerByte = 10;

/// One device on a byte stream; it owns its framer and gives the same result for any chunking.
class ByteDriver {
 public:
  virtual ~ByteDriver() = default;
  /// `first_byte` is when the first of these bytes came in.
  virtual void on_bytes(std::span<const std::uint8_t> bytes, Time first_byte, DriverOut& out) = 0;
  virtual void on_tick(Time now, DriverOut& out) = 0;
  virtual void on_link_up(Time now) = 0;
  virtual SourceHealth health(Time now) const = 0;
};

/// One request of a device that is asked for 16-bit registers (Modbus functions 3 and 4).
struct RegisterBlock {
  std::uint8_t function = 3;
  std::uint16_t address = 0;
  std::uint16_t count = 0;
};

/// Why a request brought no registers.
enum class RegisterFailure : std::uint8_t {
  silent,      ///< nothing, or not enough, came within the time allowed
  damaged,     ///< checksum, length or echo
  wrong_unit,  ///< somebody else answered
  refused,     ///< the device answered with an exception
  link,        ///< there is no line to it
};

/// One device that is polled for registers, slowly, from a thread of its own.
class RegisterDriver {
 public:
  virtual ~RegisterDriver() = default;
  /// What to ask for, in this order, each round.
  virtual std::span<const RegisterBlock> blocks() const = 0;
  /// The answer to `blocks()[block]`; `words` has its count.
  virtual void on_registers(std::size_t block, std::span<const std::uint16_t> words, Time received,
                            DriverOut& out) = 0;
  /// `exception` is the Modbus exception code of a refusal, else 0.
  virtual void on_failure(std::size_t block, RegisterFailure failure, int exception, Time now) = 0;
  virtual void on_link_up(Time now) = 0;
  virtual SourceHealth health(Time now) const = 0;
};

/// One digital input.
class LineDriver {
 public:
  virtual ~LineDriver() = default;
  /// The level as read (true: electrically high), at least once a control cycle, and at each edge.
  virtual void on_level(bool high, Time at, DriverOut& out) = 0;
  /// The line cannot be read.
  virtual void on_lost(Time at, DriverOut& out) = 0;
  virtual void on_tick(Time now, DriverOut& out) = 0;
  virtual SourceHealth health(Time now) const = 0;
};

}  // namespace drover
