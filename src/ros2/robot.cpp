#include "ros2/robot.h"

#include "drover/angle.h"

namespace drover::ros2 {
namespace {

/// 0.8 degrees: the beams of a turn of an LD06 at the pace that it is made for.
constexpr std::size_t kScanAngles = 450;

double option_or(const Options& options, std::string_view name, double otherwise) {
  return options.has(name) ? options.number(name) : otherwise;
}

ScannerFrame scanner_of(const config::DeviceConfig& device) {
  const Made made = find_driver(device.driver, SlotKind::scanner)
                        ->make(device.options, config::context_of(device));
  const ScanMount mount = made.scans->mount();
  constexpr double kFar_m = 100;
  return {{device.name, mount.x_m, mount.y_m, mount.z_m, 0, 0, mount.yaw_rad},
          {option_or(device.options, "range_min_m", 0),
           option_or(device.options, "range_max_m", kFar_m)},
          kScanAngles};
}

}  // namespace

Robot robot_of(const config::DroverConfig& config) {
  Robot robot;
  robot.name = config.robot_name;
  for (const auto& device : config.devices) {
    if (device.kind == SlotKind::gnss)
      robot.frames.push_back(
          {device.name, device.antenna_x_m, device.antenna_y_m, device.antenna_z_m, 0, 0, 0});
    if (device.kind == SlotKind::scanner) {
      robot.scanners.push_back(scanner_of(device));
      robot.frames.push_back(robot.scanners.back().frame);
    }
  }
  for (const auto& frame : config.scene.frames)
    robot.frames.push_back({frame.name, frame.x_m, frame.y_m, frame.z_m, to_rad(frame.roll_deg),
                            to_rad(frame.pitch_deg), to_rad(frame.yaw_deg)});
  return robot;
}

}  // namespace drover::ros2
