// The wire from the gateway's output enable_relay to the drives' contactor, read from its far end.
#pragma once

#include <string>

#include "link/unique_fd.h"
#include "sim/robot/gpio_sim.h"

namespace drover::sim {

class RelayPort {
 public:
  /// A line of the chip. Throws std::runtime_error when it has none of this name.
  explicit RelayPort(const GpioSimChip& chip);
  /// FOLDER/enable_relay holds "0" or "1"; as long as it is not there the line is low. A file does
  /// not fall when the program that wrote it dies: only a chip's line does.
  explicit RelayPort(std::string folder);

  /// The chip is there again, under another number.
  void reopen(const GpioSimChip& chip);
  /// High: the contactor has pulled in. A line that cannot be read is low.
  bool closed();

 private:
  std::string file_;  ///< empty: a chip's line
  link::UniqueFd level_;
};

}  // namespace drover::sim
