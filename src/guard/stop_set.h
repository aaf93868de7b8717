// What the guard sends and where: bytes and descriptors that droverd handed over. The guard knows
// no protocol; it repeats what it was given.
#pragma once

#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cstddef>

#include "drover/guard_protocol.h"

namespace drover::guard {

class StopSet final {
 public:
  StopSet() { descriptors_.fill(-1); }
  ~StopSet() { clear(); }
  StopSet(const StopSet&) = delete;
  StopSet& operator=(const StopSet&) = delete;

  void clear() {
    for (int& fd : descriptors_) {
      if (fd >= 0) ::close(fd);
      fd = -1;
    }
    count_ = 0;
  }
  /// Takes ownership of `fd`; false for an index out of range.
  bool set_descriptor(std::uint32_t index, int fd) {
    if (index >= descriptors_.size() || descriptors_[index] >= 0) return false;
    descriptors_[index] = fd;
    return true;
  }
  bool add(const GuardMessage& message) {
    if (count_ == frames_.size() || message.size == 0 || message.size > kGuardMaxBytes ||
        message.descriptor >= descriptors_.size())
      return false;
    frames_[count_++] = message;
    return true;
  }
  void swap(StopSet& other) {
    descriptors_.swap(other.descriptors_);
    frames_.swap(other.frames_);
    std::swap(count_, other.count_);
  }
  std::size_t size() const { return count_; }
  /// The ten lines that write. What a full or dead link refuses is sent again next time.
  std::size_t send() const {
    std::size_t taken = 0;
    for (std::size_t i = 0; i < count_; ++i) {
      const auto& frame = frames_[i];
      const int fd = descriptors_[frame.descriptor];
      if (fd < 0) continue;
      const auto n = ::send(fd, frame.bytes.data(), frame.size, MSG_DONTWAIT | MSG_NOSIGNAL);
      taken += n == static_cast<ssize_t>(frame.size) ? 1 : 0;
    }
    return taken;
  }

 private:
  std::array<int, kGuardMaxDescriptors> descriptors_{};
  std::array<GuardMessage, kGuardMaxFrames> frames_{};
  std::size_t count_ = 0;
};

}  // namespace drover::guard
