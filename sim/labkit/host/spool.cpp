// Output of the lab on its way to the user.
#include "spool.h"

namespace drover::lab {

void Spool::read_some() {
  char buffer[65536];
  const ssize_t n = ::read(from_.get(), buffer, sizeof buffer);
  if (n > 0) {
    if (!broken_) pending_.append(buffer, static_cast<std::size_t>(n));
  } else if (n == 0 || (errno != EINTR && errno != EAGAIN)) {
    from_.reset();
  }
}

void Spool::write_some() {
  // After POLLOUT a pipe takes PIPE_BUF bytes without blocking, and no more is promised.
  const std::size_t size = pending_.size() < 4096 ? pending_.size() : 4096;
  const ssize_t n = ::write(to_, pending_.data(), size);
  if (n > 0) {
    pending_.erase(0, static_cast<std::size_t>(n));
  } else if (n < 0 && errno != EINTR && errno != EAGAIN) {
    broken_ = true;
    pending_.clear();
  }
}

void Spool::finish() {
  if (from_.open()) ::fcntl(from_.get(), F_SETFL, O_NONBLOCK);
  while (from_.open()) {
    pollfd look{from_.get(), POLLIN, 0};
    if (::poll(&look, 1, 0) <= 0) break;
    read_some();
  }
  while (writing()) {
    pollfd look{to_, POLLOUT, 0};
    if (::poll(&look, 1, -1) > 0) write_some();
  }
}

}  // namespace drover::lab
