#include "sim/robot/serial_port.h"

#include <termios.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <stdexcept>

#include "sim/robot/pty.h"

namespace drover::sim {
namespace {

// A device says what its line can carry; what is more is torn or lost.
constexpr std::size_t kLongestQueue = 4096;
// So seldom a port looks whether somebody writes to it, or has it open at all: system calls are
// dear in places.
constexpr int kTicksBetweenLooks = 4;

struct Speed {
  speed_t code;
  int baud;
};
constexpr Speed kSpeeds[] = {{B4800, 4800},     {B9600, 9600},     {B19200, 19200},
                             {B38400, 38400},   {B57600, 57600},   {B115200, 115200},
                             {B230400, 230400}, {B460800, 460800}, {B921600, 921600}};

/// Of the side that has opened the line; 0 when it cannot be told. A pseudo-terminal carries no
/// bits, but it remembers the setting.
int host_baud(int master) {
  termios settings{};
  if (::tcgetattr(master, &settings) != 0) return 0;
  const speed_t code = ::cfgetospeed(&settings);
  for (const auto& speed : kSpeeds)
    if (speed.code == code) return speed.baud;
  return 0;
}

}  // namespace

std::size_t BaudPacer::take(std::size_t waiting, Duration tick) {
  if (waiting == 0) {
    credit_ = 0;
    return 0;
  }
  // Whole numbers, in bits times nanoseconds a second: nothing is lost to rounding.
  constexpr std::int64_t kByte = 10 * std::int64_t{1'000'000'000};
  credit_ += baud_ * std::int64_t{tick.count()};
  const auto bytes = std::min(waiting, static_cast<std::size_t>(credit_ / kByte));
  credit_ -= static_cast<std::int64_t>(bytes) * kByte;
  return bytes;
}

SerialPort::SerialPort(const std::string& link_path, int baud)
    : link_path_(link_path), pacer_(baud), hears_(baud) {
  constexpr std::string_view kUsb = "usb:";
  if (link_path.starts_with(kUsb)) usb_.emplace(link_path.substr(kUsb.size()));
  plug();
}

SerialPort::~SerialPort() {
  unplug();
}

void SerialPort::plug() {
  if (plugged()) return;
  line_ = usb_ ? usb_->plug() : linked_terminal();
  listening_ = false;
}

link::UniqueFd SerialPort::linked_terminal() {
  Pty pty = open_pty();
  // While we hold the slave ourselves, nothing tells whether somebody else does.
  pty.slave.reset();
  ::unlink(link_path_.c_str());
  if (::symlink(pty.slave_path.c_str(), link_path_.c_str()) != 0)
    throw std::runtime_error(link_path_ + ": cannot link: " + std::strerror(errno));
  return std::move(pty.master);
}

void SerialPort::unplug() {
  if (!plugged()) return;
  if (!usb_) ::unlink(link_path_.c_str());
  line_.reset();
  if (usb_) usb_->unplug();
  queue_.clear();
  heard_.clear();
}

char SerialPort::noise() {
  noise_ = noise_ * 1664525U + 1013904223U;
  return static_cast<char>(noise_ >> 24U);
}

void SerialPort::set_baud(int baud) {
  if (baud != pacer_.baud()) ticks_since_look_ = kTicksBetweenLooks;
  pacer_.set_baud(baud);
  hears_.set_baud(baud);
}

/// Takes at most `limit` bytes of what was written. False: nobody has the line open.
bool SerialPort::hear(std::size_t limit) {
  std::array<std::uint8_t, 512> bytes{};
  while (limit > 0) {
    const auto n = ::read(line_.get(), bytes.data(), std::min(limit, bytes.size()));
    if (n < 0 && errno == EAGAIN) break;
    if (n <= 0) return false;
    heard_.insert(heard_.end(), bytes.begin(), bytes.begin() + n);
    limit -= static_cast<std::size_t>(n);
  }
  return !usb_ || UsbGadget::is_taken(line_.get());
}

void SerialPort::blur() {
  if (speeds_agree_) return;
  for (auto& byte : heard_) byte = static_cast<std::uint8_t>(noise());
}

void SerialPort::look() {
  ticks_since_look_ = 0;
  if (!listens_) listening_ = hear(SIZE_MAX);
  if (!listening_) return;
  const int host = usb_ ? 0 : host_baud(line_.get());
  speeds_agree_ = host == 0 || host == pacer_.baud();
  if (!listens_) blur();
}

void SerialPort::listen(Duration tick) {
  listens_ = true;
  heard_.clear();
  if (!plugged()) return;
  listening_ = hear(hears_.take(SIZE_MAX, tick));
  blur();
}

void SerialPort::pump(std::string_view said, Duration tick) {
  if (!listens_) heard_.clear();
  if (!plugged()) return;
  const bool lost_for_ever = !listening_ && !said.empty();
  if (++ticks_since_look_ >= kTicksBetweenLooks || lost_for_ever) look();
  if (queue_.size() + said.size() <= kLongestQueue) {
    queue_ += said;
  } else {
    dropped_ += said.size();
  }
  const auto bytes = pacer_.take(queue_.size(), tick);
  if (bytes == 0) return;
  if (listening_) {
    if (!speeds_agree_) std::generate_n(queue_.begin(), bytes, [this] { return noise(); });
    const auto n = ::write(line_.get(), queue_.data(), bytes);
    dropped_ += bytes - static_cast<std::size_t>(std::max<ssize_t>(n, 0));
  }
  queue_.erase(0, bytes);
}

}  // namespace drover::sim
