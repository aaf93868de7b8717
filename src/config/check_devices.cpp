// The devices: each on a link of its wire, and what two may not share.
#include <algorithm>
#include <array>
#include <map>
#include <span>

#include "config/check_subjects.h"
#include "config/taken.h"
#include "text/number.h"

namespace drover::config {
namespace {

/// A serial line has one device; on a Modbus line they have addresses.
void check_company(const DeviceConfig& device, const LinkConfig& link,
                   std::map<std::string, std::string>& first, Findings& found) {
  if (link.wire != Wire::bytes) return;
  const auto [it, inserted] = first.emplace(link.name, device_path(device));
  if (inserted) return;
  found.add(device_path(device, "link"),
            "\"" + link.name + "\" is a serial line, and " + it->second + " hangs on it");
}

void hang(DeviceConfig& device, std::map<std::string, std::string>& first, Findings& found) {
  const auto path = device_path(device, "link");
  const auto* link = find_link(device.link, path, found);
  if (link == nullptr) return;
  device.link_index = static_cast<std::size_t>(link - found.config().links.data());
  if (found.has_problem(link_path(*link))) return;
  const auto* entry = find_driver(device.driver);
  if (entry == nullptr) return;
  if (entry->wire == link->wire) return check_company(device, *link, first, found);
  const bool same_port = link->wire == Wire::bytes && entry->wire == Wire::registers;
  found.add(path,
            "\"" + link->name + "\" is " + std::string(words(link->wire)) + ", but " +
                device.driver + " hangs on " + std::string(words(entry->wire)),
            same_port
                ? link_path(*link) + ": \"modbus\": \"" + link->serial + "\" in place of \"serial\""
                : "");
}

void addresses(Findings& found) {
  std::map<std::string, std::string> first;
  for (const auto& device : found.config().devices) {
    for (const char* const key : {"node", "id"}) {
      if (!device.options.has(key)) continue;
      const auto path = device_path(device, std::string("options.") + key);
      const auto address = device.link + ", " + device.driver + " " + key + " " +
                           text::number_text(device.options.number(key));
      const auto [it, inserted] = first.emplace(address, path);
      if (!inserted)
        found.add(path,
                  "two devices have one address (" + address + "): the other is " + it->second);
    }
  }
}

std::string names_of(std::span<const Channel> channels) {
  std::string names;
  for (const auto& channel : channels)
    names += (names.empty() ? "" : ", ") + std::string(channel.name);
  return names;
}

/// The channels of a device by the joints that name them: each by one.
void name_channels(DeviceConfig& device, std::span<const Channel> channels, Findings& found) {
  std::vector<const JointConfig*> by(channels.size());
  for (auto& joint : device.joints) {
    const auto path = device_path(device, "joints." + joint.name);
    if (joint.channel.empty() && channels.size() == 1) joint.channel = channels[0].name;
    const auto it = std::find_if(channels.begin(), channels.end(),
                                 [&](const auto& each) { return each.name == joint.channel; });
    if (it == channels.end()) {
      if (found.is_wrong(path + ".channel")) continue;
      const auto what = joint.channel.empty() ? "names no channel" : "there is no such channel";
      found.add(path + ".channel", what, "one of: " + names_of(channels));
      continue;
    }
    joint.channel_index = static_cast<std::size_t>(it - channels.begin());
    auto& first = by[joint.channel_index];
    if (first != nullptr)
      found.add(path + ".channel",
                "\"" + joint.channel + "\" is the joint \"" + first->name + "\" already");
    first = &joint;
  }
  for (std::size_t i = 0; i < channels.size(); ++i)
    if (by[i] == nullptr && !found.has_problem(device_path(device, "joints")))
      found.add(device_path(device, "joints"),
                "no joint is the channel \"" + std::string(channels[i].name) + "\"",
                device.driver + " moves: " + names_of(channels));
}

}  // namespace

void check_devices(Findings& found) {
  std::map<std::string, std::string> first;
  for (auto& device : found.config().devices) {
    if (const auto* entry = find_driver(device.driver)) device.kind = entry->kind;
    hang(device, first, found);
  }
  check_roles(found);
  addresses(found);
  check_buses(found);
}

void check_joints(Findings& found) {
  Taken taken(found);
  for (auto& device : found.config().devices) {
    const auto* entry = find_driver(device.driver, SlotKind::drive);
    if (entry == nullptr) continue;
    if (takes_twist(*entry)) {
      device.joints.clear();  // told by the reader
      continue;
    }
    for (const auto& joint : device.joints)
      taken.take(joint.name, device_path(device, "joints." + joint.name));
    if (device.joints.empty() && entry->channels.size() == 1) {
      device.joints.push_back({"", device.name});
      taken.take(device.name, device_path(device));
    }
    name_channels(device, entry->channels, found);
  }
}

void number_joints(const std::vector<JointGroup>& groups, Findings& found) {
  const auto of_group = [&](const DeviceConfig& device) {
    return std::any_of(device.joints.begin(), device.joints.end(),
                       [&](const auto& joint) { return has_joint(groups, joint.name); });
  };
  std::size_t axes = 0;
  for (const bool beside_the_base : {false, true}) {
    for (auto& device : found.config().devices) {
      if (device.joints.empty() || of_group(device) != beside_the_base) continue;
      device.first_axis = static_cast<AxisId>(axes);
      axes += device.joints.size();
      if (axes > kMaxAxes)
        found.add(device_path(device),
                  "is one joint too many: there may be " + std::to_string(kMaxAxes));
    }
  }
}

void check_lines(Findings& found) {
  auto& config = found.config();
  Taken lines(found);
  Taken kinds(found);
  const auto line = [&](const std::string& link, const std::string& name, const std::string& path) {
    lines.take(link + " " + name, path, name);
  };
  for (const auto& device : config.devices) {
    if (device.kind != SlotKind::line) continue;
    line(device.link, device.line, device_path(device, "line"));
    kinds.take(device.is, device_path(device, "is"));
  }
  auto& outputs = config.outputs;
  if (!found.given("outputs")) return;
  const auto* link = find_link(outputs.link, "outputs.link", found);
  if (link != nullptr && link->wire != Wire::levels && !found.has_problem(link_path(*link)))
    found.add("outputs.link", "\"" + link->name + "\" is " + std::string(words(link->wire)) +
                                  ", but outputs are lines of " + std::string(words(Wire::levels)));
  if (link != nullptr) outputs.chip = link->gpio;
  const auto output = [&](const std::string& key, const OutputConfig& one) {
    if (one.configured) line(outputs.link, one.name, "outputs." + key + ".line");
  };
  constexpr std::array<const char*, kOutputCount> kKeys{"enable_relay", "lamp", "buzzer"};
  for (std::size_t i = 0; i < kOutputCount; ++i) output(kKeys[i], outputs.output[i]);
  output("watchdog", outputs.watchdog);
}

}  // namespace drover::config
