// What the guard has to say, on standard error, by a thread that may block as long as it likes: a
// full pipe, a terminal that was stopped or a dead log reader hold up nobody but that thread.
#pragma once

#include <pthread.h>

#include <atomic>
#include <cstdint>

#include "drover/fixed_text.h"
#include "drover/spsc_ring.h"

namespace drover::guard {

class Speech final {
 public:
  /// Starts the thread; it ends with the program. Without one (no memory) nothing is said.
  Speech();
  Speech(const Speech&) = delete;
  Speech& operator=(const Speech&) = delete;

  /// One line, without its end. Never waits: what there is no room for is dropped and counted.
  [[gnu::format(printf, 2, 3)]] void say(const char* pattern, ...);
  /// Lines that were dropped so far.
  std::uint64_t unsaid() const { return unsaid_; }

 private:
  using Line = FixedText<240>;
  static void* write_lines(void* self);

  SpscRing<Line, 64> lines_;
  int wake_ = -1;  ///< counts the lines for the thread
  std::uint64_t unsaid_ = 0;
  std::uint64_t told_ = 0;  ///< of those, how many were told afterwards
};

}  // namespace drover::guard
