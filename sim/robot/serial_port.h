// A device's serial line: a pseudo-terminal with the pace and the speed of a real one, both ways;
// or one on USB.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "drover/time.h"
#include "link/unique_fd.h"
#include "sim/robot/usb_gadget.h"

namespace drover::sim {

/// Spends a line's capacity: so many bytes may leave in each tick, fractions carried over.
class BaudPacer {
 public:
  explicit BaudPacer(int baud) : baud_(baud) {}
  /// How many of `waiting` bytes leave in a tick of this length (10 bits a byte). An idle line
  /// saves nothing up.
  std::size_t take(std::size_t waiting, Duration tick);
  void set_baud(int baud) { baud_ = baud; }
  int baud() const { return baud_; }

 private:
  int baud_;
  std::int64_t credit_ = 0;
};

/// A reader that has opened the line at another speed than the device's gets noise, and so does the
/// device.
class SerialPort {
 public:
  /// Makes `link_path` a symbolic link to the pseudo-terminal; "usb:1546:01a9" is a device on USB
  /// of that vendor and product instead, which knows no speed. Throws std::runtime_error.
  SerialPort(const std::string& link_path, int baud);
  ~SerialPort();
  SerialPort(const SerialPort&) = delete;
  SerialPort& operator=(const SerialPort&) = delete;

  /// Queues what the device says and sends one tick's worth; hears what was written to it. A line
  /// that nobody has open loses its bytes, as a real one does.
  void pump(std::string_view said, Duration tick);
  /// What was written to the device, found by the last pump() or listen().
  std::span<const std::uint8_t> heard() const { return heard_; }
  /// Before pump(), each tick, for a device that is commanded: pump() hears only now and then. No
  /// faster than the line carries it: what is more waits in the writer's queue.
  void listen(Duration tick);
  /// The device's own speed.
  void set_baud(int baud);
  /// Pulls the plug: the reader's descriptor hangs up and the link is gone.
  void unplug();
  /// Another pseudo-terminal under the same link, or the device on USB under another name. Throws
  /// std::runtime_error.
  void plug();
  bool plugged() const { return static_cast<bool>(line_); }
  /// Bytes that nobody took although the line was open, or that the line had no time for.
  std::uint64_t dropped() const { return dropped_; }

 private:
  link::UniqueFd linked_terminal();
  bool hear(std::size_t limit);
  void blur();
  void look();
  char noise();

  std::string link_path_;
  std::optional<UsbGadget> usb_;
  link::UniqueFd line_;  ///< the device's end
  BaudPacer pacer_;
  BaudPacer hears_;
  std::string queue_;
  std::vector<std::uint8_t> heard_;
  bool listens_ = false;  ///< each tick
  int ticks_since_look_ = 0;
  bool listening_ = false;
  bool speeds_agree_ = true;
  std::uint32_t noise_ = 1;
  std::uint64_t dropped_ = 0;
};

}  // namespace drover::sim
