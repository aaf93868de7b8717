// Tells the journal when something begins to be wrong and when it is over.
#include "engine/health/announcer.h"

namespace drover::engine {
namespace {

constexpr Duration kAtMostEach = std::chrono::seconds(1);
/// Nothing was heard yet in the first moments: that is no news, unless it stays so.
constexpr Duration kQuietStart = std::chrono::seconds(1);

}  // namespace

void Announcer::update(Time now, const HealthReport& report, EventQueue& events) {
  if (begun_ == kNever) begun_ = now;
  if (now - begun_ < kQuietStart) return;
  for (const CauseRow& row : kCauses) {
    const bool holds = report.holds(row.cause);
    Time& told_at = told_at_[static_cast<std::size_t>(row.cause)];
    if (holds == ((told_ & bit(row.cause)) != 0)) continue;
    if (holds && now - told_at < kAtMostEach) continue;
    told_ ^= bit(row.cause);
    if (holds) told_at = now;
    const auto level = !holds       ? Notice::Level::info
                       : row.severe ? Notice::Level::error
                                    : Notice::Level::warning;
    events.notice(now, level, holds ? report.text(row.cause) : Reason(row.over));
  }
}

}  // namespace drover::engine
