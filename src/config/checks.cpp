#include "config/checks.h"

#include <algorithm>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <map>
#include <variant>

#include "config/register_map.h"
#include "text/number.h"
#include "text/suggestion.h"
#include "text/url.h"

namespace drover::config {

namespace {

using text::did_you_mean;
using text::number_text;

constexpr std::array<std::string_view, kLineCount> kLineKeys{"estop", "bumper", "zone_far",
                                                             "zone_near"};

template <class T, class Get>
std::vector<std::string> collect(const std::vector<T>& items, Get get) {
  std::vector<std::string> names;
  names.reserve(items.size());
  for (const auto& item : items) names.push_back(get(item));
  return names;
}

std::string item(std::string_view list, std::size_t index) {
  return std::string(list) + "[" + std::to_string(index) + "]";
}

/// The value at a path like "drives[1].options.node", or as much of the way as is there.
const json::Node& place(const json::Node& root, std::string_view path) {
  const auto end = path.find_first_of(".[", 1);
  const auto step = path.substr(0, end);
  const json::Node* next = nullptr;
  if (step.starts_with('[')) {
    const auto index = static_cast<std::size_t>(std::stoul(std::string(step.substr(1))));
    if (root.list() != nullptr && index < root.list()->size()) next = &(*root.list())[index];
  } else {
    next = root.find(step.starts_with('.') ? step.substr(1) : step);
  }
  if (next == nullptr) return root;
  return end == path.npos ? *next : place(*next, path.substr(end));
}

/// "" when a battery's port is a device or tcp:ADDRESS:PORT. No names: to resolve one may take
/// longer than anything here waits.
std::string check_modbus_port(const std::string& port) {
  if (!port.starts_with("tcp:")) return "";
  unsigned a = 0;
  unsigned b = 0;
  unsigned c = 0;
  unsigned d = 0;
  unsigned number = 0;
  int used = 0;
  const int got =
      std::sscanf(port.c_str(), "tcp:%3u.%3u.%3u.%3u:%5u%n", &a, &b, &c, &d, &number, &used);
  const bool good = got == 5 && static_cast<std::size_t>(used) == port.size() &&
                    std::max({a, b, c, d}) <= 255 && number >= 1 && number <= 65535;
  return good ? "" : "must be tcp:ADDRESS:PORT with an IPv4 address, like tcp:192.168.1.50:502";
}

engine::HoldBy hold_by(std::string_view word) {
  if (word == "brake") return engine::HoldBy::brake;
  return word == "worm_gear" ? engine::HoldBy::worm_gear : engine::HoldBy::level_ground_only;
}

class Checks final {
 public:
  Checks(const json::Node& root, const std::string& folder, Loaded& loaded)
      : root_(root), folder_(folder), loaded_(loaded), config_(loaded.config) {}

  void run(const BaseNames& base) {
    unique_names();
    buses_of_drives();
    addresses();
    side("base.left", base.left, config_.engine.base.left);
    side("base.right", base.right, config_.engine.base.right);
    both_sides(base);
    wheels_only(base);
    config_.engine.base.hold = hold_by(base.hold);
    unique_lines();
    limits();
    broker();
    channel();
    battery();
    finish_engine();
    build_drivers();
    ports();
    accepted();
    warnings();
  }

 private:
  void add(std::string path, std::string message, std::string hint = {}) {
    const auto& at = place(root_, path);
    loaded_.problems.push_back(
        {at.line, at.column, std::move(path), std::move(message), std::move(hint), ""});
  }
  bool given(std::string_view section, std::string_view object, std::string_view key) const {
    const auto* outer = root_.find(section);
    const auto* inner = outer != nullptr ? outer->find(object) : nullptr;
    return inner != nullptr && inner->find(key) != nullptr;
  }
  bool has_problem(std::string_view path) const {
    return std::any_of(loaded_.problems.begin(), loaded_.problems.end(),
                       [path](const auto& p) { return p.path.starts_with(path); });
  }

  /// Empty names were told already.
  void unique(std::string_view list, std::string_view key, const std::vector<std::string>& names) {
    std::map<std::string, std::string> first;
    for (std::size_t i = 0; i < names.size(); ++i) {
      const auto path = item(list, i) + "." + std::string(key);
      const auto [it, inserted] = first.emplace(names[i], path);
      if (!inserted && !names[i].empty())
        add(path, "\"" + names[i] + "\" is used by " + it->second + " already");
    }
  }
  void unique_names() {
    const auto joints = collect(config_.drives, [](const auto& d) { return d.joint; });
    unique("buses", "name", collect(config_.buses, [](const auto& b) { return b.name; }));
    unique("buses", "interface", collect(config_.buses, [](const auto& b) { return b.interface; }));
    unique("drives", "joint", joints);
    for (std::size_t i = 0; i < joints.size(); ++i)
      if (Name(joints[i]).view() != joints[i]) add(item("drives", i) + ".joint", "is too long");
  }

