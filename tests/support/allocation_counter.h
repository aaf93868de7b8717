// Counts heap allocations of this thread, for tests of code that must make none.
#pragma once

#include <cstdint>

namespace drover::test {

/// Linking this replaces the global operator new of the test program by a counting one.
///   AllocationCounter counter;  driver.on_tick(...);  EXPECT_EQ(counter.count(), 0U);
class AllocationCounter {
 public:
  AllocationCounter() : start_(total()) {}
  /// Allocations by operator new in this thread since construction.
  std::uint64_t count() const { return total() - start_; }
  static std::uint64_t total();

 private:
  std::uint64_t start_;
};

}  // namespace drover::test
