// Whether this computer's networks are others than those that were told last. Pure.
#pragma once

#include <utility>
#include <vector>

#include "ros2/networks.h"

namespace drover::ros2 {

class NetworksWatch final {
 public:
  using Networks = std::vector<Network>;

  void use(Networks networks) { seen_ = used_ = std::move(networks); }
  const Networks& used() const { return used_; }
  /// Once a beat. True: others are there, the same ones twice in a row, not just coming up.
  bool changed(const Networks& there) {
    const bool again = there == seen_;
    seen_ = there;
    return again && there != used_;
  }

 private:
  Networks used_;
  Networks seen_;  ///< at the last beat
};

}  // namespace drover::ros2
