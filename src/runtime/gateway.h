// Drivers, engine and gates put together: bytes with a time in, frames, events and a snapshot out.
// Reads no clock and touches no descriptor, so that live, replay, simulation and tests run the
// same. After construction it allocates nothing.
#pragma once

#include <array>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "config/config.h"
#include "drover/driver.h"
#include "drover/registry.h"
#include "engine/engine.h"
#include "engine/gate/frame_gate.h"
#include "link/can_condition.h"

namespace drover::runtime {

inline constexpr std::size_t kMaxBuses = 4;

/// Devices on byte streams.
enum class Stream : std::uint8_t { gnss, imu };
inline constexpr std::size_t kStreamCount = 2;

/// What a stream's driver wants of its line.
struct StreamOutput {
  FixedVector<std::uint8_t, 512> bytes;  ///< to be written
  std::uint32_t reopen_baud = 0;         ///< not 0: then open the line anew at this speed
};

struct CycleOutput {
  std::array<FixedVector<CanFrame, 128>, kMaxBuses> frames;  ///< to be sent, by bus
  std::array<StreamOutput, kStreamCount> streams;
  engine::EngineOutput engine;
};

class Gateway final {
 public:
  /// Throws std::runtime_error naming the key that cannot be.
  explicit Gateway(const config::DroverConfig& config);

  void on_frame(std::size_t bus, const CanFrame& frame, Time received);
  void on_bytes(Stream stream, std::span<const std::uint8_t> bytes, Time first_byte);
  /// `levels[i]` belongs to the i-th configured line, in the order of Line.
  void on_levels(std::span<const bool> levels, Time at);
  void on_lines_lost(Time at);
  /// From the battery's own thread.
  void on_battery(const Measurement& sample) { engine_.on_measurement(sample); }
  void set_battery_health(const SourceHealth& health) { environment_.battery = health; }
  void on_bus_up(std::size_t bus, Time now);
  /// It is gone, or cannot be opened: why. Until on_bus_up.
  void on_bus_lost(std::size_t bus, const Reason& why);
  /// After each cycle's frames: how many the link took and refused so far. One that takes none for
  /// as long as a drive may be silent is as good as gone, though it still hears.
  void on_sent(std::size_t bus, std::uint64_t sent, std::uint64_t refused, Time now);
  void on_stream_up(Stream stream, Time now);
  void on_command(const Command& command, Time now);

  /// One control cycle; the reference stays good until the next call.
  const CycleOutput& step(Time now, bool guard_alive, bool guard_has_bus);
  const Snapshot& snapshot() const { return engine_.snapshot(); }
  /// Frames of `bus` that the gate refused so far.
  std::uint64_t refused(std::size_t bus) const;

  /// What is wrong with it, as its error frames or the system tell; empty when all is well.
  Reason bus_trouble(std::size_t bus, Time now) const;

  /// What a person should know of the configured drives: those that go on when frames cease.
  std::vector<std::string> cautions() const;

  std::size_t bus_count() const { return bus_count_; }
  /// For the guard: every stop frame of the drives on `bus`.
  std::vector<CanFrame> stop_frames(std::size_t bus) const;

 private:
  struct Drive {
    std::size_t bus = 0;
    std::unique_ptr<CanDriver> driver;
  };
  struct Bus {
    Name name;
    link::CanCondition condition;
    Reason lost;
    std::uint64_t sent = 0;
    std::uint64_t refused = 0;
    Time jammed_since = kNever;
  };
  bool jammed(const Bus& bus, Time now) const;
  void look_at_buses(Time now);
  void absorb(const DriverOut& out);
  void absorb_stream(std::size_t stream);
  void emit(const Drive& drive);

  engine::Engine engine_;
  std::vector<Drive> drives_;
  std::array<std::unique_ptr<ByteDriver>, kStreamCount> streams_;
  std::vector<std::unique_ptr<LineDriver>> lines_;
  std::vector<Line> line_ids_;
  std::array<Bus, kMaxBuses> buses_;
  std::size_t bus_count_ = 0;
  Duration jammed_after_;
  engine::FrameGate frame_gate_;
  engine::Environment environment_;
  DriverOut scratch_;
  CycleOutput cycle_;
  std::array<FixedVector<CanFrame, 128>, kMaxBuses>
      pending_;  ///< passed the gate, not yet handed out
  bool motion_permitted_ = false;
  bool guard_has_bus_ = false;
};

}  // namespace drover::runtime
