// The gpio-sim chip from its other side: the folders in which its lines are pulled and read.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace drover::sim {

/// Where the kernel shows its simulated chips.
struct GpioSimRoots {
  std::string configfs = "/sys/kernel/config/gpio-sim";
  std::string devices = "/sys/devices/platform";
};

/// The chip whose bank has the label "drover-sim".
class GpioSimChip {
 public:
  /// Throws std::runtime_error when there is none.
  explicit GpioSimChip(const GpioSimRoots& roots = {});

  /// Its folder holds "pull" and "value"; valid until the chip goes. Throws for an unknown name.
  std::filesystem::path line(std::string_view name) const;
  /// Takes the chip away from everybody who uses it, or puts it back under a new number. False:
  /// the kernel refused.
  bool set_live(bool live) const;

 private:
  GpioSimRoots roots_;
  std::filesystem::path bank_;  // in configfs
};

}  // namespace drover::sim
