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

Duration CommandRow::steady_for() const {
  return std::max(kSteadyFor, timeout_);
}

/// After a row that was steady, or before another's first, a silence is no sender's pace.
Duration CommandRow::gap_before(Time now) const {
  const bool none = !was_taken() || now - taken_ >= kPause || changed_hands_;
  return none || taken_ - since_ >= steady_for() ? Duration{} : now - taken_;
}

void CommandRow::change_hands() {
  changed_hands_ = true;
  gap_ = {};
}

void CommandRow::take(const JointTarget& target, Time now) {
  overhear(now);
  if (!goes_on(now)) {
    gap_ = gap_before(now);
    since_ = now;
  }
  changed_hands_ = false;
  taken_ = now;
  target_ = target;
}

void CommandRow::overhear(Time now) {
  if (was_sent() && now - said_ >= kPause) must_pause_ = false;
  said_ = now;
}

bool CommandRow::is_steady(Time now) const {
  return goes_on(now) && now - since_ >= steady_for();
}

bool CommandRow::is_over(Time now) const {
  const Time last = was_taken() ? taken_ : said_;
  return last != kNever && now - last >= kPause;
}

}  // namespace drover::engine
