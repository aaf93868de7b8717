// The devices: what only their drivers know.
#include <algorithm>
#include <cmath>
#include <exception>
#include <numbers>
#include <optional>
#include <string>
#include <utility>

#include "config/bus_ids.h"
#include "config/check_subjects.h"
#include "text/number.h"

namespace drover::config {
namespace {

void follow_baud(DeviceConfig& device, const LinkConfig& link, Findings& found) {
  if (!device.options.has("baud")) return;
  const auto path = device_path(device, "options.baud");
  const auto other = link_path(link, "baud");
  if (found.given(path) && device.options.number("baud") != link.baud)
    found.add(path, "differs from " + other, "leave it out: it follows " + other);
  device.options.set("baud", static_cast<double>(link.baud));
}

/// A drive whose time-out ends before the guard speaks is at rest without it, and the guard's zeros
/// hold nothing that let go. One that holds by itself may be as early as it likes.
void look_at_guard(const DeviceConfig& device, const SilenceBehaviour& silence, Findings& found) {
  constexpr int kGuardsCycles_ms = 20;
  const auto& guard = found.config().guard;
  const Duration takes_over = std::chrono::milliseconds(guard.limit_ms + kGuardsCycles_ms);
  if (!guard.required || !silence.stops || silence.after > takes_over) return;
  if (silence.ends == StopEnds::holds) return;
  const char* const ends = silence.ends == StopEnds::coasts ? "lets go" : "only brakes";
  const auto path = device_path(device, "options");
  const auto what =
      "the drive " + std::string(ends) +
      " before drover-guard takes over when droverd dies: " + std::string(silence.text) +
      ", and the guard needs up to " + std::to_string(guard.limit_ms + kGuardsCycles_ms) + " ms";
  const std::string advice = "a longer time-out of the drive, or a smaller guard.limit_ms";
  // One that may hold after all is nobody's mistake.
  if (silence.assumed)
    return found.warn(path, what, "early_time_out",
                      advice + ", or the option that says that it holds when you tried it");
  found.add(path, what, advice);
}

/// A drive that nothing stops when the bus is cut is refused, unless a person says that it is so.
void look_at_silence(const DeviceConfig& device, const Actuator& driver, Findings& found) {
  const auto& words = device.accept;
  look_at_guard(device, driver.silence(), found);
  if (driver.silence().stops || std::find(words.begin(), words.end(), "no_watchdog") != words.end())
    return;
  found.add(device_path(device, "options"), std::string(driver.silence().text),
            "set its watchdog, or \"accept\": [\"no_watchdog\"] when that is meant");
}

/// What a drive cuts off is no limit of its joint: often it is an angle in degrees.
void look_at_range(const std::string& path, const engine::JointRules& joint,
                   const ImpedanceRange& range, Findings& found) {
  const auto beyond = [&](const char* key, double value, double least, double most,
                          const char* unit) {
    if (value >= least && value <= most) return;
    const bool is_angle = std::string_view(unit).starts_with("rad");
    found.add(path + "." + key,
              "is " + text::number_text(value) + " " + unit + ", and its drive can be told " +
                  text::number_text(least) + " to " + text::number_text(most),
              is_angle ? "are these degrees? One is 0.01745 rad" : "");
  };
  beyond("min_rad", joint.min_rad, range.min_rad, range.max_rad, "rad");
  beyond("max_rad", joint.max_rad, range.min_rad, range.max_rad, "rad");
  beyond("max_velocity_radps", joint.max_velocity_radps, 0, range.velocity_radps, "rad/s");
  beyond("max_effort_Nm", joint.max_effort_Nm, 0, range.effort_Nm, "Nm");
  beyond("stiffness_Nmprad", joint.stiffness_Nmprad, 0, range.stiffness_Nmprad, "Nm/rad");
  beyond("damping_Nmsprad", joint.damping_Nmsprad, 0, range.damping_Nmsprad, "Nm s/rad");
}

/// What drover-guard does with a weight. How heavy it is nobody says, only what may carry it.
std::string by_guard(const DeviceConfig& device, const engine::JointRules& joint,
                     const Actuator& driver) {
  constexpr std::string_view kDamping = "damping_Nmsprad";
  if (driver.stop_recipe().ends == StopEnds::holds) return "holds it";
  const double damping = device.options.has(kDamping) ? device.options.number(kDamping) : 0;
  if (damping <= 0) return "lets it fall";
  const auto two_digits = [](double value) {
    const double step = std::pow(10, std::floor(std::log10(value)) - 1);
    return text::number_text(std::round(value / step) * step);
  };
  return "only damps it: it comes down at " + two_digits(1 / damping) +
         " rad/s for each Nm of its weight, so with max_effort_Nm at " +
         two_digits(joint.max_effort_Nm / damping) + " rad/s (" + device_path(device, "options.") +
         std::string(kDamping) + " is " + text::number_text(damping) + ")";
}

/// A joint that carries a weight is held by its drive alone.
void warn_of_weight(const std::string& path, const DeviceConfig& device,
                    const engine::JointRules& joint, const Actuator& driver, Findings& found) {
  found.warn(path,
             "carries a weight: without power nothing holds it; when its line is cut its drive " +
                 std::string(driver.silence().text) + "; when droverd dies drover-guard " +
                 by_guard(device, joint, driver),
             "falls", "a brake, a spring or a counterweight");
}

/// Wheels that the guard lets roll, on ground where a task may end. Whether it is told.
bool warn_of_rolling(const DeviceConfig& device, const Actuator& driver, Findings& found) {
  constexpr const char* kPath = "groups.base.max_tilt_deg";
  constexpr double kLevel_deg = 3;
  const auto& base = found.config().engine.base;
  const bool of_base = driver.channels()[0].mode != ChannelMode::impedance;
  if (!of_base || driver.stop_recipe().ends != StopEnds::coasts) return false;
  if (base.hold != engine::HoldBy::level_ground_only || base.max_tilt_deg <= kLevel_deg)
    return false;
  found.warn(kPath,
             "is " + text::number_text(base.max_tilt_deg) +
                 ": where it may stand when droverd dies drover-guard can only let the wheels of " +
                 device_path(device) + " coast, and it rolls",
             "rolls", "3 or less, or a brake and \"hold\": \"brake\"");
  return true;
}

/// The joints of groups that the device moves; fills in what can be told to them.
void look_at_joints(const DeviceConfig& device, const Actuator& driver, Findings& found) {
  auto& engine = found.config().engine;
  for (auto& group : engine.groups)
    for (auto& joint : group.joints) {
      const auto place = static_cast<std::size_t>(joint.axis - device.first_axis);
      if (joint.axis < device.first_axis || place >= device.joints.size()) continue;
      const auto path = "groups." + std::string(group.name.view()) + ".joints." +
                        std::string(engine.joints[joint.axis].view());
      joint.drive = driver.impedance_range(device.joints[place].channel_index);
      look_at_range(path, joint, joint.drive, found);
      if (joint.carries_weight) warn_of_weight(path, device, joint, driver, found);
    }
}

/// Of what moves something: at another speed nobody hears it, and it hears no stop.
void look_at_speed(const DeviceConfig& device, Findings& found) {
  const auto* entry = find_driver(device.driver);
  const auto& links = found.config().links;
  if (entry == nullptr || entry->bauds.empty() || device.link_index >= links.size()) return;
  const auto& link = links[device.link_index];
  const auto path = link_path(link, "baud");
  if (link.wire != Wire::bytes || found.has_problem(device_path(device, "link")) ||
      found.has_problem(path))
    return;
  const auto& known = entry->bauds;
  if (std::find(known.begin(), known.end(), link.baud) != known.end()) return;
  std::string all;
  for (const int baud : known) all += (all.empty() ? "" : ", ") + std::to_string(baud);
  found.add(path,
            "is " + std::to_string(link.baud) + ", but " + device_path(device) + " (" +
                device.driver + ") speaks at " + all,
            known.size() == 1 ? "write that, or leave it out" : "");
}

/// Of a receiver: its positions alone have to fit through the line.
void look_at_rate(const DeviceConfig& device, Findings& found) {
  constexpr double kShortestPosition_B = 70;  // a GGA
  const auto& links = found.config().links;
  if (device.kind != SlotKind::gnss || device.link_index >= links.size()) return;
  if (!device.options.has("rate_Hz") || found.has_problem(device_path(device))) return;
  const auto& link = links[device.link_index];
  const double carried = link.baud / kBitsPerByte;
  const double rate_Hz = device.options.number("rate_Hz");
  if (link.wire != Wire::bytes || found.has_problem(link_path(link))) return;
  if (rate_Hz * kShortestPosition_B <= carried) return;
  found.hint_at(link_path(link, "baud"),
                "is " + std::to_string(link.baud) + ", which carries " +
                    text::number_text(carried) + " bytes a second, and " +
                    device_path(device, "options.rate_Hz") + " is " + text::number_text(rate_Hz) +
                    ": its positions alone take " +
                    text::number_text(rate_Hz * kShortestPosition_B),
                "a faster line, or fewer positions a second: at the receiver and here");
}

/// A driver begins with the option's name. Its speed stands at its link.
void refuse_options(const DeviceConfig& device, const LinkConfig* link, std::string_view why,
                    Findings& found) {
  constexpr std::string_view kSpeed = "baud ";
  if (link != nullptr && why.starts_with(kSpeed))
    found.add(link_path(*link, "baud"), std::string(why.substr(kSpeed.size())));
  else
    found.add(device_path(device, "options"), std::string(why));
}

/// What a driver says about options that do not fit together, it says when it is made.
Made build(const DeviceConfig& device, Findings& found) {
  const auto* entry = find_driver(device.driver);
  if (entry == nullptr || found.has_problem(device_path(device))) return {};
  const auto& links = found.config().links;
  const auto* link = device.link_index < links.size() ? &links[device.link_index] : nullptr;
  if (link != nullptr && found.has_problem(link_path(*link))) return {};  // options follow it
  try {
    return entry->make(device.options, context_of(device));
  } catch (const std::exception& error) {
    refuse_options(device, link, error.what(), found);
    return {};
  }
}

/// What a drive's own settings let it drive at the most, and which of them.
struct OwnSpeed {
  double mps = 0;
  std::string path;
};

std::optional<OwnSpeed> own_speed(const DroverConfig& config, const DeviceConfig& device) {
  const auto& options = device.options;
  if (options.has("max_speed_mps")) {
    return OwnSpeed{options.number("max_speed_mps"), device_path(device, "options.max_speed_mps")};
  }
  const auto& base = config.engine.base;
  if (!options.has("max_rpm") || engine::takes_twist(base.kind)) return std::nullopt;
  const double gear_ratio = options.has("gear_ratio") ? options.number("gear_ratio") : 1;
  const double wheel_radps = options.number("max_rpm") * 2 * std::numbers::pi / 60 / gear_ratio;
  return OwnSpeed{wheel_radps * base.wheel_radius_m, device_path(device, "options.max_rpm")};
}

/// The least of all drives'.
std::optional<OwnSpeed> slowest_drive(const DroverConfig& config) {
  std::optional<OwnSpeed> slowest;
  for (const auto& device : config.devices) {
    if (device.kind != SlotKind::drive) continue;
    auto own = own_speed(config, device);
    if (own && (!slowest || own->mps < slowest->mps)) slowest = std::move(own);
  }
  return slowest;
}

}  // namespace

double fastest_mps(const DroverConfig& config) {
  const double limit_mps = config.engine.limits.max_speed_mps;
  const auto slowest = slowest_drive(config);
  return slowest ? std::min(limit_mps, slowest->mps) : limit_mps;
}

/// It drives slower than it is told then, and the engine sees wheels that do not follow.
void warn_of_slow_chassis(Findings& found) {
  const auto& config = found.config();
  if (found.has_problem("limits") || found.has_problem("devices") || found.has_problem("groups"))
    return;
  const auto slowest = slowest_drive(config);
  if (!slowest || slowest->mps >= config.engine.limits.max_speed_mps) return;
  // Rounded down, so that what is proposed can be driven.
  const auto own = text::number_text(std::floor(slowest->mps * 1000) / 1000);
  found.warn("limits.max_speed_mps",
             "is " + text::number_text(config.engine.limits.max_speed_mps) + ", but with " +
                 slowest->path + " the base drives " + own +
                 " at the most: it does not follow what is faster",
             "slow_chassis", own + " or less");
}

void follow_baud_rates(Findings& found) {
  for (auto& device : found.config().devices)
    if (!found.has_problem(device_path(device, "link")) &&
        device.link_index < found.config().links.size())
      follow_baud(device, found.config().links[device.link_index], found);
}

void check_drivers(Findings& found) {
  BusIds ids(found);
  bool rolls = false;  // told of the first
  for (auto& device : found.config().devices) {
    look_at_speed(device, found);
    look_at_rate(device, found);
    const auto made = build(device, found);
    ids.take(device, made);
    if (made.actuator == nullptr) continue;
    const SilenceBehaviour silence = made.actuator->silence();
    device.goes_on_in_silence = !silence.stops;
    if (silence.stops) device.stops_after_ms = static_cast<int>(to_s(silence.after) * 1000);
    look_at_silence(device, *made.actuator, found);
    look_at_joints(device, *made.actuator, found);
    if (!rolls) rolls = warn_of_rolling(device, *made.actuator, found);
  }
}

}  // namespace drover::config
