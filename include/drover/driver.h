// The driver seam: pure codecs and state machines between a wire and measurements.
//
// A driver is a Device with one face for its wire (frames, bytes, registers, levels, or the bytes
// of a scanner) and, if it moves something, the Actuator face. It does no I/O, reads no clock,
// starts no thread, and after construction allocates nothing and throws nothing. Everything it has
// to say goes into a DriverOut.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <type_traits>

#include "drover/actuator.h"
#include "drover/can_frame.h"
#include "drover/driver_out.h"
#include "drover/fixed_text.h"
#include "drover/scan.h"
#include "drover/time.h"

namespace drover {

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

class Device {
 public:
  virtual ~Device() = default;
  /// The link came (back): the device may have been power-cycled meanwhile.
  virtual void on_link_up(Time now) = 0;
  /// Once a control cycle; an actuator's comes after Actuator::on_setpoints.
  virtual void on_tick(Time now, DriverOut& out) = 0;
  virtual SourceHealth health(Time now) const = 0;
  /// What it reported in the last call, in words: why an axis is as it is, what alarms a battery
  /// has. Of several statuses of an axis those of the last. Empty: nothing to say.
  virtual Reason words(const Measurement& /*reported*/) const { return {}; }
};

/// Frames that a device wants to hear: those whose id is `id` in the bits of `mask`.
struct FrameFilter {
  std::uint32_t id = 0;
  std::uint32_t mask = 0x7FF;
  bool extended = false;

  bool matches(const CanFrame& frame) const {
    return frame.extended == extended && (frame.id & mask) == (id & mask);
  }
};

/// On a CAN bus.
class FrameFace {
 public:
  /// A frame that one of `listens` matches. It may still be foreign, or an FD or remote frame under
  /// the device's id: what is not its own is ignored without counting as bad.
  virtual void on_frame(const CanFrame& frame, Time received, DriverOut& out) = 0;
  /// Constant from construction on. With the ids that the device is commanded by, so that somebody
  /// else who commands it is noticed.
  virtual std::span<const FrameFilter> listens() const = 0;

 protected:
  ~FrameFace() = default;
};

/// Of a serial line as every receiver and sensor here uses it: start, eight data bits, stop.
inline constexpr double kBitsPerByte = 10;

/// On a byte stream. The device owns its framer and gives the same result for any chunking.
class ByteFace {
 public:
  /// `first_byte` is when the first of these bytes came in.
  virtual void on_bytes(std::span<const std::uint8_t> bytes, Time first_byte, DriverOut& out) = 0;

 protected:
  ~ByteFace() = default;
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

/// Polled for registers, slowly, from a thread of its own.
class RegisterFace {
 public:
  /// What to ask for, in this order, each round. Constant from construction on.
  virtual std::span<const RegisterBlock> blocks() const = 0;
  /// The answer to `blocks()[block]`; `words` has its count.
  virtual void on_registers(std::size_t block, std::span<const std::uint16_t> words, Time received,
                            DriverOut& out) = 0;
  /// `exception` is the Modbus exception code of a refusal, else 0.
  virtual void on_failure(std::size_t block, RegisterFailure failure, int exception, Time now) = 0;

 protected:
  ~RegisterFace() = default;
};

/// One digital input.
class LevelFace {
 public:
  /// The level as read (true: electrically high), at least once a control cycle, and at each edge.
  virtual void on_level(bool high, Time at, DriverOut& out) = 0;
  /// The line cannot be read.
  virtual void on_lost(Time at, DriverOut& out) = 0;

 protected:
  ~LevelFace() = default;
};

/// A device with its faces, found once: a call through one of them is one virtual call.
struct Made {
  std::unique_ptr<Device> device;
  FrameFace* frames = nullptr;
  ByteFace* bytes = nullptr;
  RegisterFace* registers = nullptr;
  LevelFace* levels = nullptr;
  ScanFace* scans = nullptr;
  Actuator* actuator = nullptr;
};

/// A `Driver` behind the faces that it has.
template <class Driver, class... Arguments>
Made make_device(Arguments&&... arguments) {
  auto driver = std::make_unique<Driver>(std::forward<Arguments>(arguments)...);
  Made made;
  if constexpr (std::is_base_of_v<FrameFace, Driver>) made.frames = driver.get();
  if constexpr (std::is_base_of_v<ByteFace, Driver>) made.bytes = driver.get();
  if constexpr (std::is_base_of_v<RegisterFace, Driver>) made.registers = driver.get();
  if constexpr (std::is_base_of_v<LevelFace, Driver>) made.levels = driver.get();
  if constexpr (std::is_base_of_v<ScanFace, Driver>) made.scans = driver.get();
  if constexpr (std::is_base_of_v<Actuator, Driver>) made.actuator = driver.get();
  made.device = std::move(driver);
  return made;
}

}  // namespace drover
