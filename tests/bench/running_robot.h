// The daemon's own control thread over sockets that a benchmark holds, and what it costs.
#pragma once

#include <pthread.h>
#include <unistd.h>

#include <atomic>
#include <memory>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "config/load.h"
#include "runtime/clock.h"
#include "runtime/control_loop.h"
#include "tests/support/allocation_counter.h"
#include "tests/support/temp_folder.h"
#include "tests/support/wires.h"

namespace drover::bench {

using Buses = std::vector<std::unique_ptr<test::Bus>>;

inline Buses make_buses(const std::string& folder, std::size_t count) {
  Buses buses;
  for (std::size_t i = 0; i < count; ++i)
    buses.push_back(std::make_unique<test::Bus>(folder + "/can" + std::to_string(i)));
  return buses;
}

inline bool all_connected(const Buses& buses) {
  bool all = true;
  for (const auto& bus : buses) all = bus->connected() && all;
  return all;
}

/// What the control thread took for its ticks in a while.
struct Spent {
  double tick_ns = 0;  ///< of CPU time, on average
  std::uint64_t ticks = 0;
  std::uint64_t overruns = 0;
};

class RunningRobot final {
 public:
  /// Throws std::runtime_error with the first problem of the configuration. `folder` outlives it.
  RunningRobot(const std::string& configuration, const std::string& folder)
      : loaded_(config::load_text(configuration)),
        gateway_((refuse_problems(loaded_), loaded_.config)),
        keeper_(loaded_.config, gateway_.wiring(), guard_, gateway_.duties()),
        serial_(gateway_.wiring()),
        memory_(folder, "a boot", loaded_.text, report_),
        control_(loaded_.config, gateway_, keeper_, serial_, guard_, *exchange_,
                 {memory_, *storage_}),
        keeps_([this] { keeper_.run(stop_); }),
        hears_([this] { serial_.run(stop_); }),
        controls_([this] {
          number_ = ::gettid();
          const test::AllocationCounter counter;
          control_.run(stop_);
          allocations_ = counter.count();
        }) {}
  ~RunningRobot() { end(); }
  RunningRobot(const RunningRobot&) = delete;
  RunningRobot& operator=(const RunningRobot&) = delete;

  /// Each tick `say`, once all buses are opened.
  template <class Say>
  void live(double seconds, const Buses& buses, const Say& say) {
    const Duration tick = from_s(1 / loaded_.config.control.tick_Hz);
    if (next_ == std::chrono::steady_clock::time_point{}) next_ = std::chrono::steady_clock::now();
    for (double t = 0; t < seconds; t += to_s(tick)) {
      if (heard_ = all_connected(buses); heard_) say();
      std::this_thread::sleep_until(next_ += tick);
    }
  }
  /// It opens its links one after the other.
  template <class Say>
  void begin(const Buses& buses, const Say& say) {
    for (int i = 0; i < 10 && !heard_; ++i) live(1, buses, say);
    live(0.5, buses, say);
  }
  template <class Say>
  Spent measure(double seconds, const Buses& buses, const Say& say) {
    const double cpu_before_s = cpu_s();
    const auto ticks_before = exchange_->beats.load();
    const auto overruns_before = seen().cycle.overruns;
    live(seconds, buses, say);
    const double spent_s = cpu_s() - cpu_before_s;
    const std::uint64_t ticks = exchange_->beats.load() - ticks_before;
    return {1e9 * spent_s / static_cast<double>(ticks), ticks,
            seen().cycle.overruns - overruns_before};
  }
  const Snapshot& seen() { return exchange_->snapshot.latest(); }
  runtime::ControlExchange& exchange() { return *exchange_; }
  int thread() const { return number_.load(); }
  /// Ends it. Returns how often its control thread allocated in all its life.
  std::uint64_t end() {
    if (!controls_.joinable()) return allocations_;
    stop_ = true;
    keeper_.wake();
    controls_.join();
    hears_.join();
    keeps_.join();
    return allocations_;
  }

 private:
  static void refuse_problems(const config::Loaded& loaded) {
    for (const auto& problem : loaded.problems) throw std::runtime_error(problem.text("robot"));
  }
  double cpu_s() {
    clockid_t clock{};
    timespec time{};
    if (::pthread_getcpuclockid(controls_.native_handle(), &clock) != 0 ||
        ::clock_gettime(clock, &time) != 0)
      return 0;
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
  }

  config::Loaded loaded_;
  gateway::Gateway gateway_;
  const runtime::GuardMemory guard_;
  runtime::LinkKeeper keeper_;
  runtime::SerialLoop serial_;
  std::unique_ptr<runtime::ControlExchange> exchange_ =
      std::make_unique<runtime::ControlExchange>();
  std::unique_ptr<runtime::StorageExchange> storage_ = std::make_unique<runtime::StorageExchange>();
  std::vector<std::string> report_;
  runtime::RobotMemory memory_;
  runtime::ControlLoop control_;
  std::atomic<bool> stop_{false};
  std::atomic<int> number_{0};
  std::uint64_t allocations_ = 0;
  std::chrono::steady_clock::time_point next_{};
  bool heard_ = false;
  std::thread keeps_;
  std::thread hears_;
  std::thread controls_;
};

}  // namespace drover::bench
