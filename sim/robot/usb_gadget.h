// A device with a serial line on USB: the kernel's gadget on its dummy host controller.
//
// Where there is configfs with f_acm and dummy_udc.0, as in the lab. The host's side of the line is
// /dev/ttyACMn; what else it is called is udev's doing.
#pragma once

#include <string>

#include "link/unique_fd.h"

namespace drover::sim {

class UsbGadget {
 public:
  /// "1546:01a9", vendor and product in hexadecimal. Not plugged yet. Throws std::runtime_error.
  explicit UsbGadget(const std::string& ids);
  ~UsbGadget();
  UsbGadget(const UsbGadget&) = delete;
  UsbGadget& operator=(const UsbGadget&) = delete;

  /// The device's end of the line, raw and non-blocking. Throws std::runtime_error.
  link::UniqueFd plug();
  /// Somebody on the host's side keeps the old name open, as a program that does not look after its
  /// line does; so the device comes back under another one.
  void unplug();
  /// Whether the host's side takes what is written here; the gadget keeps what nobody takes.
  static bool is_taken(int fd);

 private:
  void make(const std::string& ids);
  void remove() noexcept;
  std::string host_side() const;

  std::string folder_;
  std::string serial_;
  link::UniqueFd held_;
};

}  // namespace drover::sim
