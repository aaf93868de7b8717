#include "sim/robot/pty.h"

#include <fcntl.h>
#include <stdlib.h>
#include <termios.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <stdexcept>

namespace drover::sim {

Pty open_pty() {
  Pty pty;
  const auto fail = [](const char* what) {
    throw std::runtime_error(std::string("pseudo-terminal: ") + what + ": " + std::strerror(errno));
  };
  pty.master = link::UniqueFd(::posix_openpt(O_RDWR | O_NOCTTY | O_CLOEXEC | O_NONBLOCK));
  if (!pty.master) fail("cannot open /dev/ptmx");
  if (::grantpt(pty.master.get()) != 0 || ::unlockpt(pty.master.get()) != 0) fail("cannot unlock");
  std::array<char, 64> path{};
  if (::ptsname_r(pty.master.get(), path.data(), path.size()) != 0) fail("has no name");
  pty.slave_path = path.data();
  pty.slave = link::UniqueFd(::open(path.data(), O_RDWR | O_NOCTTY | O_CLOEXEC | O_NONBLOCK));
  if (!pty.slave) fail(path.data());
  termios settings{};
  if (::tcgetattr(pty.slave.get(), &settings) != 0) fail("no settings");
  ::cfmakeraw(&settings);
  if (::tcsetattr(pty.slave.get(), TCSANOW, &settings) != 0) fail("cannot make raw");
  return pty;
}

}  // namespace drover::sim
