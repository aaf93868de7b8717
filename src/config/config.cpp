#include "config/config.h"

#include <algorithm>

namespace drover::config {

const std::string& address(const LinkConfig& link) {
  for (const auto* given : {&link.can, &link.serial, &link.modbus})
    if (!given->empty()) return *given;
  return link.gpio;
}

std::vector<const DeviceConfig*> by_axis(const DroverConfig& config) {
  std::vector<const DeviceConfig*> devices;
  for (const auto& device : config.devices)
    if (!device.joints.empty()) devices.push_back(&device);
  std::stable_sort(devices.begin(), devices.end(),
                   [](const auto* a, const auto* b) { return a->first_axis < b->first_axis; });
  return devices;
}

const DeviceConfig* first(const DroverConfig& config, SlotKind kind) {
  const auto it = std::find_if(config.devices.begin(), config.devices.end(),
                               [kind](const auto& device) { return device.kind == kind; });
  return it == config.devices.end() ? nullptr : &*it;
}

Line line_of(const DeviceConfig& device) {
  const auto it = std::find(kLineKeys.begin(), kLineKeys.end(), device.is);
  return it == kLineKeys.end() ? Line::estop : static_cast<Line>(it - kLineKeys.begin());
}

MakeContext context_of(const DeviceConfig& device) {
  MakeContext context{.kind = device.kind};
  const auto* const entry = find_driver(device.driver, device.kind);
  if (entry != nullptr && takes_twist(*entry)) (void)context.axes.push_back(kBaseAxis);
  for (std::size_t channel = 0; channel < device.joints.size(); ++channel)
    for (std::size_t i = 0; i < device.joints.size(); ++i)
      if (device.joints[i].channel_index == channel)
        (void)context.axes.push_back(static_cast<AxisId>(device.first_axis + i));
  if (device.kind == SlotKind::line) context.line = line_of(device);
  if (device.kind == SlotKind::battery) context.registers = &device.registers;
  return context;
}

}  // namespace drover::config
