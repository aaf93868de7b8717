// The battery's thread: one bus, one device, a round of requests each period. A request may take a
// second, so nobody waits for it: samples and health go to the control thread through a ring and a
// triple buffer.
#pragma once

#include <atomic>
#include <memory>

#include "config/config.h"
#include "drover/driver.h"
#include "drover/snapshot.h"
#include "drover/spsc_ring.h"
#include "drover/triple_buffer.h"
#include "link/modbus_link.h"
#include "runtime/wake.h"

namespace drover::runtime {

struct BatteryState {
  SourceHealth health;
  LinkSnapshot link;
};

/// Battery → control.
struct BatteryExchange {
  SpscRing<Measurement, 16> samples;
  TripleBuffer<BatteryState> state;
};

class BatteryLoop final {
 public:
  /// Throws std::runtime_error when the driver cannot be made. Only with a battery configured.
  BatteryLoop(const config::BatteryConfig& config, BatteryExchange& exchange);
  void run(const std::atomic<bool>& stop);
  void wake() const { wake_.notify(); }
  /// Counts at least once in kLongestTurn while the thread lives.
  const std::atomic<std::uint64_t>& turns() const { return turns_; }

  /// Opening (1 s), a request (1 s), and room for a machine that is busy.
  static constexpr Duration kLongestTurn = std::chrono::seconds(5);

 private:
  void open(Time now);
  void lose(const std::string& why, Time now);
  void ask(Time now);
  void publish(Time now);
  void sleep_until(Time due, Time now);

  config::BatteryConfig config_;
  BatteryExchange& exchange_;
  std::unique_ptr<RegisterDriver> driver_;
  std::unique_ptr<link::ModbusLink> link_;
  link::ModbusCounters closed_;  ///< of the links before this one
  Wake wake_;
  std::size_t block_ = 0;
  Time next_round_ = kNever;
  Time next_open_ = kNever;
  Duration pause_{};
  Reason problem_ = "not opened yet";
  std::uint64_t dropped_ = 0;
  DriverOut out_;
  std::atomic<std::uint64_t> turns_{0};
};

}  // namespace drover::runtime
