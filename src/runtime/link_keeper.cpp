#include "runtime/link_keeper.h"

#include <fcntl.h>
#include <poll.h>

#include <algorithm>
#include <utility>

#include "runtime/clock.h"
#include "runtime/log.h"

namespace drover::runtime {

namespace {
std::vector<link::OutputLine> output_lines(const config::OutputsConfig& outputs) {
  std::vector<link::OutputLine> lines;
  for (const auto& output : outputs.output)
    if (output.configured) lines.push_back({output.name, output.active_low});
  return lines;
}

/// The place of the enable relay among the output lines; -1: there is none.
int relay_place(const config::OutputsConfig& outputs) {
  int place = 0;
  for (std::size_t i = 0; i < static_cast<std::size_t>(Output::enable_relay); ++i)
    place += outputs.output[i].configured ? 1 : 0;
  return outputs.output[static_cast<std::size_t>(Output::enable_relay)].configured ? place : -1;
}

/// Under this name the guard keeps the relay's line: another line is another name.
std::string relay_name(const config::OutputsConfig& outputs) {
  if (relay_place(outputs) < 0) return {};
  const auto& relay = outputs.output[static_cast<std::size_t>(Output::enable_relay)];
  return "relay " + outputs.chip + " " + relay.name + (relay.active_low ? " low" : "");
}
}  // namespace

LinkKeeper::LinkKeeper(const config::DroverConfig& config, const Wiring& wiring,
                       const GuardMemory& memory, std::vector<gateway::LinkDuty> duties)
    : config_(config),
      wiring_(wiring),
      duties_(std::move(duties)),
      guard_signs_(memory.shared()),
      guard_(config.guard.socket, config.guard.limit_ms, memory),
      relay_name_(relay_name(config.outputs)) {
  for (std::size_t i = 0; i < wiring.links.size(); ++i) {
    slots_[i].used = wiring.links[i].wire != Wire::registers;
    slots_[i].baud = settings_of(i).baud;
  }
  slots_[kOutputsSlot].used = !output_lines(config.outputs).empty();
  watchdog_.used = config.outputs.watchdog.configured;
}

const config::LinkConfig& LinkKeeper::settings_of(std::size_t slot) const {
  return config_.links[wiring_.links[slot].place];
}

std::vector<std::string> LinkKeeper::line_names(std::size_t slot) const {
  std::vector<std::string> names;
  for (const auto id : wiring_.links[slot].slots)
    names.push_back(config_.devices[wiring_.slots[id].place].line);
  return names;
}

bool LinkKeeper::give_back(LinkHandover& lost) {
  if (!losses_.push(std::move(lost))) return false;
  wake_.notify();
  return true;
}

void LinkKeeper::run(const std::atomic<bool>& stop) {
  while (!stop.load(std::memory_order_relaxed)) {
    turns_.fetch_add(1, std::memory_order_relaxed);
    const Time now = monotonic_now();
    take_back_lost();
    open_missing(now);
    supply_guard(now);
    hand_on(now);  // only then: what the guard cannot stop is not to be moved
    supply_watchdog(now);
    supply_relay();
    if (hand_back_wanted_.exchange(false, std::memory_order_relaxed)) guard_.hand_back();

    std::array<pollfd, 2> fds{{{wake_.fd(), POLLIN, 0}, {guard_.fd(), POLLIN | POLLHUP, 0}}};
    const auto wait = std::chrono::ceil<std::chrono::milliseconds>(until_next_try(now));
    ::poll(fds.data(), guard_.connected() ? 2 : 1, static_cast<int>(wait.count()));
    wake_.clear();
    if (guard_.connected() && fds[1].revents != 0) {  // the guard never talks: it went away
      guard_.disconnect();
      guard_set_changed_ = true;
      relay_given_ = false;
      watchdog_.open = false;
      log(LogLevel::error, "drover-guard is gone: nothing may move until it is back");
    }
  }
}

Duration LinkKeeper::until_next_try(Time now) const {
  Duration wait = std::chrono::seconds(1);
  for (const auto& slot : slots_)
    if (slot.used && !slot.open) wait = std::min(wait, slot.retry.next() - now);
  if (guard_set_changed_ || !guard_.supplied())
    wait = std::min(wait, guard_slot_.retry.next() - now);
  if (watchdog_.used) wait = std::min(wait, watchdog_try_ - now);
  return std::max(wait, Duration(std::chrono::milliseconds(1)));
}

void LinkKeeper::take_back_lost() {
  LinkHandover lost;
  while (losses_.pop(lost)) {
    auto& slot = slots_[lost.slot];
    slot.open = false;
    slot.retry.try_now();
    // The guard keeps its own way there: a set without this line would lack what it has to stop,
    // and whatever else moves would stand until a person comes.
    if (is_guarded_tty(lost.slot)) forget_tty(lost.slot);
    if (lost.slot == kOutputsSlot) forget_relay();
    if (lost.reopen_baud > 0) slot.baud = lost.reopen_baud;
    log(lost.reopen_baud > 0 ? LogLevel::info : LogLevel::error, lost.problem.view());
    lost = {};  // closes: at once, or the device comes back under another name
  }
}

link::CanSettings LinkKeeper::can_settings(std::size_t bus) const {
  link::CanSettings settings;
  settings.interface = settings_of(bus).can;
  settings.frames_per_cycle = std::max<std::size_t>(duties_[bus].messages_per_cycle, 4);
  return settings;
}

LinkHandover LinkKeeper::open(std::size_t slot, std::string& problem) {
  LinkHandover handover;
  handover.slot = slot;
  const auto take = [&problem](auto opened, auto& into) {
    into = std::move(opened.link);
    problem = std::move(opened.problem);
  };
  if (slot == kOutputsSlot) {
    take(open_outputs(), handover.outputs);
    return handover;
  }
  switch (wiring_.links[slot].wire) {
    case Wire::can: take(link::open_can(can_settings(slot)), handover.can); break;
    case Wire::bytes: take(open_stream(slot), handover.serial); break;
    case Wire::levels:
      take(link::open_lines({settings_of(slot).gpio, line_names(slot)}), handover.lines);
      break;
    case Wire::registers: break;
  }
  return handover;
}

/// The guard may have kept the relay's line closed since before this daemon began: it is taken over
/// as it is. Opened anew it would fall, and could not be, while the guard has it.
link::Opened<link::OutputLink> LinkKeeper::open_outputs() {
  const auto& outputs = config_.outputs;
  const int place = relay_place(outputs);
  link::UniqueFd kept;
  if (place >= 0 && guard_.reach()) kept = borrow(relay_name_);
  auto opened = link::open_outputs({outputs.chip, output_lines(outputs), place}, std::move(kept));
  relay_given_ = false;
  if (opened.link && opened.link->shared_fd() >= 0)
    relay_ = link::UniqueFd(::fcntl(opened.link->shared_fd(), F_DUPFD_CLOEXEC, 0));
  return opened;
}

/// A tty has one open file, which both programs share. The guard may have kept it since before this
/// daemon began: opened anew it would be busy.
link::Opened<link::SerialLink> LinkKeeper::open_stream(std::size_t slot) {
  const link::SerialSettings settings{settings_of(slot).serial, slots_[slot].baud};
  if (!is_guarded_tty(slot)) return link::open_serial(settings);
  const std::string name(wiring_.links[slot].name);
  link::Opened<link::SerialLink> opened;
  if (auto kept = guard_.reach() ? borrow(name) : link::UniqueFd()) {
    opened = link::adopt_serial(settings, std::move(kept));
    if (opened.link)
      log(LogLevel::info, settings.path + ": taken back from drover-guard");
    else
      guard_.let_go(name);
  }
  if (!opened.link) opened = link::open_serial(settings);
  if (opened.link) slots_[slot].tty = opened.link->duplicate();
  return opened;
}

/// Buses first: who opens what the guard may have kept waits for its answer.
void LinkKeeper::open_missing(Time now) {
  for (const bool buses : {true, false}) {
    for (std::size_t i = 0; i < kLinkSlots; ++i) {
      const auto& slot = slots_[i];
      if (is_bus(i) == buses && slot.used && !slot.open && slot.retry.due(now)) try_open(i, now);
    }
  }
}

void LinkKeeper::try_open(std::size_t slot, Time now) {
  std::string problem;
  auto handover = open(slot, problem);
  if (!handover.opened()) return failed(slot, problem, now);
  slots_[slot].open = true;
  slots_[slot].guard_lacks.clear();
  if (is_guarded(slot)) guard_set_changed_ = true;
  opened_.push_back(std::move(handover));
}

void LinkKeeper::hand_on(Time now) {
  for (auto& handover : opened_) {
    const auto slot = handover.slot;
    const std::string lacks = guard_.connected() ? slots_[slot].guard_lacks : std::string();
    if (is_guarded(slot) && !lacks.empty()) {
      slots_[slot].open = false;
      if (is_guarded_tty(slot)) forget_tty(slot);
      failed(slot, lacks, now);
      continue;  // closes it with all the others
    }
    if (is_guarded(slot) && guard_set_changed_)
      guard_equipped_.store(false, std::memory_order_relaxed);
    if (!arrivals_.push(std::move(handover))) {
      slots_[slot].open = false;
      failed(slot, "the control thread is busy", now);
      continue;
    }
    slots_[slot].problem.clear();
    const bool levels = slot != kOutputsSlot && wiring_.links[slot].wire == Wire::levels;
    const auto name = slot == kOutputsSlot ? "gpio " + config_.outputs.chip + " (outputs)"
                      : levels             ? "gpio " + settings_of(slot).gpio
                                           : config::address(settings_of(slot));
    log(LogLevel::info, name + ": open");
  }
  opened_.clear();
}

void LinkKeeper::failed(std::size_t slot, const std::string& problem, Time now) {
  auto& s = slots_[slot];
  s.retry.tried(now);
  if (problem == s.problem) return;  // said once, not at every try
  s.problem = problem;
  log(LogLevel::warning, problem);
  tell(slot);
}

/// Why there is no link, to the control thread.
void LinkKeeper::tell(std::size_t slot) {
  LinkHandover report;
  report.slot = slot;
  report.problem.assign(slots_[slot].problem + (slots_[slot].guard_reaches
                                                    ? ""
                                                    : "; drover-guard has no way there either"));
  (void)arrivals_.push(std::move(report));
}

}  // namespace drover::runtime
