// The keeper's other half: what drover-guard needs to stop the drives by itself.
#include <fcntl.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <utility>

#include "runtime/clock.h"
#include "runtime/link_keeper.h"
#include "runtime/log.h"

namespace drover::runtime {

namespace {

/// The guard holds the line for as long as it lives; now and then it is looked whether it is free.
constexpr Duration kWatchdogPause = std::chrono::seconds(1);
}  // namespace

/// How the guard stops what hangs on it, also while it is not there.
GuardedLink LinkKeeper::guarded_link(std::size_t slot) {
  GuardedLink link;
  link.name = wiring_.links[slot].name;
  link.kind = is_bus(slot) ? GuardLinkKind::can : GuardLinkKind::tty;
  for (const auto& stop : duties_[slot].stops) {
    link.axes.push_back(guarded_axis(link.name, stop.recipe));
    link.axes.back().held_by_daemon = stop.held_by_daemon;
    link.axes.back().runs_on = stop.runs_on;
  }
  if (slots_[slot].open) open_for_guard(slot, link);
  return link;
}

void LinkKeeper::open_for_guard(std::size_t slot, GuardedLink& link) {
  std::string why;
  if (is_bus(slot)) {
    auto settings = can_settings(slot);
    settings.hears = false;
    link.descriptor = link::open_can_descriptor(settings, why);
  } else {
    link.descriptor = link::UniqueFd(::fcntl(slots_[slot].tty.get(), F_DUPFD_CLOEXEC, 0));
    if (!link.descriptor) why = link.name;
  }
  slots_[slot].guard_lacks =
      link.descriptor ? "" : "drover-guard cannot have its own way to " + why;
}

bool LinkKeeper::is_new(std::size_t slot) const {
  return std::any_of(opened_.begin(), opened_.end(),
                     [slot](const LinkHandover& one) { return one.slot == slot; });
}

/// Said where it is closed again, and not at every try.
bool LinkKeeper::refuses_new() const {
  return std::any_of(opened_.begin(), opened_.end(), [this](const LinkHandover& one) {
    return is_guarded(one.slot) && !slots_[one.slot].guard_lacks.empty();
  });
}

std::string LinkKeeper::lacking() const {
  for (std::size_t i = 0; i < wiring_.links.size(); ++i)
    if (slots_[i].open && !(is_guarded(i) && is_new(i)) && !slots_[i].guard_lacks.empty())
      return slots_[i].guard_lacks;
  return {};
}

/// A guard that hangs keeps no drive waiting: what obeys and is not heard is to be damped, or held,
/// before its time-out lets go. Nothing may be moved there until the guard has answered.
link::UniqueFd LinkKeeper::borrow(const std::string& name) {
  return guard_.borrow(name, [this] { hand_on(monotonic_now()); });
}

/// What it can reach now. It answers after it took, or refused, what it was handed before.
void LinkKeeper::ask_guard() {
  for (std::size_t i = 0; i < wiring_.links.size(); ++i) {
    if (!is_guarded(i)) continue;
    auto& slot = slots_[i];
    const std::string name(wiring_.links[i].name);
    const bool reaches = static_cast<bool>(borrow(name));
    if (!guard_.connected()) return;
    // What it refused is told by itself, and keeps the robot from moving until a person resets it.
    const bool refused = guard_signs_.set_refused.load(std::memory_order_relaxed) != 0;
    if (slot.open && !reaches && !refused && slot.guard_lacks.empty())
      slot.guard_lacks = "drover-guard did not take its way to " + name;
    const bool was = std::exchange(slot.guard_reaches, reaches);
    if (!slot.open && reaches != was && !slot.problem.empty()) tell(i);
  }
}

/// In words, by links.
std::string LinkKeeper::watched() const {
  std::string there;
  std::string absent;
  for (std::size_t i = 0; i < wiring_.links.size(); ++i) {
    if (!is_guarded(i)) continue;
    const auto& slot = slots_[i];
    const std::string name(wiring_.links[i].name);
    if (slot.open && slot.guard_lacks.empty())
      there += (there.empty() ? "" : ", ") + name;
    else if (slot.guard_reaches)
      absent += "; " + name + " is not there, and it keeps the way there that it has";
    else
      absent += "; " + name + " is not there, and it has no way there: nothing on it may move";
  }
  return (there.empty() ? "drover-guard has no line yet on which to stop anything"
                        : "drover-guard watches the drives (" + there + ")") +
         absent;
}

void LinkKeeper::supply_guard(Time now) {
  const bool supplied = !guard_set_changed_ && guard_.supplied();
  if (supplied || !guard_slot_.retry.due(now)) return;
  if (!guard_.supplied()) relay_given_ = false;
  std::vector<GuardedLink> links;
  for (std::size_t i = 0; i < wiring_.links.size(); ++i)
    if (is_guarded(i)) links.push_back(guarded_link(i));
  std::string problem;
  // What there is goes over at once; what is missing keeps the robot from moving.
  bool handed_over = guard_.hand_over(links, problem);
  if (handed_over) {
    ask_guard();
    problem = lacking();
    handed_over = guard_.connected();
    if (!handed_over) problem = "drover-guard does not answer";
  }
  guard_equipped_.store(problem.empty(), std::memory_order_relaxed);
  if (problem.empty()) {
    guard_set_changed_ = false;
    guard_slot_ = {};
    if (!refuses_new()) log(LogLevel::info, watched());
    return;
  }
  guard_slot_.retry.tried(now);
  if (problem != guard_slot_.problem) log(LogLevel::warning, problem);
  guard_slot_.problem = problem;
}

/// Both programs hold the line: one dead, it stays; both dead, it falls.
void LinkKeeper::supply_relay() {
  if (!relay_ || relay_given_ || !guard_.connected()) return;
  relay_given_ = guard_.give_relay_line(relay_name_, relay_.get());
}

/// Its chip is gone: a handle that somebody keeps is dead.
void LinkKeeper::forget_relay() {
  relay_.reset();
  if (!relay_name_.empty()) guard_.let_go(relay_name_);
}

/// It is dead. Whoever holds on to it keeps its name from coming back.
void LinkKeeper::forget_tty(std::size_t slot) {
  slots_[slot].tty.reset();
  guard_.let_go(std::string(wiring_.links[slot].name));
}

void LinkKeeper::supply_watchdog(Time now) {
  if (!watchdog_.used || !guard_.connected() || now < watchdog_try_) {
    if (watchdog_try_ <= now) watchdog_try_ = now + kWatchdogPause;
    return;
  }
  watchdog_try_ = now + kWatchdogPause;
  const auto& line = config_.outputs.watchdog;
  const auto opened = link::open_outputs({config_.outputs.chip, {{line.name, line.active_low}}});
  if (opened.link && opened.link->fd() < 0) {
    watchdog_.used = false;
    log(LogLevel::warning, "outputs.watchdog: a file is no line that the guard can pulse");
  } else if (opened.link && guard_.give_pulse_line(opened.link->fd())) {
    watchdog_.open = true;
    watchdog_.problem.clear();
    log(LogLevel::info, "drover-guard pulses the hardware watchdog's line");
  } else if (!opened.link && !watchdog_.open && opened.problem != watchdog_.problem) {
    watchdog_.problem = opened.problem;
    // The guard may have it from the droverd before this one.
    const bool busy = opened.problem.ends_with(std::strerror(EBUSY));
    log(busy ? LogLevel::info : LogLevel::warning,
        "outputs.watchdog: " + opened.problem +
            (busy ? ", as it is while drover-guard pulses it for the droverd before this one"
                  : ""));
  }
}

}  // namespace drover::runtime
