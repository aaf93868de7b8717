// droverd's side of the guard: hands over descriptors and stop frames, counts the heartbeat.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "drover/actuator.h"
#include "drover/guard_protocol.h"
#include "link/unique_fd.h"

namespace drover::runtime {

/// How one axis is stopped: its rounds of messages are played in turn, a round each period.
struct GuardedAxis {
  std::string name;  ///< what it is on the wire: the link's name and its address there
  std::chrono::milliseconds period{10};
  std::vector<std::vector<std::vector<std::uint8_t>>> rounds;  ///< messages as they are written
  // As in GuardMessage:
  bool held_by_daemon = false;
  bool runs_on = false;
};

/// What the guard must do for one link.
struct GuardedLink {
  std::string name;
  GuardLinkKind kind = GuardLinkKind::can;
  link::UniqueFd descriptor;  ///< the guard's own; without one it goes on with the one it has
  std::vector<GuardedAxis> axes;
};

/// One device. On a CAN bus it is known by the id of its first frame, on a tty by the line.
GuardedAxis guarded_axis(const std::string& link, const StopRecipe& stop);

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

  /// Connects when needed.
  bool reach() {
    std::string problem;
    return connected() || connect(problem);
  }
  /// Connects when needed and hands over the whole set. False with a sentence in `problem`.
  bool hand_over(std::span<const GuardedLink> links, std::string& problem);
  bool hand_back();
  /// A duplicate of what the guard keeps as `name`; nothing when it keeps no such thing. Waits for
  /// the answer half a second at most; `late` is called, once, when the guard has not answered for
  /// so long that it counts as not there.
  link::UniqueFd borrow(const std::string& name, const std::function<void()>& late);
  /// The guard closes what it keeps as `name`.
  bool let_go(const std::string& name);
  /// The enable relay's line: it falls when the last of both programs closes it.
  bool give_relay_line(const std::string& name, int line);
  /// The handle of the hardware watchdog's line; the guard keeps one of its own.
  bool give_pulse_line(int line);
  /// To be polled for the guard's death; -1 while not connected.
  int fd() const { return socket_.get(); }
  void disconnect() { socket_.reset(); }
  bool connected() const { return static_cast<bool>(socket_); }
  /// A set was handed over on this connection.
  bool supplied() const { return connected() && supplied_; }

 private:
  bool connect(std::string& problem);
  bool send(const GuardMessage& message, int descriptor = -1);
  bool answers(const std::function<void()>& late) const;
  bool send_link(std::uint32_t index, const GuardedLink& link);
  bool send_axis(std::uint32_t index, std::uint32_t link, const GuardedAxis& axis);

  std::string path_;
  int limit_ms_;
  const GuardMemory& memory_;
  link::UniqueFd socket_;
  bool supplied_ = false;
};

}  // namespace drover::runtime
