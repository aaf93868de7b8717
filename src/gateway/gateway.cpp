#include "gateway/gateway.h"

#include <algorithm>

namespace drover::gateway {

namespace {

constexpr Duration kSleptTold = std::chrono::seconds(1);

}  // namespace

std::size_t StreamOutput::add(const DriverOut& out) {
  std::size_t dropped = 0;
  for (const auto byte : out.bytes) dropped += bytes.push_back(byte) ? 0 : 1;
  if (out.reopen_baud != 0) reopen_baud = out.reopen_baud;
  return dropped;
}

/// Half a packet would spoil the next one too.
std::size_t StreamOutput::add(const Packet& packet) {
  if (bytes.capacity() - bytes.size() < packet.size()) return packet.size();
  for (const auto byte : packet) (void)bytes.push_back(byte);
  return 0;
}

Gateway::Gateway(const config::DroverConfig& config)
    : engine_(config.engine),
      wiring_(wire_up(config, environment_)),
      guard_required_(config.engine.health.guard_required) {
  environment_.gnss_configured = config::first(config, SlotKind::gnss) != nullptr;
  environment_.imu_configured = config::first(config, SlotKind::imu) != nullptr;
  const Duration jammed_after = from_s(config.engine.health.drive_stale_s);
  for (const Slot& slot : wiring_.slots) {
    const Actuator* const actuator = slot.made.actuator;
    if (actuator == nullptr || !slot.of_base) continue;
    environment_.drives_on_in_silence |= !actuator->silence().stops;
    environment_.stop_creeps |= actuator->stop_recipe().ends != StopEnds::holds;
  }
  for (std::size_t i = 0; i < wiring_.links.size(); ++i) {
    const Link& link = wiring_.links[i];
    if (link.wire == Wire::can) {
      buses_.emplace_back(link.name, jammed_after);
      listeners_.emplace_back();
      for (const SlotId id : link.slots) {
        const Made& made = wiring_.slots[id].made;
        const Actuator* const actuator = made.actuator;
        listeners_.back().add(
            id, made.frames->listens(),
            actuator != nullptr ? actuator->rules() : std::span<const FrameRule>());
        if (actuator != nullptr) frame_gate_.add(i, *actuator);
      }
    } else if (link.wire == Wire::bytes) {
      StreamOutput waiting{static_cast<LinkId>(i), {}, 0, false};
      for (const SlotId id : link.slots) {
        const Actuator* const actuator = wiring_.slots[id].made.actuator;
        if (actuator == nullptr) continue;
        waiting.moves = true;
        frame_gate_.add(i, *actuator);
      }
      streams_.push_back({waiting, 0});
      cycle_.streams.push_back(streams_.back().waiting);
    }
  }
}

[[gnu::hot]] void Gateway::apply(const Input& input) {
  std::visit([&](const auto& body) { on(body, input.time); }, input.body);
}

/// What the device said in the last call.
[[gnu::hot]] void Gateway::take(Slot& slot, Time now) {
  for (auto& measurement : scratch_.measurements) {
    measurement.source = slot.source;
    engine_.on_measurement(measurement);
    if (has_words(measurement)) take_words(*slot.made.device, measurement);
  }
  slot.overflows += scratch_.overflows;
  if (is_bus(slot.link)) {
    send(slot, now);
  } else {
    write(slot, now);
  }
  scratch_.clear();
}

/// Apart: a frame that brings numbers needs no room for a text.
[[gnu::noinline]] void Gateway::take_words(const Device& device, const Measurement& measurement) {
  engine_.on_words(measurement, device.words(measurement));
}

/// What a device wants to send goes through the frame gate, and nowhere around it.
[[gnu::hot]] void Gateway::send(Slot& slot, Time now) {
  if (scratch_.frames.empty()) return;
  if (slot.made.actuator == nullptr) {
    without_rules_[slot.link] += scratch_.frames.size();
    return;
  }
  const engine::Permission permitted = permission(slot);
  for (const auto& frame : scratch_.frames) {
    const auto verdict = frame_gate_.admit(slot.link, frame, *slot.made.actuator, permitted, now);
    if (verdict == engine::FrameVerdict::pass && !pending_[slot.link].push_back(frame))
      ++no_room_[slot.link];
  }
}

/// What moves nothing may write what it likes; what moves something only what the gate has seen.
void Gateway::write(Slot& slot, Time now) {
  for (Stream& stream : streams_) {
    if (stream.waiting.link != slot.link) continue;
    if (slot.made.actuator == nullptr) {
      stream.dropped += stream.waiting.add(scratch_);
      without_rules_[slot.link] += scratch_.packets.size();
      return;
    }
    // The guard has the same open file: at another speed its stops would be noise.
    without_rules_[slot.link] += scratch_.bytes.size() + (scratch_.reopen_baud != 0 ? 1 : 0);
    const engine::Permission permitted = permission(slot);
    for (const Packet& packet : scratch_.packets) {
      const auto verdict =
          frame_gate_.admit(slot.link, packet, *slot.made.actuator, permitted, now);
      if (verdict == engine::FrameVerdict::pass) stream.dropped += stream.waiting.add(packet);
    }
  }
}

bool Gateway::may_slow(AxisId axis) const {
  const engine::EngineOutput& wanted = cycle_.engine;
  return axis == kBaseAxis ? wanted.base.slowing_permitted : wanted.slowing_permitted[axis];
}

Setpoint Gateway::setpoint(AxisId axis) const {
  const engine::BaseCommand& base = cycle_.engine.base;
  if (axis == kBaseAxis) return {base.request, 0, base.twist, {}};
  const AxisCommand& command = cycle_.engine.axes[axis];
  return {command.request, command.velocity_radps, {}, command.impedance, command.held};
}

/// A speed counts only while the drive is heard: a wheel that nobody sees is not ramped.
engine::Permission Gateway::permission(const Slot& slot) {
  const bool fresh = slot.health.state == SourceState::fresh;
  slowing_.clear();
  const Snapshot& robot = engine_.snapshot();
  ChannelMask motion = 0;
  for (std::size_t channel = 0; channel < slot.axes.size(); ++channel) {
    const AxisId axis = slot.axes[channel];
    const bool may_move = slot.of_base ? motion_permitted_ : cycle_.engine.joint_may_move[axis];
    if (may_move) motion |= channel_bit(channel);
    engine::Slowing slowing{may_slow(axis) && fresh};
    if (slot.takes_twist)
      slowing.measured = robot.base.measured;
    else
      slowing.measured_radps = robot.axes[axis].motion.velocity_radps;
    (void)slowing_.push_back(slowing);
  }
  // By a stop from outside the guard has the base; what only this gateway can hold it holds on.
  const bool guarded =
      environment_.guard_has_bus && (slot.of_base || !environment_.guard_leaves_the_rest());
  return {motion, guarded, {slowing_.data(), slowing_.size()}};
}

void Gateway::on(const CommandGiven& given, Time now) {
  engine_.on_command(given.command, now);
}

void Gateway::on(const ProgramTrouble& trouble, Time) {
  environment_.program = trouble.why;
}

void Gateway::on(const Recalled& recalled, Time now) {
  engine_.recall(recalled.remembered, now);
}

void Gateway::on(const LearnedRecalled& recalled, Time) {
  engine_.recall(recalled.learned);
}

void Gateway::on(const OutputsUp& up, Time) {
  environment_.relay_found_closed = up.relay_closed;
}

void Gateway::on(const ClearanceFound& found, Time) {
  engine_.on_clearance(found.clearance);
}

void Gateway::on(const Tick& tick, Time now) {
  listen_to_devices(now);
  look_at_buses(now);
  look_at_lost_lines();
  tell_health();
  const bool guards = tick.guard_alive && !tick.guard_refuses_set;
  foreign_.update(now, tick.guard_has_bus || (guard_required_ && !guards));
  environment_.foreign = foreign_.reason();
  environment_.slept = slept_;
  if (now - woke_ > kSleptTold) slept_.clear();
  environment_.guard_alive = tick.guard_alive;
  environment_.guard_has_bus = tick.guard_has_bus;
  environment_.guard_latched = tick.guard_latched;
  environment_.guard_refuses_set = tick.guard_refuses_set;
  environment_.guard_has_all = tick.guard_has_all;

  engine_.step(now, environment_, cycle_.engine);
  motion_permitted_ = cycle_.engine.motion_permitted;
  command_actuators(now);
  hand_out();
}

/// What moves something has its tick after its command.
void Gateway::listen_to_devices(Time now) {
  for (Slot& slot : wiring_.slots) {
    if (slot.made.actuator == nullptr) {
      slot.made.device->on_tick(now, scratch_);
      take(slot, now);
    }
    slot.health = slot.made.device->health(now);
    slot.health.overflows = slot.overflows;
  }
}

/// Devices that are silent because of their bus say so; on one that is gone or off they are silent
/// before their time-out.
void Gateway::look_at_buses(Time now) {
  environment_.bus.clear();
  for (std::size_t bus = 0; bus < buses_.size(); ++bus) {
    const Reason trouble = buses_[bus].trouble(now);
    if (trouble.empty()) {
      look_at_strangers(bus, now);
      continue;
    }
    if (environment_.bus.empty()) environment_.bus = trouble;
    const bool cut = buses_[bus].cut(now);
    for (const SlotId id : wiring_.links[bus].slots) {
      SourceHealth& health = wiring_.slots[id].health;
      if (health.state == SourceState::fresh && !cut) continue;
      if (health.state == SourceState::fresh) health.state = SourceState::stale;
      health.reason = trouble;
    }
  }
}

/// Who is silent on a bus on which others speak is told of those: they have the right bit rate. Of
/// whom anything is heard its driver knows more.
void Gateway::look_at_strangers(std::size_t bus, Time now) {
  const auto& on_bus = wiring_.links[bus].slots;
  const auto is_fresh = [&](SlotId id) {
    return wiring_.slots[id].health.state == SourceState::fresh;
  };
  const bool others = std::any_of(on_bus.begin(), on_bus.end(), is_fresh);
  for (const SlotId id : on_bus) {
    Slot& slot = wiring_.slots[id];
    SourceHealth& health = slot.health;
    if (health.state == SourceState::fresh) continue;
    const Time last = std::max(health.last_good, slot.last_heard);
    const Reason told = buses_[bus].strangers().text(buses_[bus].name(), last, others, now);
    if (!told.empty()) health.reason = told;
  }
}

/// What moves something has lost its line at once, with the system's words: its own silence would
/// be noticed later, and after the guard, which then has no line either.
void Gateway::look_at_lost_lines() {
  for (const Link& link : wiring_.links) {
    if (link.lost.empty()) continue;
    for (const SlotId id : link.slots) {
      Slot& slot = wiring_.slots[id];
      if (slot.made.actuator == nullptr) continue;
      if (slot.health.state == SourceState::fresh) slot.health.state = SourceState::stale;
      slot.health.reason = link.lost;
    }
  }
}

void Gateway::tell_health() {
  for (const Slot& slot : wiring_.slots)
    for (SourceHealth* const to : slot.tells_health) *to = slot.health;
}

void Gateway::command_actuators(Time now) {
  FixedVector<Setpoint, kMaxChannels> wanted;
  for (Slot& slot : wiring_.slots) {
    if (slot.made.actuator == nullptr) continue;
    wanted.clear();
    for (std::size_t channel = 0; channel < slot.axes.size(); ++channel) {
      const AxisId axis = slot.axes[channel];
      if (!may_slow(axis)) frame_gate_.end_slowing(*slot.made.actuator, channel);
      (void)wanted.push_back(setpoint(axis));
    }
    slot.made.actuator->on_setpoints({wanted.data(), wanted.size()}, now, scratch_);
    slot.made.device->on_tick(now, scratch_);
    take(slot, now);
  }
}

/// What the devices had to say since the last cycle, while something came in or now.
void Gateway::hand_out() {
  for (std::size_t bus = 0; bus < buses_.size(); ++bus) {
    cycle_.frames[bus] = pending_[bus];
    pending_[bus].clear();
  }
  for (std::size_t i = 0; i < streams_.size(); ++i) {
    StreamOutput& waiting = streams_[i].waiting;
    // The guard writes whole packets there; even a stop of ours could fall into one of them.
    if (waiting.moves && environment_.guard_has_bus) waiting.bytes.clear();
    cycle_.streams[i] = waiting;
    waiting = {waiting.link, {}, 0, waiting.moves};
  }
}

std::uint64_t Gateway::refused(std::size_t link) const {
  const auto& counts = frame_gate_.counts(link);
  return counts.not_allowed + counts.motion + without_rules_[link];
}

std::uint64_t Gateway::bytes_dropped(LinkId link) const {
  for (const Stream& stream : streams_)
    if (stream.waiting.link == link) return stream.dropped;
  return 0;
}

std::vector<std::string> Gateway::cautions() const {
  std::vector<std::string> all;
  for (const Slot& slot : wiring_.slots) {
    if (slot.made.actuator == nullptr) continue;
    const auto silence = slot.made.actuator->silence();
    if (silence.stops) continue;
    all.push_back((slot.takes_twist ? "the base, " : "drive ") + std::string(slot.name) + " " +
                  std::string(silence.text));
  }
  return all;
}

std::vector<LinkDuty> Gateway::duties() const {
  std::vector<LinkDuty> all(wiring_.links.size());
  for (const Slot& slot : wiring_.slots) {
    if (slot.made.actuator == nullptr) continue;
    LinkDuty& duty = all[slot.link];
    const StopRecipe recipe = slot.made.actuator->stop_recipe();
    const bool held_by_daemon = !slot.of_base && recipe.ends != StopEnds::holds;
    const bool runs_on = slot.of_base && !slot.made.actuator->silence().stops;
    duty.stops.push_back({recipe, held_by_daemon, runs_on});
    duty.messages_per_cycle += slot.made.actuator->messages_per_cycle();
  }
  return all;
}

}  // namespace drover::gateway
