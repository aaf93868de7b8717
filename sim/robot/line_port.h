// The robot's contacts: inputs of a gpio-sim chip, or one-byte files where there is no GPIO.
#pragma once

#include <array>
#include <optional>
#include <string>

#include "link/unique_fd.h"
#include "sim/robot/gpio_sim.h"
#include "sim/robot/scenario.h"

namespace drover::sim {

class LinePort {
 public:
  /// The chip's lines have the names of kLineText. What is set while the chip is away is lost.
  static LinePort gpio_sim(const Scenario& scenario, const GpioSimChip& chip);
  /// FOLDER/estop and so on hold "0" or "1", rewritten in place.
  static LinePort files(const Scenario& scenario, const std::string& folder);

  /// Writes only what changed.
  void set(LineName line, bool high);

 private:
  LinePort() = default;

  std::array<link::UniqueFd, kLineNames> fds_;
  std::array<std::optional<bool>, kLineNames> written_;
  std::string high_text_;
  std::string low_text_;
};

}  // namespace drover::sim
