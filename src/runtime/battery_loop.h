// A Modbus line's thread: asks its devices in turn, each for a round of registers in its own
// period. A request may take a second, so nobody waits for it: what came goes to the control thread
// through a ring, the link's state through a triple buffer. What the registers mean is the
// gateway's drivers' to say.
#pragma once

#include <atomic>
#include <memory>
#include <variant>
#include <vector>

#include "config/config.h"
#include "drover/driver.h"
#include "drover/snapshot.h"
#include "drover/spsc_ring.h"
#include "drover/triple_buffer.h"
#include "gateway/slots.h"
#include "link/modbus_link.h"
#include "runtime/back_off.h"
#include "runtime/wake.h"

namespace drover::runtime {

/// What became of a request, or of the way to the devices.
struct BatteryTold {
  Time time = kNever;
  std::variant<gateway::LinkUp, gateway::RegistersRead, gateway::RegistersFailed> what;
};

/// A Modbus line → control.
struct BatteryExchange {
  SpscRing<BatteryTold, 64> told;
  TripleBuffer<LinkSnapshot> link;
};

class BatteryLoop final {
 public:
  /// `link` is the line's in `wiring`; the drivers of its devices say what to ask for.
  BatteryLoop(const config::DroverConfig& config, const gateway::Wiring& wiring,
              gateway::LinkId link, BatteryExchange& exchange);
  void run(const std::atomic<bool>& stop);
  void wake() const { wake_.notify(); }
  /// Counts at least once in kLongestTurn while the thread lives.
  const std::atomic<std::uint64_t>& turns() const { return turns_; }

  /// Opening (1 s), a request (1 s), and room for a machine that is busy.
  static constexpr Duration kLongestTurn = std::chrono::seconds(5);

 private:
  /// A device on the line.
  struct Unit {
    gateway::SlotId slot = 0;
    Name name;
    Duration period{};
    link::ModbusUnit modbus;
    std::vector<RegisterBlock> blocks;  ///< what its driver asks for, each round
    std::size_t block = 0;              ///< the next
    Time next_round = kNever;
    bool answers = false;  ///< it was said once
  };

  Unit& next_unit();
  Time due(const Unit& unit) const;
  void open(Time now);
  void lose(const std::string& why, Time now);
  void tell_lost(Time now);
  std::string said(const Name& name, const std::string& text) const;
  void ask(Unit& unit, Time now);
  void tell(const BatteryTold& told);
  void publish();
  void sleep_until(Time due, Time now);

  BatteryExchange& exchange_;
  const gateway::LinkId link_id_;
  const Name name_;
  const link::ModbusSettings settings_;
  std::vector<Unit> units_;
  std::unique_ptr<link::ModbusLink> link_;
  link::ModbusCounters closed_;  ///< of the links before this one
  Wake wake_;
  BackOff retry_{std::chrono::milliseconds(500), std::chrono::seconds(10)};
  Reason problem_ = "not opened yet";
  std::uint64_t dropped_ = 0;
  std::atomic<std::uint64_t> turns_{0};
};

/// The Modbus lines of the wiring, each with its thread.
struct SlowLink {
  BatteryExchange exchange;
  std::unique_ptr<BatteryLoop> loop;
};
std::vector<std::unique_ptr<SlowLink>> slow_links(const config::DroverConfig& config,
                                                  const gateway::Wiring& wiring);

}  // namespace drover::runtime
