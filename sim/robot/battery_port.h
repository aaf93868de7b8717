// The batteries' RS-485 adapter: a pseudo-terminal that speaks Modbus RTU byte by byte, so that it
// can do everything wrong that a line and a device can.
#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "drover/twin.h"
#include "sim/robot/pty.h"
#include "sim/robot/serial_port.h"

namespace drover::sim {

enum class LineFault : std::uint8_t {
  well,
  silent,      ///< no answer
  slow,        ///< each answer 3 s late
  other_unit,  ///< somebody else answers
  wrong_crc,
  drip,       ///< a byte each 490 ms
  echo,       ///< the adapter hears itself; the device answers behind it
  deaf_echo,  ///< the adapter hears itself, and nobody else
  exception,  ///< "illegal address"
};

class BatteryPort {
 public:
  /// Makes `link_path` a symbolic link to the pseudo-terminal. Throws std::runtime_error.
  BatteryPort(const std::string& link_path, int baud);
  ~BatteryPort();
  BatteryPort(const BatteryPort&) = delete;
  BatteryPort& operator=(const BatteryPort&) = delete;

  /// A device on the line, which outlives it.
  void add(std::uint8_t unit, const RegisterTwin& device) { units_.push_back({unit, &device}); }
  /// Once a tick: takes requests, sends what is due.
  void pump(Time now, Duration tick);
  /// The words of LineFault for the n-th device, and "unplug" and "plug" of the adapter. Returns
  /// "ok" or "error: ...".
  std::string command(std::string_view word, std::size_t device = 0);
  const std::string& path() const { return link_path_; }
  std::uint64_t requests() const { return requests_; }

 private:
  struct Answer {
    Time due = kNever;
    std::vector<std::uint8_t> bytes;
    bool drips = false;
  };
  struct Unit {
    std::uint8_t address = 1;
    const RegisterTwin* device = nullptr;
    LineFault fault = LineFault::well;
  };
  void plug();
  void take(Time now);
  void answer(std::span<const std::uint8_t> request, Time now);
  void answer(const Unit& unit, std::span<const std::uint8_t> request, Time now);
  void send(Time now, Duration tick);

  std::string link_path_;
  std::optional<Pty> pty_;
  BaudPacer pacer_;
  std::vector<Unit> units_;
  std::vector<std::uint8_t> heard_;
  Time heard_at_ = kNever;
  std::deque<Answer> answers_;
  Time next_drip_ = kNever;
  Time next_look_ = kNever;
  std::uint64_t requests_ = 0;
};

}  // namespace drover::sim
