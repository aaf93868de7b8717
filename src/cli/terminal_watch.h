// How late what a person types arrives here: the terminal is asked for its state again and again,
// and answers as fast as a key comes. Pure.
#pragma once

#include <string_view>

#include "drover/command.h"
#include "drover/time.h"

namespace drover::cli {

/// Of a terminal that never answers nothing is known, and nothing before its first answer: its keys
/// are late, as far as anybody can tell.
class TerminalWatch final {
 public:
  /// What is to be written to the terminal now; empty: nothing.
  std::string_view ask(Time now) {
    if (asked_ != kNever || (last_ != kNever && now - last_ < kEach)) return {};
    asked_ = last_ = now;
    if (first_ == kNever) first_ = now;
    return "\033[5n";
  }
  /// Takes the answer out of what is typed: true when `key` is part of one.
  bool take(char key, Time now) {
    constexpr std::string_view kAnswer = "\033[0n";
    if (key != kAnswer[matched_]) {
      matched_ = key == kAnswer[0] ? 1 : 0;
      return matched_ > 0;
    }
    if (++matched_ < kAnswer.size()) return true;
    matched_ = 0;
    if (asked_ != kNever) {
      took_ = now - asked_;
      typed_after_ = asked_;
    }
    answers_ = answers_ || asked_ != kNever;
    asked_ = kNever;
    return true;
  }
  /// A key that comes now was typed after this question: it comes behind the answer to it.
  bool counts(Time now) const { return answers_ && now - typed_after_ <= kKeyLate; }
  /// The line is too slow for keys.
  bool is_late(Time now) const { return !answers_ || delay(now) > kKeyLate; }
  /// It has had its time for a first answer.
  bool is_silent(Time now) const { return !answers_ && first_ != kNever && now - first_ > kFirst; }
  bool answers() const { return answers_; }
  /// There and back.
  Duration delay(Time now) const {
    return asked_ != kNever && now - asked_ > took_ ? now - asked_ : took_;
  }

 private:
  static constexpr Duration kEach = std::chrono::milliseconds(100);
  static constexpr Duration kFirst = std::chrono::seconds(2);

  Time asked_ = kNever;  ///< and not answered yet
  Time last_ = kNever;
  Time first_ = kNever;  ///< the first question
  Duration took_{0};
  Time typed_after_ = kNever;  ///< the last question that was answered
  std::size_t matched_ = 0;
  bool answers_ = false;
};

}  // namespace drover::cli
