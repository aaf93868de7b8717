// Whether this computer's networks are others than those for which the domain was made. Pure.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace drover::ros2 {

class NetworksWatch final {
 public:
  using Networks = std::vector<std::string>;

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
