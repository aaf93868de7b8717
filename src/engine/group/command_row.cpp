// The row of commands that a joint is sent: when they came, and whether without a gap.
#include "engine/group/command_row.h"

#include <algorithm>

namespace drover::engine {
namespace {

using namespace std::chrono_literals;

constexpr Duration kSteadyFor = 300ms;
/// Whoever was stopped has to be silent for so long before he begins again.
constexpr Duration kPause = 1s;

}  // namespace

void CommandRow::take(const JointTarget& target, Time now) {
  overhear(now);
  if (!goes_on(now)) {
    gap_ = !was_taken() || now - taken_ >= kPause ? Duration{} : now - taken_;
    since_ = now;
  }
  taken_ = now;
  target_ = target;
}

void CommandRow::overhear(Time now) {
  if (was_sent() && now - said_ >= kPause) must_pause_ = false;
  said_ = now;
}

bool CommandRow::is_steady(Time now) const {
  return goes_on(now) && now - since_ >= std::max(kSteadyFor, timeout_);
}

bool CommandRow::is_over(Time now) const {
  const Time last = was_taken() ? taken_ : said_;
  return last != kNever && now - last >= kPause;
}

}  // namespace drover::engine
