// The receiver's serial line: a pseudo-terminal whose bytes leave at the pace of the baud rate.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "drover/time.h"
#include "sim/robot/pty.h"

namespace drover::sim {

/// Spends a line's capacity: so many bytes may leave in each tick, fractions carried over.
class BaudPacer {
 public:
  explicit BaudPacer(int baud) : baud_(baud) {}
  /// How many of `waiting` bytes leave in a tick of this length (10 bits a byte). An idle line
  /// saves nothing up.
  std::size_t take(std::size_t waiting, Duration tick);

 private:
  int baud_;
  std::int64_t credit_ = 0;
};

class GnssPort {
 public:
  /// Makes `link_path` a symbolic link to the pseudo-terminal. Throws std::runtime_error.
  GnssPort(const std::string& link_path, int baud);
  ~GnssPort();
  GnssPort(const GnssPort&) = delete;
  GnssPort& operator=(const GnssPort&) = delete;

  /// Queues what the receiver says and sends one tick's worth. A line that nobody has open loses
  /// its bytes, as a real one does.
  void pump(std::string_view said, Duration tick);
  /// Bytes that nobody took although the line was open.
  std::uint64_t dropped() const { return dropped_; }

 private:
  bool somebody_listens();

  std::string link_path_;
  Pty pty_;
  BaudPacer pacer_;
  std::string queue_;
  bool listening_ = false;
  std::uint64_t dropped_ = 0;
};

}  // namespace drover::sim
