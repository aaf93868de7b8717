#include "link/serial_link.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/ioctl.h>
#include <termios.h>

namespace drover::link {

namespace {

struct BaudRate {
  int baud;
  speed_t code;
};
constexpr BaudRate kBaudRates[] = {
    {4800, B4800},     {9600, B9600},     {19200, B19200},   {38400, B38400},   {57600, B57600},
    {115200, B115200}, {230400, B230400}, {460800, B460800}, {921600, B921600},
};

bool make_raw(int fd, speed_t speed) {
  termios settings{};
  if (::tcgetattr(fd, &settings) != 0) return false;
  ::cfmakeraw(&settings);
  settings.c_cflag |= CLOCAL | CREAD;
  settings.c_cflag &= ~static_cast<tcflag_t>(HUPCL | CRTSCTS);
  settings.c_cc[VMIN] = 1;  // an idle line then says EAGAIN, and 0 bytes mean that it hung up
  settings.c_cc[VTIME] = 0;
  if (::cfsetspeed(&settings, speed) != 0) return false;
  if (::tcsetattr(fd, TCSANOW, &settings) != 0) return false;
  return ::tcflush(fd, TCIOFLUSH) == 0;
}

}  // namespace

bool SerialLink::read(std::span<std::uint8_t> buffer, std::size_t& size) {
  size = 0;
  const auto n = ::read(fd_.get(), buffer.data(), buffer.size());
  if (n > 0) {
    size = static_cast<std::size_t>(n);
    return true;
  }
  if (n < 0 && (errno == EAGAIN || errno == EWOULDBLOCK || errno == EINTR)) return true;
  error_ = n < 0 ? errno : EIO;
  return false;
}

bool SerialLink::write(std::span<const std::uint8_t> bytes, std::size_t& taken) {
  const auto n = ::write(fd_.get(), bytes.data(), bytes.size());
  taken = n > 0 ? static_cast<std::size_t>(n) : 0;
  if (n >= 0 || errno == EAGAIN || errno == EWOULDBLOCK || errno == EINTR) return true;
  error_ = errno;
  return false;
}

Opened<SerialLink> open_serial(const SerialSettings& settings) {
  Opened<SerialLink> opened;
  const auto& path = settings.path;
  const BaudRate* rate = nullptr;
  for (const auto& candidate : kBaudRates)
    if (candidate.baud == settings.baud) rate = &candidate;
  if (rate == nullptr) {
    opened.problem = path + ": baud rate " + std::to_string(settings.baud) + " is not supported";
    return opened;
  }
  UniqueFd fd(::open(path.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC));
  if (!fd) {
    opened.problem = problem_text(path, "cannot open", errno);
    return opened;
  }
  if (::flock(fd.get(), LOCK_EX | LOCK_NB) != 0) {
    opened.problem = path + ": another program uses this line";
    return opened;
  }
  ::ioctl(fd.get(), TIOCEXCL);
  if (!make_raw(fd.get(), rate->code)) {
    opened.problem = problem_text(path, "is no serial line", errno);
    return opened;
  }
  opened.link = std::make_unique<SerialLink>(std::move(fd));
  return opened;
}

}  // namespace drover::link
