// Joins the lab's network card to the host's loopback through passt, without any privilege.
#pragma once

#include <sys/types.h>

#include <string>

#include "fd.h"

namespace drover::lab {

/// Frames are datagrams on the kernel's side and length-prefixed (4 bytes, big-endian) on
/// passt's side. passt forwards 127.0.0.1:port of the host to port 1883 of the lab, and
/// where there is a second port that one to 1884.
class NetRelay final {
 public:
  /// A port of 0 chooses a free one; `second_port` -1: none. Outgoing connections have no route:
  /// the lab stays a lab.
  NetRelay(Fd kernel, int port, int second_port, const std::string& log_path);
  NetRelay(const NetRelay&) = delete;
  NetRelay& operator=(const NetRelay&) = delete;
  ~NetRelay();

  int port() const { return port_; }
  int second_port() const { return second_port_; }
  int kernel_fd() const { return kernel_.get(); }
  int passt_fd() const { return passt_.get(); }
  /// False once passt ended.
  bool alive() const { return passt_.open(); }
  void from_kernel();
  void from_passt();

 private:
  Fd kernel_;
  Fd passt_;
  pid_t pid_ = -1;
  int port_ = 0;
  int second_port_ = -1;
  std::string stream_;
};

}  // namespace drover::lab
