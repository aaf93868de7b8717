// Stops that come on two connections, each on its own time: answered once, and not overtaken by a
// start. Pure.
#pragma once

#include <algorithm>
#include <deque>
#include <string>
#include <string_view>

#include "drover/time.h"

namespace drover::runtime {

/// How a stop came: with all other commands, or on the connection that hears nothing else.
enum class Way { with_others, alone };

class HeardTwice final {
 public:
  /// A stop of this text came. True: it came the other way before, and was answered then.
  bool again(Way way, std::string_view text, Time now) {
    std::erase_if(open_, [now](const Heard& one) { return now - one.time > kForgotten; });
    const auto other = std::find_if(open_.begin(), open_.end(), [&](const Heard& one) {
      return one.way != way && one.text == text;
    });
    if (other != open_.end()) {
      open_.erase(other);
      return true;
    }
    open_.push_back({way, std::string(text), now});
    if (open_.size() > kMost) open_.pop_front();
    return false;
  }
  /// Whether a stop was heard alone of late that has not come with the others: whatever comes there
  /// now may have been sent before it.
  bool overtook(Time now) const {
    return std::any_of(open_.begin(), open_.end(), [now](const Heard& one) {
      return one.way == Way::alone && now - one.time <= kYounger;
    });
  }

 private:
  static constexpr Duration kForgotten = std::chrono::seconds(60);
  /// Longer than a broker may be late unnoticed, see BrokerDelay. The broker may have dropped it.
  static constexpr Duration kYounger = std::chrono::seconds(2);
  static constexpr std::size_t kMost = 256;

  struct Heard {
    Way way;
    std::string text;
    Time time;
  };
  std::deque<Heard> open_;  ///< came one way only so far, oldest first
};

}  // namespace drover::runtime
