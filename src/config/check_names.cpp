// Names and addresses that refer to each other, and what two may not share.
#include <algorithm>
#include <filesystem>
#include <map>

#include "config/check_subjects.h"
#include "text/number.h"
#include "text/suggestion.h"

namespace drover::config {
namespace {

/// What has a name already; two may not share one.
class Taken final {
 public:
  explicit Taken(Findings& found) : found_(found) {}

  /// Empty names were told already.
  void take(const std::string& name, const std::string& path) {
    if (name.empty()) return;
    const auto [it, inserted] = first_.emplace(name, path);
    if (!inserted) found_.add(path, "\"" + name + "\" is used by " + it->second + " already");
  }
  void forget() { first_.clear(); }

 private:
  Findings& found_;
  std::map<std::string, std::string> first_;
};

void unique(std::string_view list, std::string_view key, const std::vector<std::string>& names,
            Findings& found) {
  Taken taken(found);
  for (std::size_t i = 0; i < names.size(); ++i)
    taken.take(names[i], item(list, i) + "." + std::string(key));
}

void unique_names(Findings& found) {
  const auto joints = collect(found.config().drives, [](const auto& d) { return d.joint; });
  unique("buses", "name", collect(found.config().buses, [](const auto& b) { return b.name; }),
         found);
  unique("buses", "interface",
         collect(found.config().buses, [](const auto& b) { return b.interface; }), found);
  unique("drives", "joint", joints, found);
  for (std::size_t i = 0; i < joints.size(); ++i)
    if (Name(joints[i]).view() != joints[i]) found.add(item("drives", i) + ".joint", "is too long");
}

void buses_of_drives(Findings& found) {
  const auto buses = collect(found.config().buses, [](const auto& b) { return b.name; });
  for (std::size_t i = 0; i < found.config().drives.size(); ++i) {
    auto& drive = found.config().drives[i];
    const auto path = item("drives", i) + ".bus";
    const auto bus = std::find(buses.begin(), buses.end(), drive.bus);
    if (bus != buses.end()) {
      drive.bus_index = static_cast<std::size_t>(bus - buses.begin());
    } else if (!found.has_problem(path)) {
      found.add(path, "there is no bus named \"" + drive.bus + "\"",
                text::did_you_mean(drive.bus, buses));
    }
  }
}

void addresses(Findings& found) {
  std::map<std::string, std::string> first;
  for (std::size_t i = 0; i < found.config().drives.size(); ++i) {
    const auto& drive = found.config().drives[i];
    if (!drive.options.has("node")) continue;
    const auto path = item("drives", i) + ".options.node";
    const auto address = drive.bus + ", " + drive.driver + " node " +
                         text::number_text(drive.options.number("node"));
    const auto [it, inserted] = first.emplace(address, path);
    if (!inserted)
      found.add(path, "two drives have one address (" + address + "): the other is " + it->second);
  }
}

}  // namespace

void check_drive_names(Findings& found) {
  unique_names(found);
  buses_of_drives(found);
  addresses(found);
}

void check_lines(Findings& found) {
  const auto& config = found.config();
  Taken taken(found);
  for (std::size_t i = 0; i < kLineCount; ++i)
    if (const auto& line = config.lines.line[i]; line.configured)
      taken.take(line.name, "lines." + std::string(kLineKeys[i]) + ".line");
  if (config.outputs.chip != config.lines.chip) taken.forget();
  const auto output = [&](const std::string& key, const OutputConfig& line) {
    if (line.configured) taken.take(line.name, "outputs." + key + ".line");
  };
  constexpr std::array<const char*, kOutputCount> kKeys{"enable_relay", "lamp", "buzzer"};
  for (std::size_t i = 0; i < kOutputCount; ++i) output(kKeys[i], config.outputs.output[i]);
  output("watchdog", config.outputs.watchdog);
}

/// One program opens a serial line; two would take each other's bytes.
void check_ports(Findings& found) {
  std::map<std::string, std::string> first;
  const auto port = [&](const std::string& section, bool configured, const std::string& path) {
    if (!configured || path.empty()) return;
    const auto plain = std::filesystem::path(path).lexically_normal().string();
    const auto [it, inserted] = first.emplace(plain, section + ".port");
    if (!inserted)
      found.add(section + ".port",
                "two devices on one port (" + path + "): the other is " + it->second);
  };
  port("gnss", found.config().gnss.configured, found.config().gnss.port);
  port("imu", found.config().imu.configured, found.config().imu.port);
  port("battery", found.config().battery.configured, found.config().battery.port);
}

}  // namespace drover::config
