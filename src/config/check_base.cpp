// The base: its wheels are drives, each on one side, or one device takes its twist.
#include <algorithm>

#include "config/check_subjects.h"
#include "text/number.h"
#include "text/suggestion.h"

namespace drover::config {
namespace {

/// By their axes.
std::vector<std::string> joint_names(const DroverConfig& config) {
  std::vector<std::string> names;
  for (const auto* device : by_axis(config))
    for (const auto& joint : device->joints) names.push_back(joint.name);
  return names;
}

engine::HoldBy hold_by(std::string_view word) {
  if (word == "brake") return engine::HoldBy::brake;
  return word == "worm_gear" ? engine::HoldBy::worm_gear : engine::HoldBy::level_ground_only;
}

engine::BaseKind base_kind(std::string_view word) {
  if (word == kTwistKind) return engine::BaseKind::twist;
  if (word == kAckermannKind) return engine::BaseKind::ackermann;
  if (word == kMecanumKind) return engine::BaseKind::mecanum;
  return word == "differential" ? engine::BaseKind::differential : engine::BaseKind::skid_steer;
}

/// Whether it may be the joint of a device whose driver, or whose joints, nobody knows.
bool is_told_of(const std::string& joint, Findings& found) {
  const auto& devices = found.config().devices;
  return found.is_wrong("devices") || found.is_wrong("devices." + joint) ||
         std::any_of(devices.begin(), devices.end(), [&](const auto& device) {
           const bool of_no_driver = device.name == joint && find_driver(device.driver) == nullptr;
           return of_no_driver || found.is_wrong(device_path(device, "joints"));
         });
}

bool is_told_twists(const DeviceConfig& device) {
  const auto* const entry = find_driver(device.driver);
  return entry != nullptr && takes_twist(*entry);
}

void side(const std::string& path, const std::vector<std::string>& joints,
          FixedVector<AxisId, engine::kMaxSide>& into, Findings& found) {
  const auto known = joint_names(found.config());
  for (const auto& joint : joints) {
    const auto it = std::find(known.begin(), known.end(), joint);
    if (it == known.end()) {
      if (is_told_of(joint, found)) continue;
      found.add(path, "no device has the joint \"" + joint + "\"",
                text::did_you_mean(joint, known));
      continue;
    }
    const auto axis = static_cast<AxisId>(it - known.begin());
    if (std::find(into.begin(), into.end(), axis) != into.end())
      found.add(path, "the joint \"" + joint + "\" is there twice");
    else
      (void)into.push_back(axis);  // too many are told by the reader
  }
}

/// A wheel is told how fast it shall turn.
void follow_velocities(const BaseNames& base, Findings& found) {
  for (const auto* device : by_axis(found.config())) {
    const auto* const entry = find_driver(device->driver);
    if (entry == nullptr || entry->channels.empty()) continue;
    if (entry->channels[0].mode != ChannelMode::impedance) continue;
    for (const auto& joint : device->joints)
      for (const auto* side : {&base.left, &base.right})
        if (std::find(side->begin(), side->end(), joint.name) != side->end())
          found.add(side == &base.left ? "groups.base.left" : "groups.base.right",
                    "the drive of \"" + joint.name + "\" (" + device->driver +
                        ") is for joints outside the base",
                    "a wheel needs a drive that follows a velocity");
  }
}

void both_sides(const BaseNames& base, Findings& found) {
  for (const auto& joint : base.left)
    if (std::find(base.right.begin(), base.right.end(), joint) != base.right.end())
      found.add("groups.base.right", "the joint \"" + joint + "\" is on both sides");
}

/// Its faults, its silence and its stop would be nobody's.
void nothing_else_moves(const GroupNames& groups, Findings& found) {
  const BaseNames& base = groups.base;
  if (found.has_problem("groups.base")) return;
  const bool has_wheels = !is_told_a_twist(base.kind);
  const auto among = [&](const std::vector<std::string>& side, const std::string& joint) {
    return has_wheels && std::find(side.begin(), side.end(), joint) != side.end();
  };
  for (const auto& device : found.config().devices) {
    for (const auto& joint : device.joints) {
      if (among(base.left, joint.name) || among(base.right, joint.name)) continue;
      if (has_joint(groups.others, joint.name)) continue;
      if (found.is_wrong("groups")) continue;
      found.add(device_path(device), "\"" + joint.name + "\" is of no group",
                has_wheels ? "name it in groups.base.left or groups.base.right, or give it a group "
                             "of its own: groups.arm.joints"
                           : "give it a group of its own: groups.arm.joints");
    }
    if (!is_told_twists(device) || device.name == base.device) continue;
    found.add(device_path(device), "it takes a twist, and is not the device of the base",
              has_wheels ? "\"kind\": \"twist\", \"device\": \"" + device.name + "\" in groups.base"
                         : "leave the device out");
  }
}

/// Which wheel is where decides what goes sideways.
void four_corners(const BaseNames& base, Findings& found) {
  for (const auto* side : {&base.left, &base.right})
    if (!side->empty() && side->size() != 2)
      found.add(side == &base.left ? "groups.base.left" : "groups.base.right",
                "a mecanum base has two wheels on each side", "the front one, then the rear one");
}

/// What one turn a second of a wheel is to its drive.
bool is_of_units(std::string_view option) {
  return option == "gear_ratio" || option.find("units") != option.npos;
}

/// Of two drives of one kind: one turns faster than the other by what differs.
void same_units(const DeviceConfig& first, const DeviceConfig& other, Findings& found) {
  for (const auto& [key, value] : other.options.all()) {
    if (!is_of_units(key) || !std::holds_alternative<double>(value)) continue;
    if (!first.options.has(key) || first.options.all().at(key) == value) continue;
    const auto path = "options." + key;
    found.hint_at(
        device_path(other, path),
        "is " + text::number_text(other.options.number(key)) + ", but " +
            text::number_text(first.options.number(key)) + " in " + device_path(first, path) +
            ": the wheels of one base " +
            (key == "gear_ratio" ? "have different gears" : "are told in different units") +
            "; is that meant?",
        "");
  }
}

void alike(const BaseNames& base, Findings& found) {
  std::vector<const DeviceConfig*> of_wheels;
  for (const auto& device : found.config().devices)
    for (const auto& joint : device.joints)
      for (const auto* side : {&base.left, &base.right})
        if (std::find(side->begin(), side->end(), joint.name) != side->end() &&
            (of_wheels.empty() || of_wheels.back() != &device))
          of_wheels.push_back(&device);
  for (const auto* device : of_wheels) {
    const auto first = std::find_if(of_wheels.begin(), of_wheels.end(), [&](const auto* each) {
      return each->driver == device->driver;
    });
    if (*first != device) same_units(**first, *device, found);
  }
}

void wheels(const BaseNames& base, Findings& found) {
  auto& resolved = found.config().engine.base;
  side("groups.base.left", base.left, resolved.left, found);
  side("groups.base.right", base.right, resolved.right, found);
  both_sides(base, found);
  if (base.kind == kMecanumKind) four_corners(base, found);
  follow_velocities(base, found);
  alike(base, found);
}

/// What is told twice, once to who drives and once to who speaks to the device.
void same_number(const DeviceConfig& device, const char* key, double number, Findings& found) {
  if (!device.options.has(key) || device.options.number(key) == number) return;
  found.add(std::string("groups.base.") + key,
            "is " + text::number_text(number) + ", but " +
                text::number_text(device.options.number(key)) + " in " +
                device_path(device, std::string("options.") + key),
            "the same in both places");
}

/// "an agilex_v2".
std::string with_article(const std::string& driver) {
  const bool vowel = std::string_view("aeiou").find(driver.front()) != std::string_view::npos;
  return (vowel ? "an " : "a ") + driver;
}

/// One that steers is told no turn on the spot, and one that does not has no angle.
void steering(const BaseNames& base, const DeviceConfig& device, const DriverEntry& entry,
              Findings& found) {
  const bool steers = base.kind == kAckermannKind;
  if (entry.steers != steers) {
    found.add("groups.base.kind",
              "\"" + device.name + "\" is " + with_article(device.driver) + ", which " +
                  (entry.steers ? "steers" : "does not steer"),
              entry.steers ? "\"kind\": \"ackermann\"" : "\"kind\": \"twist\"");
    return;
  }
  if (!steers) return;
  const auto& numbers = *base.base;
  same_number(device, "wheelbase_m", numbers.wheelbase_m, found);
  same_number(device, "track_m", numbers.track_m, found);
  if (device.options.has("max_steering_rad") &&
      numbers.max_steering_rad > device.options.number("max_steering_rad"))
    found.add("groups.base.max_steering_rad",
              "is above " + text::number_text(device.options.number("max_steering_rad")) +
                  ", the most of " + device.driver);
}

void twist_device(const BaseNames& base, Findings& found) {
  constexpr auto kPath = "groups.base.device";
  if (base.device.empty()) return;  // told by the reader
  const auto& devices = found.config().devices;
  const auto it = std::find_if(devices.begin(), devices.end(),
                               [&](const auto& device) { return device.name == base.device; });
  if (it == devices.end()) {
    const auto names = collect(devices, [](const auto& device) { return device.name; });
    found.add(kPath, "there is no device \"" + base.device + "\"",
              text::did_you_mean(base.device, names));
  } else if (find_driver(it->driver) != nullptr && !is_told_twists(*it)) {
    found.add(kPath, "\"" + base.device + "\" takes no twist: it is " + with_article(it->driver),
              "a base of another kind names the joints of its wheels");
  } else if (const auto* const entry = find_driver(it->driver); entry != nullptr) {
    steering(base, *it, *entry, found);
  }
}

}  // namespace

void check_base(const GroupNames& groups, Findings& found) {
  const BaseNames& base = groups.base;
  auto& resolved = found.config().engine.base;
  if (is_told_a_twist(base.kind))
    twist_device(base, found);
  else
    wheels(base, found);
  nothing_else_moves(groups, found);
  if (found.config().protocol.vz == "steering_angle" && base.kind != kAckermannKind)
    found.add("protocol.vz", "is steering_angle, but this base does not steer",
              "\"vz\": \"yaw_rate\"");
  resolved.hold = hold_by(base.hold);
  resolved.kind = base_kind(base.kind);
}

}  // namespace drover::config
