// Stops that come on two connections, each on its own time: answered once, and not overtaken by a
// start. Pure.
#pragma once

#include <algorithm>
#include <deque>
#include <optional>
#include <string>
#include <string_view>

#include "drover/time.h"

namespace drover::runtime {

/// How a stop came: with all other commands, or on the connection that hears nothing else.
enum class Way { with_others, alone };

class HeardTwice final {
 public:
  /// A stop of this text came. When it came the other way before, and was answered then: when that
  /// was. Alone it is never far behind the others, so what came with them long ago was another one.
  std::optional<Time> again(Way way, std::string_view text, Time now) {
    std::erase_if(open_, [now](const Heard& one) { return now - one.time > kForgotten; });
    const auto other = std::find_if(open_.begin(), open_.end(), [&](const Heard& one) {
      return one.way != way && one.text == text &&
             (way == Way::with_others || now - one.time <= kBehindOthers);
    });
    if (other != open_.end()) {
      const Time first = other->time;
      open_.erase(other);
      return first;
    }
    open_.push_back({way, std::string(text), now});
    if (open_.size() > kMost) open_.pop_front();
    return std::nullopt;
  }
  /// The connection with all others is a new one: what was heard alone before will not come there.
  void begin_anew() {
    std::erase_if(open_, [](const Heard& one) { return one.way == Way::alone; });
  }
  /// Whether a stop came with the others just now whose other self is still to come.
  bool expects(Time now) const {
    return std::any_of(open_.begin(), open_.end(), [now](const Heard& one) {
      return one.way == Way::with_others && now - one.time <= kBehindOthers;
    });
  }
  /// One was heard alone that nobody could keep.
  void lost(Time now) { lost_ = now; }
  /// Whether a stop was heard alone of late that has not come with the others: whatever comes there
  /// now may have been sent before it.
  bool overtook(Time now) const {
    if (lost_ != kNever && now - lost_ <= kYounger) return true;
    return std::any_of(open_.begin(), open_.end(), [now](const Heard& one) {
      return one.way == Way::alone && now - one.time <= kYounger;
    });
  }

 private:
  static constexpr Duration kForgotten = std::chrono::seconds(60);
  /// Longer than a broker may be late unnoticed, see BrokerDelay. The broker may have dropped it.
  static constexpr Duration kYounger = std::chrono::seconds(2);
  static constexpr Duration kBehindOthers = std::chrono::milliseconds(500);
  static constexpr std::size_t kMost = 256;

  struct Heard {
    Way way;
    std::string text;
    Time time;
  };
  Time lost_ = kNever;
  std::deque<Heard> open_;  ///< came one way only so far, oldest first
};

}  // namespace drover::runtime
