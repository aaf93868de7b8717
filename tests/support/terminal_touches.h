// Counts how often this thread asks a terminal for bytes, for tests of threads that must not.
#pragma once

#include <cstdint>

namespace drover::test {

/// Linking this puts `read`, `poll` and `ppoll` of the test program before the C library's.
///   TerminalTouches touches;  loop.run(stop);  EXPECT_EQ(touches.count(), 0U);
class TerminalTouches {
 public:
  TerminalTouches() : start_(total()) {}
  /// Calls of this thread since construction that read a terminal or waited for one.
  std::uint64_t count() const { return total() - start_; }
  static std::uint64_t total();

 private:
  std::uint64_t start_;
};

}  // namespace drover::test
