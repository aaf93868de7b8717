#include "drivers/drives.h"

#include <algorithm>

namespace drover {
namespace {

constexpr Duration kForeignShown = std::chrono::milliseconds(1000);

}  // namespace

bool ToldStatus::is_due(const StatusInWords& current, bool always) {
  const bool changed = !told_once_ || current.state != told_.state ||
                       current.error_code != told_.error_code || current.lapsed != told_.lapsed ||
                       current.powered != told_.powered || !(current.reason == told_.reason);
  if (!changed) return always;
  told_once_ = true;
  told_ = current;
  return true;
}

Reason silent_text(std::string_view what, Time last, Time now) {
  Reason text;
  const int size = static_cast<int>(what.size());
  if (last == kNever) {
    text.format("%.*s since the link came up", size, what.data());
  } else {
    text.format("%.*s for %.2f s", size, what.data(), to_s(now - last));
  }
  return text;
}

Reason silent_text(std::string_view what, Duration limit) {
  Reason text;
  text.format("%.*s for more than %.1f s", static_cast<int>(what.size()), what.data(), to_s(limit));
  return text;
}

Reason joined(const Reason& lost, const Reason& why) {
  if (lost.empty() || why.empty()) return lost.empty() ? why : lost;
  Reason text;
  text.format("%.*s: %.*s", static_cast<int>(lost.view().size()), lost.view().data(),
              static_cast<int>(why.view().size()), why.view().data());
  return text;
}

SourceHealth Heard::health(Time now, std::string_view never, std::string_view what,
                           Duration limit) const {
  SourceHealth health;
  health.last_good = last_good;
  health.good = good;
  health.bad = bad;
  if (last_good == kNever) {
    health.reason.assign(never);
  } else if (last_alive == kNever || now - last_alive > limit) {
    return stale(health, silent_text(what, last_alive, now));
  } else {
    health.state = SourceState::fresh;
  }
  return health;
}

SourceHealth stale(SourceHealth health, const Reason& reason) {
  health.state = SourceState::stale;
  health.reason = reason;
  return health;
}

bool is_of_recipe(const CanFrame& frame, const StopRecipe& recipe) {
  return std::any_of(recipe.rounds.begin(), recipe.rounds.end(), [&](const StopRound& round) {
    return std::find(round.frames.begin(), round.frames.end(), frame) != round.frames.end();
  });
}

bool ForeignCommand::is_shown(Time now) const {
  return at_ != kNever && now - at_ <= kForeignShown;
}

Reason ForeignCommand::text() const {
  Reason text;
  text.format("somebody else commands it: id 0x%03X on the bus", static_cast<unsigned>(id_));
  return text;
}

}  // namespace drover
