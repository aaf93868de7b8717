// A CAN log that no driver reads: how many frames of each id, and how often.
#pragma once

#include <cstdint>
#include <iosfwd>
#include <map>
#include <string>
#include <tuple>

#include "cli/candump.h"

namespace drover::cli {

class CanTable final {
 public:
  void add(const LoggedFrame& frame);
  std::uint64_t frames() const { return frames_; }
  /// A line, or a JSON object, for each id of each bus. The rate is absent for a single frame.
  void print(std::ostream& out, bool json) const;

 private:
  struct Row {
    std::uint64_t count = 0;
    Time first = kNever;
    Time last = kNever;
    CanFrame frame;  ///< the last one
  };
  using Key = std::tuple<std::string, bool, bool, std::uint32_t>;  ///< bus, error, extended, id
  std::map<Key, Row> rows_;
  std::uint64_t frames_ = 0;
};

}  // namespace drover::cli
