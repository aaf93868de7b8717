// The control thread: a tick drains CAN, reads lines, steps the gateway and sends; what the serial
// thread heard and edges wake it at once. After start it takes no lock, allocates nothing, logs
// nothing.
#pragma once

#include <poll.h>

#include <atomic>
#include <memory>
#include <span>
#include <vector>

#include "gateway/gateway.h"
#include "runtime/battery_loop.h"
#include "runtime/command_intake.h"
#include "runtime/control_exchange.h"
#include "runtime/guard_client.h"
#include "runtime/guard_watch.h"
#include "runtime/hold_ups.h"
#include "runtime/link_keeper.h"
#include "runtime/program_watch.h"
#include "runtime/recorder.h"
#include "runtime/robot_memory.h"
#include "runtime/serial_loop.h"
#include "runtime/storage_loop.h"

namespace drover::runtime {

/// Where the control thread keeps what outlives the program.
struct KeepsOver {
  RobotMemory& memory;
  StorageExchange& storage;
};

class ControlLoop final {
 public:
  ControlLoop(const config::DroverConfig& config, Gateway& gateway, LinkKeeper& keeper,
              SerialLoop& serial, const GuardMemory& guard, ControlExchange& exchange,
              KeepsOver keeps, std::span<const std::unique_ptr<SlowLink>> slow = {});
  /// Before `run`: what the program before this one left.
  void recall(const Remembered& remembered);
  void recall(const LearnedValues& learned);
  void run(const std::atomic<bool>& stop);

 private:
  /// Nothing reaches the gateway but through here.
  void apply(const gateway::Input& input) {
    if (exchange_.recorder != nullptr) exchange_.recorder->input(input);
    gateway_.apply(input);
  }
  template <class Body>
  void apply(Time time, const Body& body) {
    apply(gateway::Input{time, body});
  }
  void take_links(Time now);
  void lose(std::size_t slot, int error, Time now);
  Time wait(Duration longest);
  void hear_ready(Time now);
  void hear_streams(Time now);
  void give_back(LinkHandover& dead);
  void serve_stream(const StreamOutput& out, Time now);
  void read_lines(std::size_t link, Time now, const std::array<bool, link::kMaxLines>& edged = {});
  void apply_levels(std::size_t link, const std::array<bool, link::kMaxLines>& levels, Time now);
  void write_outputs(const std::array<bool, kOutputCount>& on, Time now);
  void drain_can(Time now);
  Time cycle(Time begin, std::uint64_t late);
  void take_commands(Time now);
  void watch_program(Time now);
  void watch_hold_ups(Time now);
  void tell_hold_up(Duration lasted, Time now);
  bool still_may_leave(Time decided) const;
  void send(std::size_t bus, std::span<const CanFrame> frames, Time decided);
  bool rolls() const;
  GuardSigns guard_signs() const;
  void watch_guard(Time now);
  void keep(const Remembered& remembered);
  void take_slow_links();
  void hear_scene(Time now);
  void show_scene();
  Time publish(Time now);
  Wire wire_of(std::size_t link) const { return gateway_.wiring().links[link].wire; }
  std::size_t line_count(std::size_t link) const {
    return gateway_.wiring().links[link].slots.size();
  }

  const config::DroverConfig& config_;
  Gateway& gateway_;
  LinkKeeper& keeper_;
  SerialLoop& serial_;
  const GuardMemory& guard_;
  ControlExchange& exchange_;
  KeepsOver keeps_;
  std::span<const std::unique_ptr<SlowLink>> slow_;  ///< with threads of their own
  const Duration tick_;
  /// A link of the gateway; which pointer is set follows its wire.
  struct Open {
    std::unique_ptr<link::CanLink> can;
    std::unique_ptr<link::SerialLink> serial;
    std::unique_ptr<link::LineLink> lines;
    int baud = 0;
    std::uint64_t bytes_untaken = 0;  ///< the line had no room for them
  };
  std::vector<Open> open_;    ///< by the gateway's numbers
  std::vector<pollfd> wait_;  ///< room for all that wakes
  std::unique_ptr<link::OutputLink> outputs_;
  std::array<bool, kOutputCount> output_levels_{};
  Time outputs_written_ = kNever;
  std::array<LinkHandover, kLinkSlots> going_back_;  ///< dead links that the keeper has yet to take
  std::array<LinkSnapshot, kLinkSlots> link_state_;
  Time previous_drain_ = kNever;
  Time clocks_measured_ = kNever;
  Duration wall_minus_monotonic_{};
  CycleStats stats_;
  GuardWatch guard_watch_;
  bool leaves_to_guard_ = false;  ///< since the cycle before: its heartbeat ends
  HoldUps hold_ups_;
  CommandIntake intake_;
  ProgramWatch program_;
  std::uint64_t clearance_ = 0;  ///< number of the last one
  double last_vx_mps_ = 0;       ///< of the base, when somebody knew it
  link::FrameBatch batch_;
  HeardBytes heard_;
};

}  // namespace drover::runtime
