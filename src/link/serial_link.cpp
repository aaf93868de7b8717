#include "link/serial_link.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/ioctl.h>
#include <sys/stat.h>
#include <termios.h>

#include <algorithm>
#include <optional>

#include "drover/baud.h"

namespace drover::link {

namespace {

/// In the order of kSerialBauds.
constexpr speed_t kCodes[] = {B4800,   B9600,   B19200,  B38400, B57600,
                              B115200, B230400, B460800, B921600};
static_assert(std::size(kCodes) == kSerialBauds.size());

bool make_raw(int fd, speed_t speed, int thrown_away) {
  termios settings{};
  if (::tcgetattr(fd, &settings) != 0) return false;
  ::cfmakeraw(&settings);
  settings.c_cflag |= CLOCAL | CREAD;
  settings.c_cflag &= ~static_cast<tcflag_t>(HUPCL | CRTSCTS);
  settings.c_cc[VMIN] = 1;  // an idle line then says EAGAIN, and 0 bytes mean that it hung up
  settings.c_cc[VTIME] = 0;
  if (::cfsetspeed(&settings, speed) != 0) return false;
  if (::tcsetattr(fd, TCSANOW, &settings) != 0) return false;
  return ::tcflush(fd, thrown_away) == 0;
}

/// Nothing: nobody has heard of it.
std::optional<speed_t> code_of(int baud) {
  const auto* const rate = std::find(kSerialBauds.begin(), kSerialBauds.end(), baud);
  if (rate == kSerialBauds.end()) return std::nullopt;
  return kCodes[rate - kSerialBauds.begin()];
}

/// The path leads to the device that `fd` has open.
bool is_at(const std::string& path, int fd) {
  struct stat open {};
  struct stat named {};
  return ::fstat(fd, &open) == 0 && ::stat(path.c_str(), &named) == 0 && S_ISCHR(open.st_mode) &&
         S_ISCHR(named.st_mode) && open.st_rdev == named.st_rdev;
}

}  // namespace

int read_serial(int fd, std::span<std::uint8_t> buffer, std::size_t& size) {
  const auto n = ::read(fd, buffer.data(), buffer.size());
  size = n > 0 ? static_cast<std::size_t>(n) : 0;
  if (n > 0) return 0;
  if (n < 0 && (errno == EAGAIN || errno == EWOULDBLOCK || errno == EINTR)) return 0;
  return n < 0 ? errno : EIO;
}

bool SerialLink::read(std::span<std::uint8_t> buffer, std::size_t& size) {
  error_ = read_serial(fd_.get(), buffer, size);
  return error_ == 0;
}

bool SerialLink::write(std::span<const std::uint8_t> bytes, std::size_t& taken) {
  const auto n = ::write(fd_.get(), bytes.data(), bytes.size());
  taken = n > 0 ? static_cast<std::size_t>(n) : 0;
  if (n >= 0 || errno == EAGAIN || errno == EWOULDBLOCK || errno == EINTR) return true;
  error_ = errno;
  return false;
}

UniqueFd SerialLink::duplicate() const {
  return UniqueFd(::fcntl(fd_.get(), F_DUPFD_CLOEXEC, 0));
}

/// What waits to be read is of before; what waits to be written may be somebody's stop.
Opened<SerialLink> adopt_serial(const SerialSettings& settings, UniqueFd kept) {
  Opened<SerialLink> opened;
  const auto speed = code_of(settings.baud);
  if (!kept || !speed || !is_at(settings.path, kept.get())) return opened;
  const int flags = ::fcntl(kept.get(), F_GETFL);
  if (flags < 0 || ::fcntl(kept.get(), F_SETFL, flags | O_NONBLOCK) != 0) return opened;
  if (!make_raw(kept.get(), *speed, TCIFLUSH)) return opened;
  opened.link = std::make_unique<SerialLink>(std::move(kept));
  return opened;
}

Opened<SerialLink> open_serial(const SerialSettings& settings) {
  Opened<SerialLink> opened;
  const auto& path = settings.path;
  const auto speed = code_of(settings.baud);
  if (!speed) {
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
  if (!make_raw(fd.get(), *speed, TCIOFLUSH)) {
    opened.problem = problem_text(path, "is no serial line", errno);
    return opened;
  }
  opened.link = std::make_unique<SerialLink>(std::move(fd));
  return opened;
}

}  // namespace drover::link
