// Ways into a running lab: a Unix socket on the host, shells on the other side.
#pragma once

#include <string>
#include <vector>

#include "fd.h"

namespace drover::lab {

/// Serves as many visitors as there are consoles. A visitor's first line ("rows columns TERM")
/// starts a shell; who comes back finds a shell that was left running as it was left.
class ConsoleServer final {
 public:
  ConsoleServer(std::vector<Fd> kernel_ends, const std::string& socket_path);

  std::size_t seats() const { return seats_.size(); }
  int kernel_fd(std::size_t seat) const { return seats_[seat].kernel.get(); }
  int visitor_fd(std::size_t seat) const { return seats_[seat].visitor.get(); }
  int listen_fd() const { return listen_.get(); }
  void accept_visitor();
  void from_visitor(std::size_t seat);
  void from_kernel(std::size_t seat);

 private:
  struct Seat {
    Fd kernel;
    Fd visitor;
    bool shell_runs = false;
    bool hello_pending = false;
    std::string hello;
    std::string tail;  // the end of what the shell wrote, to find the end mark across reads
  };
  Seat* free_seat();

  std::vector<Seat> seats_;
  Fd listen_;
};

/// Joins the caller's terminal to a lab's console until its shell ends or Ctrl-] is typed.
int attach(const std::string& socket_path);

}  // namespace drover::lab
