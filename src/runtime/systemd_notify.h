// What systemd is told, without ever waiting for it: a datagram that finds no room is dropped.
#pragma once

#include <string_view>

#include "link/unique_fd.h"

namespace drover::runtime {

class SystemdNotify final {
 public:
  /// Takes the address from NOTIFY_SOCKET; without it, every state counts as told.
  SystemdNotify();
  /// False when it did not take the message: worth another try for what must be heard (READY=1).
  bool tell(std::string_view state);

 private:
  link::UniqueFd socket_;
};

}  // namespace drover::runtime
