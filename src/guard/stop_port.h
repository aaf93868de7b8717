// The guard's second socket: people stop the robot here when droverd does not hear. It can do
// nothing else than stop, reset and tell the state; who may reach it is decided by its file mode.
#pragma once

#include <sys/types.h>

#include <array>
#include <cstddef>
#include <string>
#include <string_view>

struct pollfd;

namespace drover::guard {

/// Who answers.
class StopListener {
 public:
  virtual ~StopListener() = default;
  /// Latches; the drives have their stop messages when it returns.
  virtual void stop(uid_t by) = 0;
  virtual void reset(uid_t by) = 0;
  /// One line of JSON.
  virtual std::string_view state() = 0;
};

class StopPort final {
 public:
  static constexpr std::size_t kClients = 8;
  static constexpr std::size_t kPollFds = kClients + 1;

  StopPort(int listener, StopListener& answers);
  /// Fills `kPollFds` entries.
  void poll_fds(pollfd* fds) const;
  /// After the wait, with the same entries.
  void serve(const pollfd* fds);

 private:
  struct Client {
    int fd = -1;
    uid_t uid = 0;
  };
  void accept();
  void hear(Client& client);

  int listener_;
  StopListener& answers_;
  std::array<Client, kClients> clients_{};
  std::size_t oldest_ = 0;
};

}  // namespace drover::guard