  void buses_of_drives() {
    const auto buses = collect(config_.buses, [](const auto& b) { return b.name; });
    for (std::size_t i = 0; i < config_.drives.size(); ++i) {
      auto& drive = config_.drives[i];
      const auto path = item("drives", i) + ".bus";
      const auto bus = std::find(buses.begin(), buses.end(), drive.bus);
      if (bus != buses.end()) {
        drive.bus_index = static_cast<std::size_t>(bus - buses.begin());
      } else if (!has_problem(path)) {
        add(path, "there is no bus named \"" + drive.bus + "\"", did_you_mean(drive.bus, buses));
      }
    }
  }

  void addresses() {
    std::map<std::string, std::string> first;
    for (std::size_t i = 0; i < config_.drives.size(); ++i) {
      const auto& drive = config_.drives[i];
      if (!drive.options.has("node")) continue;
      const auto path = item("drives", i) + ".options.node";
      const auto address =
          drive.bus + ", " + drive.driver + " node " + number_text(drive.options.number("node"));
      const auto [it, inserted] = first.emplace(address, path);
      if (!inserted)
        add(path, "two drives have one address (" + address + "): the other is " + it->second);
    }
  }

  void side(const std::string& path, const std::vector<std::string>& joints,
            FixedVector<AxisId, 8>& into) {
    const auto known = collect(config_.drives, [](const auto& d) { return d.joint; });
    for (const auto& joint : joints) {
      const auto it = std::find(known.begin(), known.end(), joint);
      if (it == known.end()) {
        add(path, "no drive has the joint \"" + joint + "\"", did_you_mean(joint, known));
        continue;
      }
      const auto axis = static_cast<AxisId>(it - known.begin());
      if (std::find(into.begin(), into.end(), axis) != into.end())
        add(path, "the joint \"" + joint + "\" is there twice");
      else
        (void)into.push_back(axis);  // too many are told by the reader
    }
  }
  void both_sides(const BaseNames& base) {
    for (const auto& joint : base.left)
      if (std::find(base.right.begin(), base.right.end(), joint) != base.right.end())
        add("base.right", "the joint \"" + joint + "\" is on both sides");
  }

  /// Its faults, its silence and its stop would be nobody's.
  void wheels_only(const BaseNames& base) {
    if (has_problem("base.")) return;
    const auto among = [](const std::vector<std::string>& side, const std::string& joint) {
      return std::find(side.begin(), side.end(), joint) != side.end();
    };
    for (std::size_t i = 0; i < config_.drives.size(); ++i) {
      const auto& joint = config_.drives[i].joint;
      if (joint.empty() || among(base.left, joint) || among(base.right, joint)) continue;
      add(item("drives", i) + ".joint",
          "\"" + joint +
              "\" is no wheel of the base: joints outside the base are not supported yet",
          "name it in base.left or base.right, or leave the drive out");
    }
  }

  void unique_lines() {
    std::map<std::string, std::string> first;
    for (std::size_t i = 0; i < kLineCount; ++i) {
      const auto& line = config_.lines.line[i];
      if (!line.configured || line.name.empty()) continue;
      const auto path = "lines." + std::string(kLineKeys[i]) + ".line";
      const auto [it, inserted] = first.emplace(line.name, path);
      if (!inserted) add(path, "\"" + line.name + "\" is used by " + it->second + " already");
    }
    if (config_.outputs.chip != config_.lines.chip) first.clear();
    const auto output = [&](const std::string& key, const OutputConfig& line) {
      if (!line.configured || line.name.empty()) return;
      const auto [it, inserted] = first.emplace(line.name, "outputs." + key + ".line");
      if (!inserted)
        add("outputs." + key + ".line",
            "\"" + line.name + "\" is used by " + it->second + " already");
    };
    constexpr std::array<const char*, kOutputCount> kKeys{"enable_relay", "lamp", "buzzer"};
    for (std::size_t i = 0; i < kOutputCount; ++i) output(kKeys[i], config_.outputs.output[i]);
    output("watchdog", config_.outputs.watchdog);
  }

