// Decodes what was recorded of a device through the driver that droverd would use, without droverd.
#pragma once

#include <iosfwd>
#include <string>
#include <string_view>
#include <vector>

namespace drover::cli {

struct Recording {
  std::string driver{};
  std::vector<std::string> options{};  ///< of the driver, "name=value"
  std::vector<int> nodes{};            ///< CAN: a driver for each
  std::string bus{};                   ///< CAN: only this one; empty: all
  std::string map{};                   ///< battery: file of its registers
  bool json = false;
};

/// `device` is the command: gnss, imu, bms or can. Measurements go to `out`, a line each; what
/// could not be understood is counted and told in `notes`. Returns the exit code: 0, or 1 when the
/// recording held nothing that could be understood. Throws WrongUsage.
int show_recording(std::string_view device, std::istream& in, const Recording& recording,
                   std::ostream& out, std::ostream& notes);

}  // namespace drover::cli
