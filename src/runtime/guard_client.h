// droverd's side of the guard: hands over descriptors and stop frames, counts the heartbeat.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "drover/can_frame.h"
#include "drover/guard_protocol.h"
#include "link/unique_fd.h"

namespace drover::runtime {

/// What the guard must do for one link: a descriptor of its own, and the frames that stop its
/// drives.
struct GuardedLink {
  link::UniqueFd descriptor;
  std::vector<CanFrame> stop_frames;
};

/// The heartbeats, mapped into both processes. Made once; lives as long as the daemon.
class GuardMemory final {
 public:
  GuardMemory();  ///< throws std::runtime_error
  ~GuardMemory();
  GuardMemory(const GuardMemory&) = delete;
  GuardMemory& operator=(const GuardMemory&) = delete;
  GuardShared& shared() const { return *shared_; }
  int fd() const { return fd_.get(); }

 private:
  link::UniqueFd fd_;
  GuardShared* shared_ = nullptr;
};

class GuardClient final {
 public:
  GuardClient(std::string socket_path, int limit_ms, const GuardMemory& memory);

  /// Connects when needed and hands over the whole set. False with a sentence in `problem`.
  bool hand_over(std::span<const GuardedLink> links, std::string& problem);
  bool hand_back();
  /// The handle of the hardware watchdog's line; the guard keeps one of its own.
  bool give_pulse_line(int line);
  /// To be polled for the guard's death; -1 while not connected.
  int fd() const { return socket_.get(); }
  void disconnect() { socket_.reset(); }
  bool connected() const { return static_cast<bool>(socket_); }

 private:
  bool connect(std::string& problem);
  bool send(const GuardMessage& message, int descriptor = -1);

  std::string path_;
  int limit_ms_;
  const GuardMemory& memory_;
  link::UniqueFd socket_;
};

}  // namespace drover::runtime
