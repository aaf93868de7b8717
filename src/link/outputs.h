// Digital outputs: levels that are set when they change, and lines that another process may set.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "link/opened.h"
#include "link/unique_fd.h"

namespace drover::link {

struct OutputLine {
  std::string name;  ///< on the chip
  bool active_low = false;
};

struct OutputSettings {
  std::string chip;  ///< label or name of the chip, or "files:DIRECTORY"
  std::vector<OutputLine> lines;
  /// Index of the line with a handle of its own, which another process keeps too; -1: none. It
  /// falls when the last of both closes it.
  int shared_line = -1;
};

/// Holds the lines as long as it lives.
class OutputLink {
 public:
  virtual ~OutputLink() = default;
  /// `levels` in the order of the settings, true is active. False when the chip is gone.
  [[nodiscard]] virtual bool write(std::span<const bool> levels) = 0;
  virtual int error() const = 0;
  /// Level of the line with this index in the settings; false when it cannot be told.
  virtual bool is_on(std::size_t line) const = 0;
  /// The kernel's line handle, for the guard; -1 where there is none.
  virtual int fd() const { return -1; }
  /// That of `shared_line`.
  virtual int shared_fd() const { return -1; }
};

/// All lines off at first; but `shared`, the handle of the shared line when another process kept
/// it, stays as it is.
Opened<OutputLink> open_outputs(const OutputSettings& settings, UniqueFd shared = {});

}  // namespace drover::link
