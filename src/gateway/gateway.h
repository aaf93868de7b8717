// Drivers, engine and gates put together: inputs with a time in, frames, events and a snapshot out.
// Reads no clock and touches no descriptor, so that live, replay, simulation and tests run the
// same. After construction it allocates nothing.
#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "config/config.h"
#include "drover/driver.h"
#include "engine/engine.h"
#include "engine/gate/frame_gate.h"
#include "gateway/bus_state.h"
#include "gateway/foreign_watch.h"
#include "gateway/input.h"
#include "gateway/listeners.h"
#include "gateway/slots.h"

namespace drover::gateway {

/// What the devices on a byte stream want of it.
struct StreamOutput {
  LinkId link = kNowhere;
  FixedVector<std::uint8_t, 512> bytes;  ///< to be written
  std::uint32_t reopen_baud = 0;         ///< not 0: then open the line anew at this speed
  /// Somebody on it moves something: nothing leaves while the guard has it.
  bool moves = false;

  /// Adds what a driver that moves nothing said in one call. Returns how many bytes found no room.
  std::size_t add(const DriverOut& out);
  /// Adds it whole, or nothing. Returns how many bytes found no room.
  std::size_t add(const Packet& packet);
};

/// How a device is stopped by the guard.
struct GuardDuty {
  StopRecipe recipe;
  bool held_by_daemon = false;  ///< the gateway can hold it, and the recipe cannot
  bool runs_on = false;         ///< a drive of the base that no silence stops
};

/// What the drives on a link need of those who serve it.
struct LinkDuty {
  std::vector<GuardDuty> stops;        ///< for the guard
  std::size_t messages_per_cycle = 0;  ///< the most that they send
};

struct CycleOutput {
  std::array<FixedVector<CanFrame, 128>, kMaxBuses> frames;  ///< to be sent, by bus
  std::vector<StreamOutput> streams;  ///< one for each byte stream, in the order of the links
  engine::EngineOutput engine;
};

class Gateway final {
 public:
  /// Throws std::runtime_error naming the key that cannot be.
  explicit Gateway(const config::DroverConfig& config);
  Gateway(const Gateway&) = delete;  // its slots know where their health is told
  Gateway& operator=(const Gateway&) = delete;

  /// The only way in. A number of a link or slot that there is not changes nothing.
  void apply(const Input& input);
  /// Of the last Tick; good until the next input.
  const CycleOutput& output() const { return cycle_; }
  const Snapshot& snapshot() const { return engine_.snapshot(); }
  const Viewpoint& viewpoint() const { return engine_.viewpoint(); }
  /// The numbers that inputs and outputs name.
  const Wiring& wiring() const { return wiring_; }

  std::size_t bus_count() const { return buses_.size(); }
  /// What the gate refused so far of what was to leave on `link`: frames, packets, bytes that
  /// belong to none.
  std::uint64_t refused(std::size_t link) const;
  /// Frames of `bus` that passed the gate and found no room in their cycle, so far.
  std::uint64_t no_room(std::size_t bus) const { return no_room_[bus]; }
  /// Bytes for a byte stream that found no room in their cycle, so far.
  std::uint64_t bytes_dropped(LinkId link) const;

  /// What is wrong with it, as its error frames or the system tell; empty when all is well.
  Reason bus_trouble(std::size_t bus, Time now) const { return buses_[bus].trouble(now); }

  /// What a person should know of the configured drives: those that go on when frames cease.
  std::vector<std::string> cautions() const;
  /// What each link's drives need of those who serve it, by LinkId.
  std::vector<LinkDuty> duties() const;

 private:
  /// Gathers until the next cycle what is to be written.
  struct Stream {
    StreamOutput waiting;
    std::uint64_t dropped = 0;
  };

  // gateway_hears.cpp: what the links bring
  void on(const FrameHeard& heard, Time received);
  void on(const BytesHeard& heard, Time first_byte);
  void on(const LevelsRead& read, Time at);
  void on(const RegistersRead& read, Time received);
  void on(const RegistersFailed& failed, Time at);
  void on(const LinkUp& up, Time now);
  void on(const LinkLost& lost, Time now);
  void on(const FramesSent& counts, Time now);
  void on(const Suspended& slept, Time now);
  void on(const HeldUp& held_up, Time now);
  void notice_foreign(const Slot& slot, const CanFrame& frame, Time received);
  bool is_bus(std::size_t link) const { return link < buses_.size(); }
  bool is_line_of_bytes(std::size_t link) const {
    return link < wiring_.links.size() && wiring_.links[link].wire == Wire::bytes;
  }
  std::span<const SlotId> slots_on(LinkId link) const;
  Slot* asked(SlotId slot, std::size_t block);

  // gateway.cpp
  void on(const CommandGiven& given, Time now);
  void on(const ProgramTrouble& trouble, Time now);
  void on(const Recalled& recalled, Time now);
  void on(const LearnedRecalled& recalled, Time now);
  void on(const OutputsUp& up, Time now);
  void on(const ClearanceFound& found, Time now);
  void on(const Tick& tick, Time now);
  void listen_to_devices(Time now);
  void look_at_buses(Time now);
  void look_at_strangers(std::size_t bus, Time now);
  void look_at_lost_lines();
  void tell_health();
  void command_actuators(Time now);
  void hand_out();
  void take(Slot& slot, Time now);
  void take_words(const Device& device, const Measurement& measurement);
  void send(Slot& slot, Time now);
  void write(Slot& slot, Time now);
  engine::Permission permission(const Slot& slot);
  bool may_slow(AxisId axis) const;
  Setpoint setpoint(AxisId axis) const;

  engine::Engine engine_;
  engine::Environment environment_;
  Wiring wiring_;
  std::vector<BusState> buses_;
  std::vector<Listeners> listeners_;  ///< by bus
  std::vector<Stream> streams_;       ///< as CycleOutput::streams
  engine::FrameGate frame_gate_;
  DriverOut scratch_;
  CycleOutput cycle_;
  std::array<FixedVector<CanFrame, 128>, kMaxBuses>
      pending_;  ///< passed the gate, not yet handed out
  std::array<std::uint64_t, kMaxBuses> no_room_{};
  /// By link: frames of what moves nothing, free bytes of what moves something.
  std::array<std::uint64_t, kMaxLinks> without_rules_{};
  FixedVector<engine::Slowing, kMaxChannels> slowing_;  ///< of the one that sends
  ForeignWatch foreign_;
  Time woke_ = kNever;
  Reason slept_;  ///< told for a moment after waking
  bool guard_required_;
  bool motion_permitted_ = false;
};

}  // namespace drover::gateway
