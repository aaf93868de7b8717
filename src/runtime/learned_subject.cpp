#include "runtime/learned_subject.h"

#include <algorithm>
#include <variant>

#include "json/json_text.h"
#include "store/durable_file.h"

namespace drover::runtime {
namespace {

void write(json::JsonText& out, const OptionValue& value) {
  if (const auto* flag = std::get_if<bool>(&value)) {
    out.boolean(*flag);
  } else if (const auto* number = std::get_if<double>(&value)) {
    out.number(*number);
  } else {
    out.text(std::get<std::string>(value));
  }
}

void write(json::JsonText& out, const config::DeviceConfig& device,
           const config::DroverConfig& config) {
  out.open('[').text(device.name).text(device.driver).text(device.role);
  out.integer(device.link_index < config.links.size() ? config.links[device.link_index].baud : 0);
  for (const double number : {device.antenna_x_m, device.antenna_y_m, device.antenna_z_m,
                              device.heading_baseline_offset_deg})
    out.number(number);
  for (const auto& [name, value] : device.options.all()) {
    out.text(name);
    write(out, value);
  }
  out.close(']');
}

std::uint8_t that_steers(const engine::SensorList& sensors) {
  const auto* steers =
      std::find_if(sensors.begin(), sensors.end(),
                   [](const engine::SensorConfig& one) { return one.role == Role::steers; });
  return static_cast<std::uint8_t>(steers == sensors.end() ? 0 : steers - sensors.begin());
}

bool tells_of_motion(const config::DeviceConfig& device) {
  return device.kind == SlotKind::drive || device.kind == SlotKind::gnss ||
         device.kind == SlotKind::imu;
}

}  // namespace

std::uint64_t learned_subject(const config::DroverConfig& config) {
  const engine::BaseConfig& base = config.engine.base;
  json::JsonText out;
  out.open('[').integer(static_cast<int>(base.kind));
  for (const double number : {base.wheel_radius_m, base.track_m, base.yaw_slip_factor})
    out.number(number);
  for (const auto* side : {&base.left, &base.right}) {
    out.open('[');
    for (const AxisId axis : *side) out.integer(axis);
    out.close(']');
  }
  for (const config::DeviceConfig& device : config.devices)
    if (tells_of_motion(device)) write(out, device, config);
  return store::fingerprint(out.close(']').str());
}

publish::LearnedBeside learned_beside(const config::DroverConfig& config) {
  const engine::EngineConfig& engine = config.engine;
  publish::LearnedBeside beside;
  beside.subject = learned_subject(config);
  beside.receiver = that_steers(engine.receivers);
  beside.imu = that_steers(engine.imus);
  const auto antenna = engine::antenna_of(engine.estimate, beside.receiver);
  beside.antenna_x_m = antenna.x_m;
  beside.antenna_y_m = antenna.y_m;
  beside.heading_baseline_offset_deg = antenna.heading_baseline_offset_deg;
  const bool has_wheels = !engine::takes_twist(engine.base.kind);
  if (has_wheels) beside.wheel_radius_m = engine.base.wheel_radius_m;
  beside.yaw_slip_factor = engine.base.yaw_slip_factor;
  return beside;
}

}  // namespace drover::runtime
