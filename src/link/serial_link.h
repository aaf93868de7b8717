// An open serial line, raw and non-blocking.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "link/opened.h"
#include "link/unique_fd.h"

namespace drover::link {

struct SerialSettings {
  std::string path;  ///< "/dev/drover/gnss"
  int baud = 115200;
};

class SerialLink final {
 public:
  explicit SerialLink(UniqueFd fd) : fd_(std::move(fd)) {}

  /// As `read_serial`. False when the line hung up: close it at once, otherwise the device comes
  /// back under another name.
  [[nodiscard]] bool read(std::span<std::uint8_t> buffer, std::size_t& size);
  /// Writes what the line takes; the rest is dropped. False when the line hung up.
  [[nodiscard]] bool write(std::span<const std::uint8_t> bytes, std::size_t& taken);

  int fd() const { return fd_.get(); }
  int error() const { return error_; }
  /// Of the same open file, for who else is to stop what hangs on it; a second opening is refused.
  UniqueFd duplicate() const;

 private:
  UniqueFd fd_;
  int error_ = 0;
};

/// Reads what waits on a line that may be somebody else's, at most `buffer`; `size` 0: nothing.
/// Returns 0, or an errno when the line hung up.
int read_serial(int fd, std::span<std::uint8_t> buffer, std::size_t& size);

/// Raw before the first read (a fresh line echoes and would feed the receiver its own words),
/// exclusive, without control of a modem's lines on close.
Opened<SerialLink> open_serial(const SerialSettings& settings);
/// The same of a line that somebody kept open, without throwing away what he wrote. No link, and no
/// problem: it is dead, or not the line of this path (any more), and the path has to be opened.
Opened<SerialLink> adopt_serial(const SerialSettings& settings, UniqueFd kept);

}  // namespace drover::link
