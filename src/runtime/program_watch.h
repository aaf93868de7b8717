// The control thread's view of the rest of the daemon: what the main thread reports of the others,
// and whether the main thread itself still looks.
#pragma once

#include <cstdint>

#include "drover/fixed_text.h"
#include "drover/time.h"

namespace drover::runtime {

class ProgramWatch final {
 public:
  /// The main thread looks each 0.1 s; without it nobody hears SIGTERM and nobody watches.
  static constexpr Duration kMainLimit = std::chrono::milliseconds(800);
  /// An orderly stop is over by then, at any speed that the base may have.
  static constexpr Duration kLongestStop = std::chrono::seconds(3);

  /// Each cycle: `reported` as the main thread's report (nullptr: all is well), `looks` its
  /// counter. True when why() changed.
  bool update(const char* reported, std::uint64_t looks, Time now) {
    // Whoever was held up himself judges nobody.
    if (updated_ != kNever && now - updated_ > kHeldUp) looked_ += now - updated_;
    updated_ = now;
    if (looks != looks_) {
      looks_ = looks;
      looked_ = now;
    }
    const bool main_stands = looks_ != 0 && now - looked_ > kMainLimit;
    const char* why = main_stands ? "droverd's main thread stands still" : reported;
    if (why == why_) return false;
    if (why_ == nullptr) since_ = now;
    why_ = why;
    return true;
  }
  bool trouble() const { return why_ != nullptr; }
  /// Empty while all is well.
  Reason why() const { return why_ == nullptr ? Reason() : Reason(why_); }
  /// The heartbeat ends after the orderly stop, and so does the daemon's hold on the drives.
  bool leaves_to_guard(Time now, bool at_rest) const {
    constexpr Duration kLeast = std::chrono::milliseconds(200);  // the stop has begun by then
    return trouble() && (now - since_ > kLongestStop || (at_rest && now - since_ > kLeast));
  }

 private:
  static constexpr Duration kHeldUp = std::chrono::milliseconds(100);

  const char* why_ = nullptr;
  Time since_ = kNever;
  std::uint64_t looks_ = 0;
  Time looked_ = kNever;
  Time updated_ = kNever;
};

}  // namespace drover::runtime
