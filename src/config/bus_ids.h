// The ids of each CAN bus, and who uses them.
#pragma once

#include <cstdint>
#include <vector>

#include "config/config.h"
#include "config/findings.h"

namespace drover::config {

/// By what drivers say of themselves: FrameFace::listens() and Actuator::rules(). An id that a rule
/// calls shared belongs to nobody, as long as each who uses it calls it so.
class BusIds final {
 public:
  explicit BusIds(Findings& found) : found_(found) {}

  /// Refuses it when a device of the same bus that came before uses one of its ids.
  void take(const DeviceConfig& device, const Made& made);

 private:
  struct User {
    const DeviceConfig* device = nullptr;
    std::vector<FrameFilter> ids;
    std::vector<std::uint32_t> shared;  ///< of 11 bits
  };

  void compare(const User& first, const User& second);

  Findings& found_;
  std::vector<User> users_;
};

}  // namespace drover::config
