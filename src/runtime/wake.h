// An eventfd: one thread wakes another without a lock.
#pragma once

#include <sys/eventfd.h>
#include <unistd.h>

#include <cstdint>

#include "link/unique_fd.h"

namespace drover::runtime {

class Wake final {
 public:
  Wake() : fd_(::eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK)) {}
  int fd() const { return fd_.get(); }
  void notify() const {
    const std::uint64_t one = 1;
    (void)!::write(fd_.get(), &one, sizeof one);
  }
  void clear() const {
    std::uint64_t count = 0;
    (void)!::read(fd_.get(), &count, sizeof count);
  }

 private:
  link::UniqueFd fd_;
};

}  // namespace drover::runtime
