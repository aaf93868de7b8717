// What the links bring to the gateway: to the devices that listen there, and what those say of it.
#include <algorithm>

#include "gateway/gateway.h"

namespace drover::gateway {

std::span<const SlotId> Gateway::slots_on(LinkId link) const {
  if (link >= wiring_.links.size()) return {};
  return wiring_.links[link].slots;
}

[[gnu::hot]] void Gateway::on(const FrameHeard& heard, Time received) {
  const auto& [bus, frame] = heard;
  if (!is_bus(bus)) return;
  buses_[bus].on_frame(frame, received);
  if (frame.error) return;
  bool heard_by_one = false;
  listeners_[bus].each(frame, [&, &frame = frame](Listener listener) {
    heard_by_one = true;
    Slot& slot = wiring_.slots[listener.slot];
    if (listener.sends)
      notice_foreign(slot, frame, received);
    else
      slot.last_heard = received;
    slot.made.frames->on_frame(frame, received, scratch_);
    take(slot, received);
  });
  // What commands one of its devices is listened to as well: the guard is no stranger.
  if (!heard_by_one) buses_[bus].strangers().on_frame(frame, received);
}

/// A link does not hear what it sent itself. What moves, the driver notices.
void Gateway::notice_foreign(const Slot& slot, const CanFrame& frame, Time received) {
  for (const FrameRule& rule : slot.made.actuator->rules()) {
    if (!engine::matches(rule, frame)) continue;
    if (frame.remote || slot.made.actuator->effect(frame, received).kind != FrameEffect::stop)
      return;
    return foreign_.on_stop_frame(frame.id, buses_[slot.link].name(), received);
  }
}

void Gateway::on(const BytesHeard& heard, Time first_byte) {
  for (const SlotId id : slots_on(heard.link)) {
    Slot& slot = wiring_.slots[id];
    if (slot.made.bytes == nullptr) continue;
    slot.made.bytes->on_bytes(heard.bytes, first_byte, scratch_);
    take(slot, first_byte);
  }
}

void Gateway::on(const LevelsRead& read, Time at) {
  const auto slots = slots_on(read.link);
  for (std::size_t i = 0; i < slots.size() && i < read.levels.size(); ++i) {
    Slot& slot = wiring_.slots[slots[i]];
    if (slot.made.levels == nullptr) continue;
    slot.made.levels->on_level(read.levels[i], at, scratch_);
    take(slot, at);
  }
}

/// nullptr: it is not asked for such a block.
Slot* Gateway::asked(SlotId slot, std::size_t block) {
  if (slot >= wiring_.slots.size()) return nullptr;
  const auto* const registers = wiring_.slots[slot].made.registers;
  return registers != nullptr && block < registers->blocks().size() ? &wiring_.slots[slot]
                                                                    : nullptr;
}

void Gateway::on(const RegistersRead& read, Time received) {
  Slot* const slot = asked(read.slot, read.block);
  if (slot == nullptr) return;
  if (read.words.size() != slot->made.registers->blocks()[read.block].count) return;
  slot->made.registers->on_registers(read.block, read.words, received, scratch_);
  take(*slot, received);
}

void Gateway::on(const RegistersFailed& failed, Time at) {
  if (Slot* const slot = asked(failed.slot, failed.block))
    slot->made.registers->on_failure(failed.block, failed.failure, failed.exception, at);
}

void Gateway::on(const LinkUp& up, Time now) {
  if (is_bus(up.link)) buses_[up.link].on_up();
  if (up.link < wiring_.links.size()) wiring_.links[up.link].lost.clear();
  for (const SlotId id : slots_on(up.link)) wiring_.slots[id].made.device->on_link_up(now);
}

void Gateway::on(const LinkLost& lost, Time now) {
  if (is_bus(lost.link)) buses_[lost.link].on_lost(lost.why);
  if (is_line_of_bytes(lost.link)) wiring_.links[lost.link].lost = lost.why;
  for (const SlotId id : slots_on(lost.link)) {
    Slot& slot = wiring_.slots[id];
    if (slot.made.levels == nullptr) continue;
    slot.made.levels->on_lost(now, scratch_);
    take(slot, now);
  }
}

void Gateway::on(const FramesSent& counts, Time now) {
  if (is_bus(counts.bus)) buses_[counts.bus].on_sent(counts.sent, counts.refused, now);
}

/// As if every line had been pulled and plugged again.
void Gateway::on(const Suspended& slept, Time now) {
  for (std::size_t i = 0; i < wiring_.links.size(); ++i) {
    const auto link = static_cast<LinkId>(i);
    if (wiring_.links[i].wire == Wire::levels) {
      on(LinkLost{link, {}}, now);
    } else if (wiring_.links[i].lost.empty() && (!is_bus(i) || !buses_[i].lost())) {
      on(LinkUp{link}, now);
    }
  }
  woke_ = now;
  slept_.format("the computer slept for %.1f s", slept.lasted_s);
}

void Gateway::on(const HeldUp& held_up, Time now) {
  woke_ = now;
  slept_.format("droverd stood still for %.2f s, and nobody steered meanwhile", held_up.lasted_s);
}

}  // namespace drover::gateway
