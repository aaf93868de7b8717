// How many requests a source may make: a steady rate with a burst.
#pragma once

#include <algorithm>
#include <string>
#include <string_view>

#include "drover/time.h"
#include "text/number.h"

namespace drover::publish {

class TokenBucket final {
 public:
  TokenBucket(double rate_Hz, double burst) : rate_Hz_(rate_Hz), burst_(burst), tokens_(burst) {}

  bool empty(Time now) {
    refill(now);
    return tokens_ < 1;
  }
  /// False when there is none left.
  bool take(Time now) {
    if (empty(now)) return false;
    tokens_ -= 1;
    return true;
  }
  /// "10 requests a second are taken, and 20 at once", of "requests".
  std::string in_words(std::string_view what) const {
    return text::number_text(rate_Hz_) + " " + std::string(what) + " a second are taken, and " +
           text::number_text(burst_) + " at once";
  }
  /// What was let in has cost so much more: it may become a debt.
  void charge(double tokens, Time now) {
    refill(now);
    tokens_ -= tokens;
  }

 private:
  void refill(Time now) {
    if (last_ != kNever && now > last_) {
      tokens_ = std::min(burst_, tokens_ + to_s(now - last_) * rate_Hz_);
    }
    last_ = std::max(last_, now);
  }
  double rate_Hz_;
  double burst_;
  double tokens_;
  Time last_ = kNever;
};

}  // namespace drover::publish
