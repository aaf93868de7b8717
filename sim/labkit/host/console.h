// The second console: a Unix socket on the host, a shell on the other side.
#pragma once

#include <string>

#include "fd.h"

namespace drover::lab {

/// Serves one visitor at a time. A visitor's first line ("rows columns TERM") starts the shell;
/// who comes back to a shell that still runs finds it as it was left.
class ConsoleServer final {
 public:
  ConsoleServer(Fd kernel, const std::string& socket_path);

  int kernel_fd() const { return kernel_.get(); }
  int listen_fd() const { return listen_.get(); }
  int visitor_fd() const { return visitor_.get(); }
  void accept_visitor();
  void from_visitor();
  void from_kernel();

 private:
  Fd kernel_;
  Fd listen_;
  Fd visitor_;
  bool shell_runs_ = false;
  bool hello_pending_ = false;
  std::string hello_;
  std::string tail_;  // the end of what the shell wrote, to find the end mark across reads
};

/// Joins the caller's terminal to a lab's console until its shell ends or Ctrl-] is typed.
int attach(const std::string& socket_path);

}  // namespace drover::lab
