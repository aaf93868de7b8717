// A stop that came twice: two readers hear /e_stop, and a reliable writer is heard by both.
#pragma once

#include <cstdint>
#include <deque>

#include "drover/time.h"

namespace drover::ros2 {

/// Where a sample was heard.
enum class StopReader : std::uint8_t { any, sure };

/// Which sample: its writer, and when that says that it was said.
struct StopSample {
  std::uint64_t writer = 0;
  std::int64_t stamp_ns = 0;
  friend bool operator==(const StopSample&, const StopSample&) = default;
};

/// Each is a stop once, though the copy of the other reader comes later: a person who has reset the
/// first one would be stopped anew. Two of one reader are two stops, whatever they look like. Pure.
class StopCopies final {
 public:
  /// False: it is the other reader's copy of one that was a stop already.
  bool is_stop(StopReader reader, const StopSample& sample, Time now) {
    // DDS asks for what is missing within a moment; later it is another one that looks the same.
    constexpr Duration kTogether = std::chrono::seconds(5);
    constexpr std::size_t kMost = 256;
    while (!alone_.empty() && (now - alone_.front().heard > kTogether || alone_.size() >= kMost))
      alone_.pop_front();
    for (auto it = alone_.begin(); it != alone_.end(); ++it) {
      if (it->reader == reader || !(it->sample == sample)) continue;
      alone_.erase(it);
      return false;
    }
    alone_.push_back({reader, sample, now});
    return true;
  }

 private:
  struct Alone {
    StopReader reader;
    StopSample sample;
    Time heard;
  };
  std::deque<Alone> alone_;  ///< their copies have not come
};

}  // namespace drover::ros2
