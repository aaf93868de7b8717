// Resolves a host's name where nobody waits: a name server that is gone holds up whoever asks it
// for as long as it likes (20 s and more).
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "link/unique_fd.h"

namespace drover::runtime {

class NameLookup final {
 public:
  struct Answer {
    std::vector<std::string> addresses;  ///< numeric, in the resolver's order
    std::string problem;                 ///< why there are none
  };

  /// Asks in a thread of its own, which nobody ever joins. No-op while one is under way.
  void ask(const std::string& host);
  bool under_way() const { return static_cast<bool>(answer_); }
  /// Once, when the answer has come; never waits.
  std::optional<Answer> take();

 private:
  link::UniqueFd answer_;  ///< the thread writes into its other end, and ends
  std::string text_;
};

/// Whether `host` is an address already, or the path of a socket: nothing to resolve.
bool is_numeric(const std::string& host);

}  // namespace drover::runtime
