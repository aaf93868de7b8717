// The control loop's way to its links: what they hear goes to the gateway, what it says to them,
// and what died goes back to the keeper.
#include <algorithm>
#include <cstring>

#include "runtime/clock.h"
#include "runtime/control_loop.h"
#include "runtime/departure.h"

namespace drover::runtime {

namespace {

using namespace std::chrono_literals;

/// The two clocks keep their distance except when somebody sets one: that is looked for in each
/// cycle. What changes slowly is how a clock is made to run right.
constexpr Duration kMeasureClocksEach = 100ms;
constexpr Duration kClockStep = 1ms;
/// Outputs are written when they change, and so often to learn whether their chip is still there.
constexpr Duration kWriteOutputsEach = 100ms;

}  // namespace

void ControlLoop::take_links(Time now) {
  for (auto& dead : going_back_)
    if (dead.opened()) give_back(dead);
  LinkHandover arrived;
  while (keeper_.take(arrived)) {
    const auto slot = arrived.slot;
    link_state_[slot].up = arrived.opened();
    link_state_[slot].reason = arrived.problem;
    if (slot == kOutputsSlot) {
      if (!arrived.opened()) continue;
      outputs_ = std::move(arrived.outputs);
      outputs_written_ = kNever;
      // It comes first in the order of Output, and so among the configured ones.
      static_assert(static_cast<int>(Output::enable_relay) == 0);
      apply(now, gateway::OutputsUp{config_.engine.output_configured[0] && outputs_->is_on(0)});
      continue;
    }
    const auto link = static_cast<LinkId>(slot);
    if (!arrived.opened()) {
      if (wire_of(slot) != Wire::levels) apply(now, gateway::LinkLost{link, arrived.problem});
      continue;
    }
    open_[slot].can = std::move(arrived.can);
    open_[slot].serial = std::move(arrived.serial);
    open_[slot].lines = std::move(arrived.lines);
    if (const auto& line = open_[slot]; line.serial)
      serial_.listen(slot, line.serial->fd(), line.baud);
    // Lines tell by their levels that they are there.
    if (wire_of(slot) != Wire::levels) apply(now, gateway::LinkUp{link});
  }
}

void ControlLoop::lose(std::size_t slot, int error, Time now) {
  auto& dead = going_back_[slot];
  dead.slot = slot;
  const auto name = link_state_[slot].name.view();
  if (error == 0) {
    dead.problem.format("%.*s: changes to %d baud", static_cast<int>(name.size()), name.data(),
                        dead.reopen_baud);
  } else {
    dead.reopen_baud = 0;
    dead.problem.format("%.*s: lost (%s)", static_cast<int>(name.size()), name.data(),
                        ::strerrordesc_np(error));
  }
  link_state_[slot].up = false;
  link_state_[slot].reason = dead.problem;
  // Not waited for any more: a descriptor that hung up is always ready and would spin the loop.
  if (slot == kOutputsSlot) {
    dead.outputs = std::move(outputs_);
  } else {
    auto& link = open_[slot];
    dead.can = std::move(link.can);
    dead.serial = std::move(link.serial);
    dead.lines = std::move(link.lines);
    // A line that comes back at another speed is not lost, and lines of levels have no words.
    const bool comes_back = wire_of(slot) == Wire::bytes && error == 0;
    const auto why = wire_of(slot) == Wire::levels ? Reason() : dead.problem;
    if (!comes_back) apply(now, gateway::LinkLost{static_cast<LinkId>(slot), why});
  }
  give_back(dead);
}

/// Closing a line that the serial thread still reads would let it read another one. What cannot go
/// yet is tried again in the next cycle.
void ControlLoop::give_back(LinkHandover& dead) {
  if (dead.serial && !serial_.leave(dead.slot)) return;
  (void)keeper_.give_back(dead);
}

/// No more at once than a line has room for: one that babbles must not hold the cycle for ever.
void ControlLoop::hear_streams(Time now) {
  serial_.clear_ready();
  bool more = false;
  for (std::size_t link = 0; link < open_.size(); ++link) {
    std::size_t taken = 0;
    for (; open_[link].serial && taken < SerialLoop::kRoom; ++taken) {
      if (!serial_.take(link, heard_)) break;
      link_state_[link].received += heard_.size;
      if (heard_.error != 0)
        lose(link, heard_.error, now);
      else
        apply(heard_.first, gateway::BytesHeard{static_cast<LinkId>(link), heard_.view()});
    }
    more |= taken == SerialLoop::kRoom;
  }
  if (more) serial_.go_on();
}

void ControlLoop::serve_stream(const StreamOutput& out, Time now) {
  auto& link = open_[out.link];
  if (!link.serial) return;
  const bool leaves = !out.moves || still_may_leave(now);
  if (!leaves) link.bytes_untaken += out.bytes.size();
  if (leaves && !out.bytes.empty()) {
    std::size_t taken = 0;
    if (!link.serial->write(out.bytes, taken)) return lose(out.link, link.serial->error(), now);
    link_state_[out.link].sent += taken;
    link.bytes_untaken += out.bytes.size() - taken;
  }
  if (out.reopen_baud == 0) return;
  // Setting a line's speed may block: the keeper does it.
  link.baud = static_cast<int>(out.reopen_baud);
  going_back_[out.link].reopen_baud = link.baud;
  lose(out.link, 0, now);
}

/// A line in `edged` is told at its other level first: a pulse that is over already counts too.
void ControlLoop::read_lines(std::size_t link, Time now,
                             const std::array<bool, link::kMaxLines>& edged) {
  const auto& lines = open_[link].lines;
  if (!lines) return apply(now, gateway::LinkLost{static_cast<LinkId>(link), {}});
  std::array<bool, link::kMaxLines> levels{};
  if (!lines->read(levels)) return lose(link, lines->error(), now);
  const bool pulses = std::find(edged.begin(), edged.end(), true) != edged.end();
  if (pulses) {
    auto before = levels;
    for (std::size_t i = 0; i < line_count(link); ++i) before[i] = levels[i] != edged[i];
    apply_levels(link, before, now);
  }
  apply_levels(link, levels, now);
}

void ControlLoop::apply_levels(std::size_t link, const std::array<bool, link::kMaxLines>& levels,
                               Time now) {
  gateway::LevelsRead read;
  read.link = static_cast<LinkId>(link);
  for (std::size_t i = 0; i < line_count(link); ++i) (void)read.levels.push_back(levels[i]);
  apply(now, read);
}

void ControlLoop::write_outputs(const std::array<bool, kOutputCount>& on, Time now) {
  if (!outputs_) return;
  std::array<bool, kOutputCount> levels{};  // of the configured ones, in the order of Output
  std::size_t count = 0;
  for (std::size_t i = 0; i < kOutputCount; ++i)
    if (config_.engine.output_configured[i]) levels[count++] = on[i];
  if (levels == output_levels_ && now - outputs_written_ < kWriteOutputsEach) return;
  output_levels_ = levels;
  outputs_written_ = now;
  if (!outputs_->write({levels.data(), count})) lose(kOutputsSlot, outputs_->error(), now);
}

void ControlLoop::drain_can(Time now) {
  link::StampWindow window{previous_drain_, now, wall_minus_monotonic()};
  const bool stepped =
      std::chrono::abs(window.wall_minus_monotonic - wall_minus_monotonic_) > kClockStep;
  if (stepped) window.before_step = wall_minus_monotonic_;
  if (stepped || now - clocks_measured_ >= kMeasureClocksEach) {
    clocks_measured_ = now;
    wall_minus_monotonic_ = window.wall_minus_monotonic;
  } else {
    window.wall_minus_monotonic = wall_minus_monotonic_;
  }
  previous_drain_ = now;
  constexpr int kMostBatches = 64;  // a babbling bus must not hold the cycle for ever
  for (std::size_t bus = 0; bus < gateway_.bus_count(); ++bus) {
    const auto& can = open_[bus].can;
    for (int i = 0; i < kMostBatches && can; ++i) {
      const auto clamped = can->counters().clamped_stamps;
      if (!can->receive(window, batch_)) {
        lose(bus, can->error(), now);
        break;
      }
      // Somebody has set a clock.
      if (can->counters().clamped_stamps != clamped) clocks_measured_ = kNever;
      for (const auto& received : batch_)
        apply(received.received, gateway::FrameHeard{static_cast<LinkId>(bus), received.frame});
      if (batch_.size() < batch_.capacity()) break;
    }
  }
}

/// Looks at guard and clock just before the system call: what was decided before a hold-up must
/// not move wheels that the guard has stopped meanwhile.
bool ControlLoop::still_may_leave(Time decided) const {
  const Time now = monotonic_now();
  return may_leave({decided, guard_watch_.holds(decided)},
                   {now, guard_watch_.holds(guard_signs(), now)}, tick_);
}

void ControlLoop::send(std::size_t bus, std::span<const CanFrame> frames, Time decided) {
  auto& can = *open_[bus].can;
  while (!frames.empty()) {
    const auto count = std::min(frames.size(), link::FrameBatch::capacity());
    if (!still_may_leave(decided)) {
      stats_.late_frames += frames.size();
      break;
    }
    if (!can.send(frames.first(count))) return lose(bus, can.error(), decided);
    frames = frames.subspan(count);
  }
  const auto& counters = can.counters();
  apply(decided,
        gateway::FramesSent{static_cast<LinkId>(bus), counters.sent, counters.send_refused});
}

void ControlLoop::take_slow_links() {
  BatteryTold told;
  for (const auto& slow : slow_)
    while (slow->exchange.told.pop(told))
      std::visit([&](const auto& what) { apply(told.time, what); }, told.what);
}

}  // namespace drover::runtime
