#include "gateway/slots.h"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <utility>

namespace drover::gateway {

namespace {

bool speaks(const Made& made, Wire wire) {
  switch (wire) {
    case Wire::can: return made.frames != nullptr;
    case Wire::bytes: return made.bytes != nullptr;
    case Wire::registers: return made.registers != nullptr;
    case Wire::levels: return made.levels != nullptr;
  }
  return false;
}

class Builder final {
 public:
  explicit Builder(engine::Environment& environment) : environment_(environment) {}

  LinkId link(std::string_view name, Wire wire) {
    if (wiring_.links.size() == kMaxLinks) throw std::runtime_error("too many links");
    wiring_.links.push_back({Name(name), wire, {}});
    return static_cast<LinkId>(wiring_.links.size() - 1);
  }

  /// `config` is the section that names the driver and its options, `key` where it stands.
  void slot(std::string_view name, LinkId link, const auto& config, const MakeContext& context,
            const std::string& key) {
    const auto* const entry = find_driver(config.driver, context.kind);
    if (entry == nullptr)
      throw std::runtime_error(key + ": no driver \"" + config.driver + "\" of this kind");
    if (wiring_.slots.size() == kMaxSlots) throw std::runtime_error("too many devices");
    Slot slot;
    slot.name = Name(name);
    slot.kind = context.kind;
    slot.made = entry->make(config.options, context);
    slot.link = link;
    slot.axes = context.axes;
    tell_health(slot, context);
    const Wire wire = wiring_.links[link].wire;
    if (wire == Wire::registers) slot.thread = Slot::Thread::slow;
    if (!speaks(slot.made, wire))
      throw std::runtime_error(key + ": driver \"" + config.driver + "\" is for another wire");
    if ((context.kind == SlotKind::drive) != (slot.made.actuator != nullptr))
      throw std::runtime_error(key + ": driver \"" + config.driver + "\" is for no such device");
    if (slot.made.actuator != nullptr && slot.made.actuator->channels().size() != slot.axes.size())
      throw std::runtime_error(key + ": driver \"" + config.driver + "\" moves " +
                               std::to_string(slot.made.actuator->channels().size()) +
                               " joints, and " + std::to_string(slot.axes.size()) + " are named");
    wiring_.links[link].slots.push_back(static_cast<SlotId>(wiring_.slots.size()));
    wiring_.slots.push_back(std::move(slot));
  }

  Wiring built() { return std::move(wiring_); }

 private:
  void tell_health(Slot& slot, const MakeContext& context) {
    const auto tell = [&slot](SourceHealth& to) { (void)slot.tells_health.push_back(&to); };
    switch (context.kind) {
      case SlotKind::drive:
        for (const AxisId axis : context.axes) tell(environment_.axes.at(axis));
        return;
      case SlotKind::gnss: return tell(environment_.gnss);
      case SlotKind::imu: return tell(environment_.imu);
      case SlotKind::battery: return tell(environment_.battery);
      case SlotKind::line:
        return tell(environment_.lines.at(static_cast<std::size_t>(context.line)));
    }
  }

  engine::Environment& environment_;
  Wiring wiring_;
};

}  // namespace

SlotId Wiring::first(SlotKind kind) const {
  const auto it = std::find_if(slots.begin(), slots.end(),
                               [kind](const Slot& slot) { return slot.kind == kind; });
  return it == slots.end() ? kNowhere : static_cast<SlotId>(it - slots.begin());
}

LinkId Wiring::link_of(SlotKind kind) const {
  const SlotId slot = first(kind);
  return slot == kNowhere ? kNowhere : slots[slot].link;
}

Wiring wire_up(const config::DroverConfig& config, engine::Environment& environment) {
  Builder build(environment);
  if (config.buses.size() > kMaxBuses) throw std::runtime_error("buses: too many");
  for (const auto& bus : config.buses) build.link(bus.name, Wire::can);
  for (std::size_t i = 0; i < config.drives.size(); ++i) {
    const auto& drive = config.drives[i];
    MakeContext context{.kind = SlotKind::drive};
    (void)context.axes.push_back(static_cast<AxisId>(i));
    build.slot(drive.joint, static_cast<LinkId>(drive.bus_index), drive, context,
               "drives: " + drive.joint);
  }
  if (config.gnss.configured)
    build.slot("gnss", build.link("gnss", Wire::bytes), config.gnss, {.kind = SlotKind::gnss},
               "gnss");
  if (config.imu.configured)
    build.slot("imu", build.link("imu", Wire::bytes), config.imu, {.kind = SlotKind::imu}, "imu");
  if (config.battery.configured)
    build.slot("battery", build.link("battery", Wire::registers), config.battery,
               {.kind = SlotKind::battery, .registers = &config.battery.registers}, "battery");
  LinkId chip = kNowhere;
  for (std::size_t i = 0; i < kLineCount; ++i) {
    const auto& line = config.lines.line[i];
    if (!line.configured) continue;
    if (chip == kNowhere) chip = build.link("lines", Wire::levels);
    build.slot(line.name, chip, line,
               {.kind = SlotKind::line, .line = static_cast<drover::Line>(i)},
               "lines: " + line.name);
  }
  return build.built();
}

}  // namespace drover::gateway
