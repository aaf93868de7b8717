#include "sim/robot/gnss_port.h"

#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <stdexcept>

namespace drover::sim {

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

GnssPort::GnssPort(const std::string& link_path, int baud)
    : link_path_(link_path), pty_(open_pty()), pacer_(baud) {
  // While we hold the slave ourselves, nothing tells whether somebody else does.
  pty_.slave.reset();
  ::unlink(link_path_.c_str());
  if (::symlink(pty_.slave_path.c_str(), link_path_.c_str()) != 0)
    throw std::runtime_error(link_path_ + ": cannot link: " + std::strerror(errno));
}

GnssPort::~GnssPort() {
  ::unlink(link_path_.c_str());
}

bool GnssPort::somebody_listens() {
  pollfd line{pty_.master.get(), 0, 0};
  return ::poll(&line, 1, 0) >= 0 && (line.revents & POLLHUP) == 0;
}

void GnssPort::pump(std::string_view said, Duration tick) {
  if (!said.empty()) {
    // Asked once an epoch: a system call for each tick is dear where they are slow.
    listening_ = somebody_listens();
    if (listening_) {  // what is written to a receiver does not concern this one
      std::array<char, 512> ignored{};
      while (::read(pty_.master.get(), ignored.data(), ignored.size()) > 0) {
      }
    }
    queue_ += said;
  }
  const auto bytes = pacer_.take(queue_.size(), tick);
  if (bytes == 0) return;
  if (listening_) {
    const auto n = ::write(pty_.master.get(), queue_.data(), bytes);
    dropped_ += bytes - static_cast<std::size_t>(std::max<ssize_t>(n, 0));
  }
  queue_.erase(0, bytes);
}

}  // namespace drover::sim
