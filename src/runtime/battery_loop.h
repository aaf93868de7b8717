// The battery's thread: one bus, one device, a round of requests each period. A request may take a
// second, so nobody waits for it: what came goes to the control thread through a ring, the link's
// state through a triple buffer. What the registers mean is the gateway's driver's to say.
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

/// What became of a request, or of the way to the battery.
struct BatteryTold {
  Time time = kNever;
  std::variant<gateway::LinkUp, gateway::RegistersRead, gateway::RegistersFailed> what;
};

/// Battery → control.
struct BatteryExchange {
  SpscRing<BatteryTold, 16> told;
  TripleBuffer<LinkSnapshot> link;
};

class BatteryLoop final {
 public:
  /// `slot` is the battery's in `wiring`; its driver says what to ask for.
  BatteryLoop(const config::DroverConfig& config, const gateway::Wiring& wiring,
              gateway::SlotId slot, BatteryExchange& exchange);
  void run(const std::atomic<bool>& stop);
  void wake() const { wake_.notify(); }
  /// Counts at least once in kLongestTurn while the thread lives.
  const std::atomic<std::uint64_t>& turns() const { return turns_; }

  /// Opening (1 s), a request (1 s), and room for a machine that is busy.
  static constexpr Duration kLongestTurn = std::chrono::seconds(5);

 private:
  void open(Time now);
  void lose(const std::string& why, Time now);
  std::string said(const std::string& text) const;  ///< under its name
  void ask(Time now);
  template <class What>
  void tell(const What& what, Time at);
  void publish();
  void sleep_until(Time due, Time now);

  BatteryExchange& exchange_;
  const gateway::SlotId slot_;
  const gateway::LinkId link_id_;
  const Name name_;
  const Duration period_;
  const link::ModbusSettings settings_;
  std::vector<RegisterBlock> blocks_;  ///< what the driver asks for, each round
  std::unique_ptr<link::ModbusLink> link_;
  link::ModbusCounters closed_;  ///< of the links before this one
  Wake wake_;
  std::size_t block_ = 0;
  bool answers_ = false;  ///< it was said once
  Time next_round_ = kNever;
  BackOff retry_{std::chrono::milliseconds(500), std::chrono::seconds(10)};
  Reason problem_ = "not opened yet";
  std::uint64_t dropped_ = 0;
  std::atomic<std::uint64_t> turns_{0};
};

}  // namespace drover::runtime
