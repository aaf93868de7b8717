// The simulator's socket for people and scenarios: one command a message, one answer each.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "link/unique_fd.h"

namespace drover::sim {

/// SOCK_SEQPACKET, non-blocking, registered in the caller's epoll set.
class ControlSocket {
 public:
  /// Throws std::runtime_error.
  ControlSocket(const std::string& path, int epoll_fd);
  ~ControlSocket();
  ControlSocket(const ControlSocket&) = delete;
  ControlSocket& operator=(const ControlSocket&) = delete;

  /// Takes a descriptor that epoll reported; false when it is none of ours.
  bool on_event(int fd, const std::function<std::string(std::string_view)>& answer);

 private:
  void watch(int fd);

  std::string path_;
  int epoll_fd_;
  link::UniqueFd listen_;
  std::vector<link::UniqueFd> clients_;
};

/// A client: sends one command and returns the answer. Throws std::runtime_error.
std::string ask(const std::string& path, std::string_view command);

}  // namespace drover::sim