  void limits() {
    const auto& engine = config_.engine;
    if (engine.health.battery_critical_percent > engine.health.battery_low_percent)
      add("health.battery_critical_percent", "is above health.battery_low_percent");
    if (engine.health.battery_hot_degC > engine.health.battery_too_hot_degC)
      add("health.battery_hot_degC", "is above health.battery_too_hot_degC");
    if (engine.limits.min_speed_mps > engine.limits.max_speed_mps)
      add("limits.min_speed_mps", "is above limits.max_speed_mps");
    if (engine.estimate.bound_start_m > engine.estimate.bound_run_m)
      add("estimate.bound_start_m", "is above estimate.bound_run_m",
          "a task would start and pause at once");
    constexpr double kBeats = 2.5;  // two lost cycles are no failure
    const double least_ms = kBeats * 1e3 / config_.control.tick_Hz;
    if (config_.guard.limit_ms < least_ms)
      add("guard.limit_ms",
          "is shorter than 2.5 control cycles (" + number_text(least_ms) + " ms)");
  }

  void broker() {
    const bool is_path = config_.mqtt.host.starts_with('/');
    if (is_path && config_.mqtt.port != 0)
      add("mqtt.port", "must be 0 when mqtt.host is the path of a Unix socket");
    if (!is_path && config_.mqtt.port == 0 && !has_problem("mqtt.port"))
      add("mqtt.port", "is 0, but mqtt.host is no path of a Unix socket", "1883 is usual");
    if (!config_.mqtt.password_file.empty() && config_.mqtt.username.empty())
      add("mqtt.password_file", "is given without mqtt.username");
  }

  void channel() {
    const auto& aimrt = config_.aimrt;
    for (const auto& [key, topic] : {std::pair{"joint_state", &aimrt.joint_state},
                                     {"imu_state", &aimrt.imu_state},
                                     {"touch_state", &aimrt.touch_state},
                                     {"joint_command", &aimrt.joint_command}}) {
      // An MQTT topic of AimRT has at most 255 bytes, and 59 stand around this one.
      constexpr std::size_t kLongest = 196;
      const auto path = "aimrt." + std::string(key);
      if (topic->empty()) add(path, "is empty");
      if (text::url_encoded(*topic).size() > kLongest)
        add(path, "is too long", "at most 196 bytes; / and other signs count three");
    }
  }

  void follow_baud(const std::string& section, int baud, Options& options) {
    if (!options.has("baud")) return;
    if (given(section, "options", "baud") && options.number("baud") != baud)
      add(section + ".options.baud", "differs from " + section + ".baud",
          "leave it out: it follows " + section + ".baud");
    options.set("baud", static_cast<double>(baud));
  }

  void battery() {
    auto& battery = config_.battery;
    if (!battery.configured || has_problem("battery.map")) return;
    if (const auto why = check_modbus_port(battery.port); !why.empty()) add("battery.port", why);
    auto loaded = loaded_.register_map.empty()
                      ? load_register_map(find_register_map(battery.map, folder_))
                      : parse_register_map(loaded_.register_map);
    loaded_.register_map = std::move(loaded.text);
    if (!loaded.problems.empty())
      add("battery.map", "is no good register map", "see its own problems");
    for (auto& problem : loaded.problems) loaded_.problems.push_back(std::move(problem));
    battery.registers = std::move(loaded.map);
    if (battery.baud == 0) battery.baud = battery.registers.baud;
    if (battery.unit == 0) battery.unit = battery.registers.unit;
  }

  void finish_engine() {
    auto& c = config_;
    c.engine.tick_Hz = c.control.tick_Hz;
    // The driver places each byte in time by the pace at which the line is really opened.
    follow_baud("gnss", c.gnss.baud, c.gnss.options);
    follow_baud("imu", c.imu.baud, c.imu.options);
    c.engine.health.guard_required = c.guard.required;
    c.engine.battery_configured = c.battery.configured;
    for (const auto& drive : c.drives) (void)c.engine.joints.push_back(Name(drive.joint));
    for (std::size_t i = 0; i < kLineCount; ++i)
      c.engine.line_configured[i] = c.lines.line[i].configured;
    for (std::size_t i = 0; i < kOutputCount; ++i)
      c.engine.output_configured[i] = c.outputs.output[i].configured;
  }

