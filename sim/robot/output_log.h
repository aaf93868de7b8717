// What the gateway does with the robot's outputs, as their wires show it.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>

#include "link/unique_fd.h"
#include "sim/robot/gpio_sim.h"
#include "sim/robot/log.h"

namespace drover::sim {

/// Names of the chip's lines that the gateway drives.
inline constexpr std::array<std::string_view, 4> kOutputText{"enable_relay", "lamp", "buzzer",
                                                             "watchdog"};

/// "(12.345678901) lamp 1": a line's electrical level when it is first seen and whenever it has
/// changed; "-" while the chip is away.
class OutputLog {
 public:
  /// Throws std::runtime_error when the file or a line cannot be opened.
  OutputLog(const std::string& path, const GpioSimChip& chip);

  /// The chip is there again, under another number.
  void reopen(const GpioSimChip& chip);
  /// Reads every line: no two changes of one line between two calls are seen.
  void sample(Time now);
  void flush() { log_.flush(); }

 private:
  TextLog log_;
  std::array<link::UniqueFd, kOutputText.size()> values_;
  std::array<char, kOutputText.size()> levels_{};
};

}  // namespace drover::sim
