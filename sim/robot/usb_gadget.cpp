#include "sim/robot/usb_gadget.h"

#include <fcntl.h>
#include <sys/ioctl.h>
#include <termios.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <stdexcept>

namespace drover::sim {
namespace {

namespace fs = std::filesystem;

constexpr const char* kGadgets = "/sys/kernel/config/usb_gadget";
constexpr const char* kController = "dummy_udc.0";
constexpr const char* kDeviceEnd = "/dev/ttyGS0";
// Bytes in the gadget's buffer; more wait only where nobody has the line open.
constexpr int kMostWaiting = 256;

void write_attribute(const std::string& path, const std::string& text) {
  link::UniqueFd fd(::open(path.c_str(), O_WRONLY | O_CLOEXEC));
  if (!fd || ::write(fd.get(), text.data(), text.size()) < 0)
    throw std::runtime_error(path + ": cannot write " + text + ": " + std::strerror(errno));
}

}  // namespace

UsbGadget::UsbGadget(const std::string& ids)
    : folder_(std::string(kGadgets) + "/drover-sim"), serial_("drover-sim-0001") {
  if (!fs::is_directory(kGadgets))
    throw std::runtime_error(std::string(kGadgets) + " is missing: USB devices need the lab");
  try {
    make(ids);
  } catch (...) {
    remove();
    throw;
  }
}

UsbGadget::~UsbGadget() {
  remove();
}

void UsbGadget::make(const std::string& ids) {
  const auto colon = ids.find(':');
  if (colon == std::string::npos)
    throw std::runtime_error("usb:" + ids + ": say usb:VENDOR:PRODUCT");
  fs::create_directory(folder_);
  write_attribute(folder_ + "/idVendor", "0x" + ids.substr(0, colon));
  write_attribute(folder_ + "/idProduct", "0x" + ids.substr(colon + 1));
  fs::create_directory(folder_ + "/strings/0x409");
  write_attribute(folder_ + "/strings/0x409/manufacturer", "drover-sim");
  write_attribute(folder_ + "/strings/0x409/product", "serial line");
  write_attribute(folder_ + "/strings/0x409/serialnumber", serial_);
  fs::create_directory(folder_ + "/configs/c.1");
  fs::create_directory(folder_ + "/functions/acm.0");
  fs::create_symlink(folder_ + "/functions/acm.0", folder_ + "/configs/c.1/acm.0");
}

/// In the reverse order; what was never made cannot be removed, which is no error.
void UsbGadget::remove() noexcept {
  try {
    write_attribute(folder_ + "/UDC", "\n");
  } catch (const std::exception&) {
    // It was not plugged.
  }
  ::unlink((folder_ + "/configs/c.1/acm.0").c_str());
  for (const char* folder : {"/configs/c.1", "/functions/acm.0", "/strings/0x409", ""})
    ::rmdir((folder_ + folder).c_str());
}

link::UniqueFd UsbGadget::plug() {
  write_attribute(folder_ + "/UDC", kController);
  link::UniqueFd fd(::open(kDeviceEnd, O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC));
  termios settings{};
  if (!fd || ::tcgetattr(fd.get(), &settings) != 0)
    throw std::runtime_error(std::string(kDeviceEnd) + ": cannot open: " + std::strerror(errno));
  ::cfmakeraw(&settings);
  ::tcsetattr(fd.get(), TCSANOW, &settings);
  return fd;
}

void UsbGadget::unplug() {
  const auto name = host_side();
  std::printf("unplugged from %s\n", name.empty() ? "a host that had not found it" : name.c_str());
  std::fflush(stdout);
  held_ = link::UniqueFd(::open(name.c_str(), O_RDONLY | O_NOCTTY | O_NONBLOCK | O_CLOEXEC));
  write_attribute(folder_ + "/UDC", "\n");
}

/// The line whose USB device has our serial number; empty: there is none (yet).
std::string UsbGadget::host_side() const {
  std::error_code ignored;
  for (const auto& line : fs::directory_iterator("/sys/class/tty", ignored)) {
    std::string serial;
    std::ifstream(line.path() / "device/../serial") >> serial;
    if (serial == serial_) return "/dev/" + line.path().filename().string();
  }
  return {};
}

bool UsbGadget::is_taken(int fd) {
  int waiting = 0;
  return ::ioctl(fd, TIOCOUTQ, &waiting) == 0 && waiting < kMostWaiting;
}

}  // namespace drover::sim
