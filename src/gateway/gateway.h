// Drivers, engine and gates put together: inputs with a time in, frames, events and a snapshot out.
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
#include "gateway/can_condition.h"
#include "gateway/foreign_watch.h"
#include "gateway/input.h"

namespace drover::gateway {

/// What a stream's driver wants of its line.
struct StreamOutput {
  FixedVector<std::uint8_t, 512> bytes;  ///< to be written
  std::uint32_t reopen_baud = 0;         ///< not 0: then open the line anew at this speed

  /// Adds what it said in one call. Returns how many bytes found no room.
  std::size_t add(const DriverOut& out);
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

  /// The only way in.
  void apply(const Input& input);
  /// Of the last Tick; good until the next input.
  const CycleOutput& output() const { return cycle_; }
  const Snapshot& snapshot() const { return engine_.snapshot(); }
  /// Frames of `bus` that the gate refused so far.
  std::uint64_t refused(std::size_t bus) const;
  /// Frames of `bus` that passed the gate and found no room in their cycle, so far.
  std::uint64_t no_room(std::size_t bus) const { return buses_[bus].no_room; }
  /// Bytes for a stream that found no room in their cycle, so far.
  std::uint64_t bytes_dropped(Stream stream) const {
    return bytes_dropped_[static_cast<std::size_t>(stream)];
  }

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
    Made made;
    std::uint64_t overflows = 0;
  };
  struct Bus {
    Name name;
    CanCondition condition;
    Reason lost;
    std::uint64_t sent = 0;
    std::uint64_t refused = 0;
    std::uint64_t no_room = 0;
    Time jammed_since = kNever;
  };
  void on(const FrameHeard& heard, Time received);
  void on(const BytesHeard& heard, Time first_byte);
  void on(const LevelsRead& read, Time at);
  void on(const LinesLost& lost, Time at);
  void on(const RegistersRead& read, Time received);
  void on(const RegistersFailed& failed, Time at);
  void on(const BatteryUp& up, Time at);
  void on(const BusUp& up, Time now);
  void on(const BusLost& lost, Time now);
  void on(const FramesSent& counts, Time now);
  void on(const StreamUp& up, Time now);
  void on(const CommandGiven& given, Time now);
  void on(const Suspended& slept, Time now);
  void on(const Tick& tick, Time now);
  void on(const ProgramTrouble& trouble, Time now);
  void on(const Recalled& recalled, Time now);
  void on(const OutputsUp& up, Time now);
  bool jammed(const Bus& bus, Time now) const;
  void look_at_buses(Time now);
  void notice_foreign(const Drive& drive, const CanFrame& frame, Time received);
  void absorb(const DriverOut& out, std::uint64_t& overflows);
  void absorb_lines();
  void absorb_stream(std::size_t stream);
  void emit(std::size_t axis);
  engine::Slowing slowing(std::size_t axis) const;

  engine::Engine engine_;
  std::vector<Drive> drives_;
  std::array<Made, kStreamCount> streams_;
  Made battery_;
  std::vector<Made> lines_;
  std::vector<Line> line_ids_;
  std::array<Bus, kMaxBuses> buses_;
  std::size_t bus_count_ = 0;
  Duration jammed_after_;
  engine::FrameGate frame_gate_;
  engine::Environment environment_;
  DriverOut scratch_;
  CycleOutput cycle_;
  std::array<FixedVector<CanFrame, 128>, kMaxBuses>
      pending_;                                     ///< passed the gate, not yet handed out
  std::array<StreamOutput, kStreamCount> waiting_;  ///< to be written with the next cycle
  std::array<std::uint64_t, kStreamCount> stream_overflows_{};
  std::array<std::uint64_t, kStreamCount> bytes_dropped_{};
  std::uint64_t line_overflows_ = 0;
  std::uint64_t battery_overflows_ = 0;
  ForeignWatch foreign_;
  Time woke_ = kNever;
  Reason slept_;  ///< told for a moment after waking
  bool guard_required_;
  bool motion_permitted_ = false;
  bool guard_has_bus_ = false;
};

}  // namespace drover::gateway
