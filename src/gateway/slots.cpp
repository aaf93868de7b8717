#include "gateway/slots.h"

#include <algorithm>
#include <array>
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

/// A bus and a serial line under their own names. A chip has two ways, and this is the one in. Of
/// what is polled people know the device, when it is alone.
std::string shown_name(const config::DroverConfig& config, const config::LinkConfig& link) {
  if (link.wire == Wire::levels) {
    const auto chips = std::count_if(config.links.begin(), config.links.end(),
                                     [](const auto& each) { return each.wire == Wire::levels; });
    return chips == 1 ? "lines" : link.name;
  }
  const config::DeviceConfig* only = nullptr;
  for (const auto& device : config.devices) {
    if (device.link != link.name || link.wire != Wire::registers) continue;
    if (only != nullptr) return link.name;
    only = &device;
  }
  return only == nullptr ? link.name : only->name;
}

class Builder final {
 public:
  Builder(const config::DroverConfig& config, engine::Environment& environment)
      : config_(config), environment_(environment), numbers_(config.links.size(), kNowhere) {}

  void link(std::size_t place) {
    const auto& link = config_.links[place];
    if (wiring_.links.size() == kMaxLinks) throw std::runtime_error("too many links");
    numbers_[place] = static_cast<LinkId>(wiring_.links.size());
    wiring_.links.push_back({Name(shown_name(config_, link)), link.wire, {}, place});
  }

  void slot(std::size_t place) {
    const auto& device = config_.devices[place];
    const auto key = "devices." + device.name;
    const auto* const entry = find_driver(device.driver, device.kind);
    if (entry == nullptr)
      throw std::runtime_error(key + ": no driver \"" + device.driver + "\" of this kind");
    if (wiring_.slots.size() == kMaxSlots) throw std::runtime_error("too many devices");
    const MakeContext context = config::context_of(device);
    Slot slot;
    slot.name = Name(device.name);
    slot.kind = device.kind;
    slot.made = entry->make(device.options, context);
    slot.link = numbers_.at(device.link_index);
    slot.axes = context.axes;
    slot.takes_twist = drover::takes_twist(*entry);
    const auto of_base = config_.engine.joints.size() - joints_of_groups(config_.engine);
    slot.of_base = slot.axes.empty() || slot.takes_twist || slot.axes[0] < of_base;
    slot.place = place;
    slot.source = of_kind_[static_cast<std::size_t>(slot.kind)]++;
    tell_health(slot, context);
    Link& link = wiring_.links[slot.link];
    if (link.wire == Wire::registers) slot.thread = Slot::Thread::slow;
    if (!speaks(slot.made, link.wire))
      throw std::runtime_error(key + ": driver \"" + device.driver + "\" is for another wire");
    const auto* const actuator = slot.made.actuator;
    if (actuator != nullptr && actuator->channels().size() != slot.axes.size())
      throw std::runtime_error(key + ": driver \"" + device.driver + "\" moves " +
                               std::to_string(actuator->channels().size()) + " joints, and " +
                               std::to_string(slot.axes.size()) + " are named");
    link.slots.push_back(static_cast<SlotId>(wiring_.slots.size()));
    wiring_.slots.push_back(std::move(slot));
  }

  Wiring built() { return std::move(wiring_); }

 private:
  void tell_health(Slot& slot, const MakeContext& context) {
    const auto tell = [&slot](SourceHealth& to) { (void)slot.tells_health.push_back(&to); };
    switch (context.kind) {
      case SlotKind::drive:
        for (const AxisId axis : slot.axes)
          tell(axis == kBaseAxis ? environment_.base : environment_.axes.at(axis));
        return;
      case SlotKind::gnss: return tell(environment_.gnss.at(slot.source));
      case SlotKind::imu: return tell(environment_.imu.at(slot.source));
      case SlotKind::battery: return tell(environment_.battery.at(slot.source));
      case SlotKind::line:
        return tell(environment_.lines.at(static_cast<std::size_t>(context.line)));
      case SlotKind::scanner: return;  // has no slot
    }
  }

  const config::DroverConfig& config_;
  engine::Environment& environment_;
  std::vector<LinkId> numbers_;            ///< by the place in the configuration
  std::array<std::uint8_t, 8> of_kind_{};  ///< slots so far, by SlotKind
  Wiring wiring_;
};

/// A scanner's bytes go past the gateway: they and their line are the scene's.
bool is_heard(const config::DeviceConfig& device) {
  return device.kind != SlotKind::scanner;
}

bool has_devices(const config::DroverConfig& config, std::size_t place) {
  return std::any_of(config.devices.begin(), config.devices.end(), [place](const auto& device) {
    return device.link_index == place && is_heard(device);
  });
}

}  // namespace

Wiring wire_up(const config::DroverConfig& config, engine::Environment& environment) {
  Builder build(config, environment);
  const auto links = [&](bool buses) {
    for (std::size_t i = 0; i < config.links.size(); ++i)
      if ((config.links[i].wire == Wire::can) == buses && has_devices(config, i)) build.link(i);
  };
  const auto slots = [&](bool drives) {
    for (std::size_t i = 0; i < config.devices.size(); ++i)
      if (is_heard(config.devices[i]) && (config.devices[i].kind == SlotKind::drive) == drives)
        build.slot(i);
  };
  links(true);
  links(false);
  slots(true);
  slots(false);
  return build.built();
}

}  // namespace drover::gateway
