// The batteries: their register maps, and the lines that they share.
#include <algorithm>
#include <string>
#include <utility>

#include "config/check_subjects.h"
#include "config/register_map.h"
#include "config/taken.h"

namespace drover::config {
namespace {

/// The register maps that devices name, each read once.
class Maps final {
 public:
  Maps(const std::string& folder, Findings& found)
      : folder_(folder), found_(found), given_(!found.loaded().register_map.empty()) {
    if (!given_) return;
    std::string_view left = found.loaded().register_map;
    for (auto end = left.find(kMapsEnd); end != left.npos; end = left.find(kMapsEnd)) {
      texts_.emplace_back(left.substr(0, end));
      left.remove_prefix(end + 1);
    }
    texts_.emplace_back(left);
  }

  RegisterMap read(const DeviceConfig& device) {
    const auto path = device_path(device, "map");
    const auto known = std::find(names_.begin(), names_.end(), device.map);
    if (known != names_.end()) return maps_[static_cast<std::size_t>(known - names_.begin())];
    const auto place = names_.size();
    if (const auto missing = given_ ? MissingMap{} : missing_register_map(device.map, folder_);
        !missing.message.empty()) {
      found_.add(path, missing.message, missing.hint);
      return {};
    }
    auto loaded = !given_ ? load_register_map(find_register_map(device.map, folder_))
                          : parse_register_map(place < texts_.size() ? texts_[place] : "");
    if (!given_) texts_.push_back(std::move(loaded.text));
    if (!loaded.problems.empty())
      found_.add(path, "is no good register map", "see its own problems");
    for (auto& problem : loaded.problems) found_.loaded().problems.push_back(std::move(problem));
    for (auto& warning : loaded.warnings) found_.loaded().warnings.push_back(std::move(warning));
    names_.push_back(device.map);
    return maps_.emplace_back(std::move(loaded.map));
  }

  std::string joined() const {
    std::string all;
    for (const auto& text : texts_)
      all += (&text == texts_.data() ? "" : std::string(1, kMapsEnd)) + text;
    return all;
  }

 private:
  const std::string& folder_;
  Findings& found_;
  const bool given_;
  std::vector<std::string> texts_;
  std::vector<std::string> names_;
  std::vector<RegisterMap> maps_;
};

/// Units of one line are told apart by their addresses, and speak at one pace.
void share_line(const DeviceConfig& device, Taken& taken, Findings& found) {
  auto& links = found.config().links;
  if (device.link_index >= links.size() || found.has_problem(device_path(device, "link"))) return;
  auto& link = links[device.link_index];
  if (link.wire != Wire::registers) return;
  const auto unit = "unit " + std::to_string(device.unit) + " of " + link.name;
  taken.take(unit, device_path(device, "unit"));
  if (link.baud == 0) {
    link.baud = device.registers.baud;
  } else if (link.baud != device.registers.baud && !found.given(link_path(link, "baud"))) {
    found.add(link_path(link),
              "its devices are usually asked at " + std::to_string(link.baud) + " and at " +
                  std::to_string(device.registers.baud) + " baud",
              "set both to one speed, and write it here as baud");
  }
}

/// What all hear nobody answers; and 0 is not "its usual one" to who writes it.
void refuse_broadcast(const DeviceConfig& device, Findings& found) {
  const auto path = device_path(device, "unit");
  if (device.unit != 0 || !found.given(path) || found.is_wrong(path)) return;
  found.add(path, "is 0, which all units hear and none answers",
            "leave it out for its usual one, " + std::to_string(device.registers.unit));
}

/// None of its devices is known to speak so. Who hangs two on one line has to set one of them.
void compare_speeds(Findings& found) {
  const auto& config = found.config();
  for (const auto& link : config.links) {
    const auto path = link_path(link, "baud");
    if (link.wire != Wire::registers || !found.given(path) || found.has_problem(path)) continue;
    const DeviceConfig* slip = nullptr;
    bool usual = false;
    for (const auto& device : config.devices) {
      if (device.link != link.name || device.registers.fields.empty()) continue;
      usual = usual || device.registers.baud == link.baud;
      if (slip == nullptr) slip = &device;
    }
    if (usual || slip == nullptr) continue;
    found.hint_at(path,
                  "is " + std::to_string(link.baud) + ", but by its map " + device_path(*slip) +
                      " speaks at " + std::to_string(slip->registers.baud),
                  "leave it out, unless the device was set to it");
  }
}

}  // namespace

void check_batteries(const std::string& folder, Findings& found) {
  Maps maps(folder, found);
  Taken units(found);
  for (auto& device : found.config().devices) {
    if (device.kind != SlotKind::battery || found.has_problem(device_path(device, "map"))) continue;
    device.registers = maps.read(device);
    if (found.has_problem(device_path(device, "map"))) continue;
    refuse_broadcast(device, found);
    if (device.unit == 0) device.unit = device.registers.unit;
    share_line(device, units, found);
  }
  compare_speeds(found);
  found.loaded().register_map = maps.joined();
}

}  // namespace drover::config
