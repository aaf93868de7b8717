#include "gateway/gateway.h"

#include <stdexcept>

namespace drover::gateway {

namespace {

/// A device that has the face which its place in the gateway needs.
template <class Face>
Made made(const auto& config, const MakeContext& context, Face Made::*face,
          const std::string& key) {
  const auto* entry = find_driver(config.driver, context.kind);
  if (entry == nullptr)
    throw std::runtime_error(key + ": no driver \"" + config.driver + "\" of this kind");
  Made device = entry->make(config.options, context);
  if (device.*face == nullptr)
    throw std::runtime_error(key + ": \"" + config.driver + "\" does not speak on such a link");
  return device;
}

constexpr Duration kSleptTold = std::chrono::seconds(1);

constexpr std::size_t index(Stream stream) {
  return static_cast<std::size_t>(stream);
}

}  // namespace

std::size_t StreamOutput::add(const DriverOut& out) {
  std::size_t dropped = 0;
  for (const auto byte : out.bytes) dropped += bytes.push_back(byte) ? 0 : 1;
  if (out.reopen_baud != 0) reopen_baud = out.reopen_baud;
  return dropped;
}

Gateway::Gateway(const config::DroverConfig& config)
    : engine_(config.engine),
      bus_count_(config.buses.size()),
      jammed_after_(from_s(config.engine.health.drive_stale_s)),
      guard_required_(config.engine.health.guard_required) {
  if (bus_count_ > kMaxBuses) throw std::runtime_error("buses: too many");
  for (std::size_t bus = 0; bus < bus_count_; ++bus)
    buses_[bus].name = Name(config.buses[bus].name);
  drives_.reserve(config.drives.size());
  for (const auto& drive : config.drives) {
    const auto axis = static_cast<AxisId>(drives_.size());
    drives_.push_back({drive.bus_index, made(drive, {.kind = SlotKind::drive, .axis = axis},
                                             &Made::actuator, "drives: " + drive.joint)});
    frame_gate_.add(drive.bus_index, *drives_.back().made.actuator);
  }
  if (config.gnss.configured)
    streams_[index(Stream::gnss)] =
        made(config.gnss, {.kind = SlotKind::gnss}, &Made::bytes, "gnss");
  if (config.imu.configured)
    streams_[index(Stream::imu)] = made(config.imu, {.kind = SlotKind::imu}, &Made::bytes, "imu");
  if (config.battery.configured)
    battery_ =
        made(config.battery, {.kind = SlotKind::battery, .registers = &config.battery.registers},
             &Made::registers, "battery");
  environment_.gnss_configured = config.gnss.configured;
  environment_.imu_configured = config.imu.configured;
  for (std::size_t i = 0; i < kLineCount; ++i) {
    const auto& line = config.lines.line[i];
    if (!line.configured) continue;
    lines_.push_back(made(line, {.kind = SlotKind::line, .line = static_cast<Line>(i)},
                          &Made::levels, "lines: " + line.name));
    line_ids_.push_back(static_cast<Line>(i));
  }
}

void Gateway::absorb(const DriverOut& out, std::uint64_t& overflows) {
  for (const auto& measurement : out.measurements) engine_.on_measurement(measurement);
  overflows += out.overflows;
}

/// The speed counts only while the drive is heard: a wheel that nobody sees is not ramped.
engine::Slowing Gateway::slowing(std::size_t axis) const {
  const auto& heard = engine_.snapshot().axes[axis];
  const bool fresh = environment_.axes[axis].state == SourceState::fresh;
  return {cycle_.engine.slowing_permitted[axis] && fresh, heard.motion.velocity_radps};
}

/// What a drive wants to say goes through the frame gate, and nowhere around it.
void Gateway::emit(std::size_t axis) {
  Drive& drive = drives_[axis];
  absorb(scratch_, drive.overflows);
  const engine::Slowing ramp = slowing(axis);
  for (const auto& frame : scratch_.frames) {
    const auto verdict = frame_gate_.admit(drive.bus, frame, *drive.made.actuator,
                                           motion_permitted_, guard_has_bus_, ramp);
    if (verdict == engine::FrameVerdict::pass && !pending_[drive.bus].push_back(frame))
      ++buses_[drive.bus].no_room;
  }
  scratch_.clear();
}

void Gateway::apply(const Input& input) {
  std::visit([&](const auto& body) { on(body, input.time); }, input.body);
}

void Gateway::on(const FrameHeard& heard, Time received) {
  const auto& [bus, frame] = heard;
  if (frame.error) return buses_[bus].condition.on_error_frame(frame, received);
  buses_[bus].condition.on_frame(received);
  for (std::size_t i = 0; i < drives_.size(); ++i) {
    if (drives_[i].bus != bus) continue;
    notice_foreign(drives_[i], frame, received);
    drives_[i].made.frames->on_frame(frame, received, scratch_);
    emit(i);
  }
}

/// A link does not hear what it sent itself. What moves, the driver notices.
void Gateway::notice_foreign(const Drive& drive, const CanFrame& frame, Time received) {
  for (const FrameRule& rule : drive.made.actuator->rules()) {
    if (!engine::matches(rule, frame)) continue;
    if (frame.remote || drive.made.actuator->effect(frame) != FrameEffect::stop) return;
    return foreign_.on_stop_frame(frame.id, buses_[drive.bus].name.view(), received);
  }
}

void Gateway::on(const BusUp& up, Time now) {
  const std::size_t bus = up.bus;
  buses_[bus].condition = {};
  buses_[bus].lost.clear();
  buses_[bus].jammed_since = kNever;
  for (const auto& drive : drives_)
    if (drive.bus == bus) drive.made.device->on_link_up(now);
}

void Gateway::on(const BusLost& lost, Time) {
  buses_[lost.bus].lost = lost.why;
}

void Gateway::on(const FramesSent& counts, Time now) {
  const auto& [bus, sent, refused] = counts;
  Bus& it = buses_[bus];
  if (sent != it.sent) {
    it.jammed_since = kNever;
  } else if (refused != it.refused && it.jammed_since == kNever) {
    it.jammed_since = now;
  }
  it.sent = sent;
  it.refused = refused;
}

bool Gateway::jammed(const Bus& bus, Time now) const {
  return bus.jammed_since != kNever && now - bus.jammed_since >= jammed_after_;
}

Reason Gateway::bus_trouble(std::size_t bus, Time now) const {
  const Bus& it = buses_[bus];
  if (!it.lost.empty()) return it.lost;
  Reason text = it.condition.text(it.name.view(), now);
  if (text.empty() && jammed(it, now)) {
    const auto name = it.name.view();
    text.format("%.*s takes no frames: nobody acknowledges them, or its queue is stuck",
                static_cast<int>(name.size()), name.data());
  }
  return text;
}

/// Drives that are silent because of their bus say so; on one that is gone or off they are silent
/// before their time-out.
void Gateway::look_at_buses(Time now) {
  environment_.bus.clear();
  for (std::size_t bus = 0; bus < bus_count_; ++bus) {
    const Reason trouble = bus_trouble(bus, now);
    if (trouble.empty()) continue;
    if (environment_.bus.empty()) environment_.bus = trouble;
    const Bus& it = buses_[bus];
    const bool cut =
        !it.lost.empty() || jammed(it, now) || it.condition.state() == CanCondition::State::off;
    for (std::size_t i = 0; i < drives_.size(); ++i) {
      SourceHealth& health = environment_.axes[i];
      if (drives_[i].bus != bus || (health.state == SourceState::fresh && !cut)) continue;
      if (health.state == SourceState::fresh) health.state = SourceState::stale;
      health.reason = trouble;
    }
  }
}

void Gateway::on(const StreamUp& up, Time now) {
  if (streams_[index(up.stream)].device) streams_[index(up.stream)].device->on_link_up(now);
}

void Gateway::on(const BytesHeard& heard, Time first_byte) {
  const auto& [stream, bytes] = heard;
  if (!streams_[index(stream)].device) return;
  streams_[index(stream)].bytes->on_bytes(bytes, first_byte, scratch_);
  absorb_stream(index(stream));
}

void Gateway::absorb_stream(std::size_t stream) {
  absorb(scratch_, stream_overflows_[stream]);
  bytes_dropped_[stream] += waiting_[stream].add(scratch_);
  scratch_.clear();
}

void Gateway::absorb_lines() {
  absorb(scratch_, line_overflows_);
  scratch_.clear();
}

void Gateway::on(const LevelsRead& read, Time at) {
  const auto& levels = read.levels;
  for (std::size_t i = 0; i < lines_.size() && i < levels.size(); ++i)
    lines_[i].levels->on_level(levels[i], at, scratch_);
  absorb_lines();
}

void Gateway::on(const LinesLost&, Time at) {
  for (const auto& line : lines_) line.levels->on_lost(at, scratch_);
  absorb_lines();
}

void Gateway::on(const RegistersRead& read, Time received) {
  if (!battery_.device || read.block >= battery_.registers->blocks().size()) return;
  if (read.words.size() != battery_.registers->blocks()[read.block].count) return;
  battery_.registers->on_registers(read.block, read.words, received, scratch_);
  absorb(scratch_, battery_overflows_);
  scratch_.clear();
}

void Gateway::on(const RegistersFailed& failed, Time at) {
  if (!battery_.device || failed.block >= battery_.registers->blocks().size()) return;
  battery_.registers->on_failure(failed.block, failed.failure, failed.exception, at);
}

void Gateway::on(const BatteryUp&, Time at) {
  if (battery_.device) battery_.device->on_link_up(at);
}

void Gateway::on(const CommandGiven& given, Time now) {
  engine_.on_command(given.command, now);
}

void Gateway::on(const ProgramTrouble& trouble, Time) {
  environment_.program = trouble.why;
}

/// As if every line had been pulled and plugged again.
void Gateway::on(const Suspended& slept, Time now) {
  for (std::size_t bus = 0; bus < bus_count_; ++bus)
    if (buses_[bus].lost.empty()) on(BusUp{static_cast<std::uint8_t>(bus)}, now);
  for (std::size_t i = 0; i < kStreamCount; ++i) on(StreamUp{static_cast<Stream>(i)}, now);
  on(LinesLost{}, now);
  on(BatteryUp{}, now);
  woke_ = now;
  slept_.format("the computer slept for %.1f s", slept.lasted_s);
}

void Gateway::on(const Recalled& recalled, Time now) {
  engine_.recall(recalled.remembered, now);
}

void Gateway::on(const OutputsUp& up, Time) {
  environment_.relay_found_closed = up.relay_closed;
}

void Gateway::on(const Tick& tick, Time now) {
  for (std::size_t i = 0; i < kStreamCount; ++i) {
    if (!streams_[i].device) continue;
    streams_[i].device->on_tick(now, scratch_);
    absorb_stream(i);
    auto& health = i == index(Stream::gnss) ? environment_.gnss : environment_.imu;
    health = streams_[i].device->health(now);
    health.overflows = stream_overflows_[i];
    // What the driver had to say since the last cycle, while bytes came in or now.
    cycle_.streams[i] = waiting_[i];
    waiting_[i] = {};
  }
  for (std::size_t i = 0; i < lines_.size(); ++i) {
    lines_[i].device->on_tick(now, scratch_);
    auto& health = environment_.lines[static_cast<std::size_t>(line_ids_[i])];
    health = lines_[i].device->health(now);
    health.overflows = line_overflows_;
  }
  absorb_lines();
  if (battery_.device) {
    environment_.battery = battery_.device->health(now);
    environment_.battery.overflows = battery_overflows_;
  }
  for (std::size_t i = 0; i < drives_.size(); ++i) {
    environment_.axes[i] = drives_[i].made.device->health(now);
    environment_.axes[i].overflows = drives_[i].overflows;
  }
  look_at_buses(now);
  foreign_.update(now, tick.guard_has_bus || (guard_required_ && !tick.guard_alive));
  environment_.foreign = foreign_.reason();
  environment_.slept = slept_;
  if (now - woke_ > kSleptTold) slept_.clear();
  environment_.guard_alive = tick.guard_alive;
  environment_.guard_has_bus = tick.guard_has_bus;
  environment_.guard_latched = tick.guard_latched;

  engine_.step(now, environment_, cycle_.engine);
  motion_permitted_ = cycle_.engine.motion_permitted;
  guard_has_bus_ = tick.guard_has_bus;
  for (std::size_t i = 0; i < drives_.size(); ++i) {
    if (!cycle_.engine.slowing_permitted[i]) frame_gate_.end_slowing(*drives_[i].made.actuator);
    drives_[i].made.actuator->on_command(cycle_.engine.axes[i], now, scratch_);
    drives_[i].made.device->on_tick(now, scratch_);
    emit(i);
  }
  for (std::size_t bus = 0; bus < bus_count_; ++bus) {
    cycle_.frames[bus] = pending_[bus];
    pending_[bus].clear();
  }
}

std::uint64_t Gateway::refused(std::size_t bus) const {
  const auto& counts = frame_gate_.counts(bus);
  return counts.not_allowed + counts.motion;
}

std::vector<std::string> Gateway::cautions() const {
  std::vector<std::string> all;
  for (std::size_t i = 0; i < drives_.size(); ++i) {
    const auto silence = drives_[i].made.actuator->silence();
    if (silence.stops) continue;
    const auto& joint = engine_.snapshot().axes[i].joint;
    all.push_back("drive " + std::string(joint) + " " + std::string(silence.text));
  }
  return all;
}

std::vector<CanFrame> Gateway::stop_frames(std::size_t bus) const {
  std::vector<CanFrame> frames;
  for (const auto& drive : drives_) {
    if (drive.bus != bus) continue;
    const auto recipe = drive.made.actuator->stop_recipe();
    frames.insert(frames.end(), recipe.frames.begin(), recipe.frames.end());
  }
  return frames;
}

}  // namespace drover::gateway