  /// One program opens a serial line; two would take each other's bytes.
  void ports() {
    std::map<std::string, std::string> first;
    const auto port = [&](const std::string& section, bool configured, const std::string& path) {
      if (!configured || path.empty()) return;
      const auto plain = std::filesystem::path(path).lexically_normal().string();
      const auto [it, inserted] = first.emplace(plain, section + ".port");
      if (!inserted)
        add(section + ".port",
            "two devices on one port (" + path + "): the other is " + it->second);
    };
    port("gnss", config_.gnss.configured, config_.gnss.port);
    port("imu", config_.imu.configured, config_.imu.port);
    port("battery", config_.battery.configured, config_.battery.port);
  }

  void known_words(const std::string& path, const std::vector<std::string>& words,
                   const std::vector<std::string>& known) {
    for (const auto& word : words)
      if (std::find(known.begin(), known.end(), word) == known.end())
        add(path, "nothing of the name \"" + word + "\" can be accepted here",
            did_you_mean(word, known));
  }
  void accepted() {
    for (std::size_t i = 0; i < config_.drives.size(); ++i)
      known_words(item("drives", i) + ".accept", config_.drives[i].accept, {"no_watchdog"});
    known_words("accept", config_.accept, {"no_estop", "slow_guard"});
  }

  void warn(const std::string& path, const std::string& message, const std::string& word) {
    if (std::find(config_.accept.begin(), config_.accept.end(), word) != config_.accept.end())
      return;
    const auto& at = place(root_, path);
    loaded_.warnings.push_back({at.line, at.column, path, message,
                                "\"accept\": [\"" + word + "\"] when that is meant", ""});
  }
  void warnings() {
    if (!config_.lines.line[static_cast<std::size_t>(Line::estop)].configured)
      warn("lines", "there is no e-stop line: only the broker and the command line can stop it",
           "no_estop");
    constexpr int kSlowGuard_ms = 200;
    if (config_.guard.limit_ms > kSlowGuard_ms)
      warn("guard.limit_ms",
           "the wheels go on for " + std::to_string(config_.guard.limit_ms) +
               " ms when droverd dies; up to 200 ms is usual",
           "slow_guard");
  }

  /// A drive that nothing stops when the bus is cut is refused, unless a person says that it is so.
  void look_at_silence(std::size_t i, const CanDriver& driver) {
    const auto& drive = config_.drives[i];
    const auto& words = drive.accept;
    if (driver.silence().stops ||
        std::find(words.begin(), words.end(), "no_watchdog") != words.end())
      return;
    add(item("drives", i) + ".options", std::string(driver.silence().text),
        "set its watchdog, or \"accept\": [\"no_watchdog\"] when that is meant");
  }

  /// What a driver says about options that do not fit together, it says when it is made.
  template <class Look, class... More>
  void build(const std::string& path, const std::string& driver, const Options& options, Look look,
             More... more) {
    if (has_problem(path)) return;
    const auto* entry = find_driver(driver);
    if (entry == nullptr) return;
    try {
      std::visit(
          [&](const auto& make) {
            if constexpr (std::is_invocable_v<decltype(make), const Options&, More...>)
              look(make(options, more...));
          },
          entry->make);
    } catch (const std::exception& error) {
      add(path + ".options", error.what());
    }
  }
  void build_drivers() {
    const auto nothing = [](const auto&) {};
    for (std::size_t i = 0; i < config_.drives.size(); ++i) {
      const auto look = [this, i](const auto& driver) {
        if constexpr (std::is_convertible_v<decltype(*driver), const CanDriver&>)
          look_at_silence(i, *driver);
      };
      build(item("drives", i), config_.drives[i].driver, config_.drives[i].options, look,
            AxisId{0});
    }
    const auto& c = config_;
    if (c.gnss.configured) build("gnss", c.gnss.driver, c.gnss.options, nothing);
    if (c.imu.configured) build("imu", c.imu.driver, c.imu.options, nothing);
    if (c.battery.configured)
      build("battery", c.battery.driver, c.battery.options, nothing, c.battery.registers);
    for (std::size_t i = 0; i < kLineCount; ++i) {
      const auto& line = config_.lines.line[i];
      if (line.configured)
        build("lines." + std::string(kLineKeys[i]), line.driver, line.options, nothing,
              static_cast<Line>(i));
    }
  }

  const json::Node& root_;
  const std::string& folder_;
  Loaded& loaded_;
  DroverConfig& config_;
};

}  // namespace

void check_and_resolve(const json::Node& root, const BaseNames& base, const std::string& folder,
                       Loaded& loaded) {
  Checks(root, folder, loaded).run(base);
}

}  // namespace drover::config
