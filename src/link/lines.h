// Digital inputs: levels that are read each control cycle, and a descriptor that wakes at an edge.
#pragma once

#include <array>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "link/opened.h"

namespace drover::link {

inline constexpr std::size_t kMaxLines = 16;
/// Who holds a line, as gpioinfo shows it.
inline constexpr const char* kConsumer = "droverd";
/// Before a folder that stands for a chip.
inline constexpr std::string_view kFilesPrefix = "files:";

/// The seam between the two kinds of lines.
class LineLink {
 public:
  virtual ~LineLink() = default;
  /// Electrical levels (true: high), in the order of the settings. False when the chip is gone.
  /// Called once a cycle and after drain_edges(). A line that tells its edges may be believed to be
  /// as it was for some cycles without one.
  [[nodiscard]] virtual bool read(std::array<bool, kMaxLines>& levels) = 0;
  /// Descriptors that become readable at an edge; empty when there is none.
  virtual std::span<const int> edge_fds() const = 0;
  /// Takes waiting edges off the descriptors and marks the lines that had one: such a line was at
  /// its other level too, however short, whatever is read afterwards.
  virtual void drain_edges(std::array<bool, kMaxLines>& edged) = 0;
  virtual int error() const = 0;
};

struct LineSettings {
  std::string chip;                ///< label or name of the chip, or "files:DIRECTORY"
  std::vector<std::string> lines;  ///< line names, or file names
};

Opened<LineLink> open_lines(const LineSettings& settings);
Opened<LineLink> open_gpio_lines(const LineSettings& settings);
/// Files whose first byte is '0' or '1': for hosts without GPIO.
Opened<LineLink> open_file_lines(const LineSettings& settings);

}  // namespace drover::link
