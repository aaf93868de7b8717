// A simulated scanner: its twin, and the rays that it casts from its place on the robot.
#pragma once

#include <array>
#include <memory>
#include <string_view>

#include "drover/twin.h"
#include "sim/plant/plant.h"
#include "sim/robot/scenario.h"

namespace drover::sim {

class Scanner {
 public:
  Scanner(const ScannerSpec& spec, std::unique_ptr<ScannerTwin> twin);

  /// One tick: the beams that are due are measured in the world as it is now.
  void step(Time now, const Plant& plant);
  /// What it said at this tick, not yet paced.
  std::string_view bytes() const { return {bytes_.data(), size_}; }
  /// A state of the twin, or "normal". False: unknown.
  bool command(std::string_view state, Time now);

 private:
  ScannerSpec spec_;
  std::unique_ptr<ScannerTwin> twin_;
  std::array<char, 1024> bytes_{};
  std::size_t size_ = 0;
};

}  // namespace drover::sim
