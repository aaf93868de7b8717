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

constexpr std::size_t slot_of(Stream stream) {
  return kFirstStreamSlot + static_cast<std::size_t>(stream);
}

}  // namespace

Name ControlLoop::slot_name(std::size_t slot) const {
  if (slot == slot_of(Stream::gnss)) return config_.gnss.configured ? Name("gnss") : Name();
  if (slot == slot_of(Stream::imu)) return config_.imu.configured ? Name("imu") : Name();
  if (slot == kLinesSlot) return line_count_ > 0 ? Name("lines") : Name();
  if (slot == kOutputsSlot) {
    const auto& outputs = config_.engine.output_configured;
    return std::find(outputs.begin(), outputs.end(), true) != outputs.end() ? Name("outputs")
                                                                            : Name();
  }
  return slot < config_.buses.size() ? Name(config_.buses[slot].name) : Name();
}

LinkId ControlLoop::link_of(std::size_t slot) const {
  const auto& wiring = gateway_.wiring();
  if (slot == slot_of(Stream::gnss)) return wiring.link_of(SlotKind::gnss);
  if (slot == slot_of(Stream::imu)) return wiring.link_of(SlotKind::imu);
  if (slot == kLinesSlot) return wiring.link_of(SlotKind::line);
  return slot < gateway_.bus_count() ? static_cast<LinkId>(slot) : gateway::kNowhere;
}

void ControlLoop::take_links(Time now) {
  for (auto& dead : going_back_)
    if (dead.opened()) (void)keeper_.give_back(dead);
  LinkHandover arrived;
  while (keeper_.take(arrived)) {
    const auto slot = arrived.slot;
    link_state_[slot].up = arrived.opened();
    link_state_[slot].reason = arrived.problem;
    if (!arrived.opened()) {
      if (slot < kMaxBuses) apply(now, gateway::LinkLost{link_ids_[slot], arrived.problem});
      continue;
    }
    if (is_stream(slot)) {
      streams_[slot - kFirstStreamSlot] = std::move(arrived.serial);
      apply(now, gateway::LinkUp{link_ids_[slot]});
    } else if (slot == kOutputsSlot) {
      outputs_ = std::move(arrived.outputs);
      outputs_written_ = kNever;
      // It comes first in the order of Output, and so among the configured ones.
      static_assert(static_cast<int>(Output::enable_relay) == 0);
      apply(now, gateway::OutputsUp{config_.engine.output_configured[0] && outputs_->is_on(0)});
    } else if (slot == kLinesSlot) {
      lines_ = std::move(arrived.lines);
    } else {
      can_[slot] = std::move(arrived.can);
      apply(now, gateway::LinkUp{link_ids_[slot]});
    }
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
  if (is_stream(slot)) {
    dead.serial = std::move(streams_[slot - kFirstStreamSlot]);
  } else if (slot == kLinesSlot) {
    dead.lines = std::move(lines_);
    apply(now, gateway::LinkLost{link_ids_[slot], {}});
  } else if (slot == kOutputsSlot) {
    dead.outputs = std::move(outputs_);
  } else {
    dead.can = std::move(can_[slot]);
    apply(now, gateway::LinkLost{link_ids_[slot], dead.problem});
  }
  (void)keeper_.give_back(dead);
}

void ControlLoop::read_stream(std::size_t stream, Time now) {
  const auto slot = kFirstStreamSlot + stream;
  std::array<std::uint8_t, 1024> buffer{};
  std::size_t size = 0;
  if (!streams_[stream]->read(buffer, size)) return lose(slot, streams_[stream]->error(), now);
  if (size == 0) return;
  link_state_[slot].received += size;
  // The first byte came in before the last one: take the wire's time off.
  const Duration wire = from_s(10.0 * static_cast<double>(size - 1) / stream_baud_[stream]);
  apply(now - wire, gateway::BytesHeard{link_ids_[slot], {buffer.data(), size}});
}

void ControlLoop::serve_stream(const StreamOutput& out, Time now) {
  std::size_t stream = 0;
  while (stream < kStreamCount && link_ids_[kFirstStreamSlot + stream] != out.link) ++stream;
  if (stream == kStreamCount || !streams_[stream]) return;
  const auto slot = kFirstStreamSlot + stream;
  const bool leaves = !out.moves || still_may_leave(now);
  if (!leaves) bytes_untaken_[stream] += out.bytes.size();
  if (leaves && !out.bytes.empty()) {
    std::size_t taken = 0;
    if (!streams_[stream]->write(out.bytes, taken))
      return lose(slot, streams_[stream]->error(), now);
    link_state_[slot].sent += taken;
    bytes_untaken_[stream] += out.bytes.size() - taken;
  }
  if (out.reopen_baud == 0) return;
  // Setting a line's speed may block: the keeper does it.
  stream_baud_[stream] = static_cast<int>(out.reopen_baud);
  auto& dead = going_back_[slot];
  dead.reopen_baud = stream_baud_[stream];
  lose(slot, 0, now);
}

/// A line in `edged` is told at its other level first: a pulse that is over already counts too.
void ControlLoop::read_lines(Time now, const std::array<bool, link::kMaxLines>& edged) {
  if (line_count_ == 0) return;
  if (!lines_) return apply(now, gateway::LinkLost{link_ids_[kLinesSlot], {}});
  std::array<bool, link::kMaxLines> levels{};
  if (!lines_->read(levels)) return lose(kLinesSlot, lines_->error(), now);
  const bool pulses = std::find(edged.begin(), edged.end(), true) != edged.end();
  if (pulses) {
    auto before = levels;
    for (std::size_t i = 0; i < line_count_; ++i) before[i] = levels[i] != edged[i];
    apply_levels(before, now);
  }
  apply_levels(levels, now);
}

void ControlLoop::apply_levels(const std::array<bool, link::kMaxLines>& levels, Time now) {
  gateway::LevelsRead read;
  read.link = link_ids_[kLinesSlot];
  for (std::size_t i = 0; i < line_count_; ++i) (void)read.levels.push_back(levels[i]);
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
    for (int i = 0; i < kMostBatches && can_[bus]; ++i) {
      const auto clamped = can_[bus]->counters().clamped_stamps;
      if (!can_[bus]->receive(window, batch_)) {
        lose(bus, can_[bus]->error(), now);
        break;
      }
      // Somebody has set a clock.
      if (can_[bus]->counters().clamped_stamps != clamped) clocks_measured_ = kNever;
      for (const auto& received : batch_)
        apply(received.received, gateway::FrameHeard{link_ids_[bus], received.frame});
      if (batch_.size() < batch_.capacity()) break;
    }
  }
}

/// Looks at guard and clock just before the system call: what was decided before a hold-up must
/// not move wheels that the guard has stopped meanwhile.
bool ControlLoop::still_may_leave(Time decided) const {
  const bool holds = guard_.shared().guard_holds.load(std::memory_order_acquire) != 0;
  return may_leave({decided, guard_watch_.holds()}, {monotonic_now(), holds}, tick_);
}

void ControlLoop::send(std::size_t bus, std::span<const CanFrame> frames, Time decided) {
  auto& can = *can_[bus];
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
  apply(decided, gateway::FramesSent{link_ids_[bus], counters.sent, counters.send_refused});
}

void ControlLoop::take_battery() {
  if (battery_ == nullptr) return;
  BatteryTold told;
  while (battery_->told.pop(told))
    std::visit([&](const auto& what) { apply(told.time, what); }, told.what);
}

}  // namespace drover::runtime
