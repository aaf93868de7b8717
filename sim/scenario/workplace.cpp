#include "sim/scenario/workplace.h"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <span>
#include <sstream>
#include <stdexcept>
#include <string_view>

#include "drover/registry.h"
#include "sim/robot/scenario_file.h"
#include "sim/scenario/draw.h"
#include "sim/scenario/mission.h"

namespace drover::sim {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using nlohmann::ordered_json;

/// What programs append to, and what they write for some robots only.
constexpr const char* kOldLogs[] = {"mosquitto.log",    "udevd.log",   "drover-sim.log",
                                    "drover-guard.log", "droverd.log", "drover.log",
                                    "objects.log",      "lines.log"};
/// Sooner than a chassis stops by itself whose time-out nobody can change (0.5 s).
constexpr int kWideGuard_ms = 400;
constexpr const char* kUdevd = "/lib/systemd/systemd-udevd";

std::string temporary_folder() {
  auto pattern = (fs::temp_directory_path() / "drover-scenario-XXXXXX").string();
  if (::mkdtemp(pattern.data()) == nullptr)
    throw std::runtime_error(pattern + ": cannot make a folder");
  return pattern;
}

/// A port that was free a moment ago.
int free_port() {
  link::UniqueFd fd(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0));
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  socklen_t size = sizeof address;
  auto* generic = reinterpret_cast<sockaddr*>(&address);
  if (::bind(fd.get(), generic, size) != 0 || ::getsockname(fd.get(), generic, &size) != 0)
    throw std::runtime_error("no free port on 127.0.0.1");
  return ntohs(address.sin_port);
}

/// The register map of the battery at `place`. Throws when there is none of that name: the file
/// that the robot's simulator and gateway read is another, and gone when somebody looks.
template <class Json>
void make_map_absolute(Json& battery, const fs::path& folder, const std::string& place) {
  if (!battery.is_object() || !battery.contains("map") || !battery["map"].is_string()) return;
  const std::string map = battery["map"];
  if (const auto found = map_file(map, folder); !found.empty()) {
    battery["map"] = found;
  } else if (const auto why = why_no_map(map, folder); !why.empty()) {
    throw std::runtime_error(place + ".map: " + why);
  }
}

struct WideOption {
  SlotKind kind;
  std::string_view name;
  json value;
};
/// Of drives themselves: when they stop without being told.
const WideOption kTimeOuts[] = {
    {SlotKind::drive, "watchdog_timeout_s", 2},
    {SlotKind::drive, "silence_ms", 2000},
    {SlotKind::drive, "timeout_ms", 2000},
};
/// Of the gateway's drivers.
const WideOption kAges[] = {
    {SlotKind::drive, "stale_s", 1},  {SlotKind::drive, "heartbeat_timeout_s", 1},
    {SlotKind::drive, "gone_s", 1},   {SlotKind::drive, "timeout_s", 2},
    {SlotKind::gnss, "stale_s", 2},   {SlotKind::imu, "stale_s", 2},
    {SlotKind::line, "stale_s", 0.5}, {SlotKind::scanner, "stale_s", 2}};

/// Those that the device's driver has.
template <class Json>
void widen_options(Json& device, std::span<const WideOption> wide) {
  const auto* const driver = find_driver(device.value("driver", ""));
  if (driver == nullptr) return;
  for (const auto& one : wide) {
    const bool has =
        driver->kind == one.kind && std::any_of(driver->options.begin(), driver->options.end(),
                                                [&](const auto& o) { return o.name == one.name; });
    if (has) device["options"][std::string(one.name)] = one.value;
  }
}

bool is_kind(const ordered_json& device, SlotKind kind) {
  return find_driver(device.value("driver", ""), kind) != nullptr;
}

/// droverd's configuration stands beside the robot: field.json, field.drover.json.
std::string config_file_of(const std::string& scenario_file) {
  auto robot = robot_file_of(scenario_file);
  if (robot.empty())
    throw std::runtime_error(scenario_file +
                             ": robot: is missing; it names the gateway's file too");
  return fs::path(robot).replace_extension(".drover.json").string();
}

ordered_json read_config(const std::string& file) {
  std::ifstream stream(file);
  if (!stream) throw std::runtime_error(file + ": cannot open");
  auto config = ordered_json::parse(stream, nullptr, false, true);
  if (!config.is_object()) throw std::runtime_error(file + ": is no JSON object");
  for (const auto& [name, device] : config["devices"].items())
    make_map_absolute(device, fs::absolute(file).parent_path(), file + ": devices." + name);
  return config;
}

/// What this scenario's gateway is told otherwise than the robot's: a wrong gear ratio, say.
/// Its maps stand beside the robot's, in `folder`.
void change_gateway(ordered_json& config, const json& change, const fs::path& folder,
                    const std::string& scenario_file) {
  if (!change.is_object()) throw std::runtime_error(scenario_file + ": gateway: must be an object");
  if (change.contains("devices"))
    for (const auto& [name, ignored] : change["devices"].items())
      if (!config["devices"].contains(name))
        throw std::runtime_error(scenario_file + ": gateway.devices." + name +
                                 ": there is no such device to change");
  config.merge_patch(ordered_json(change));
  for (auto& [name, device] : config["devices"].items())
    make_map_absolute(device, folder, scenario_file + ": gateway.devices." + name);
}

/// Else its logs would go on, and a recording would stand beside its own.
void forget_earlier_run(const std::string& log_folder) {
  std::vector<fs::path> old;
  for (const auto& entry : fs::directory_iterator(log_folder)) {
    const auto name = entry.path().filename().string();
    const bool is_log =
        std::find(std::begin(kOldLogs), std::end(kOldLogs), name) != std::end(kOldLogs);
    if (is_log || name.starts_with("droverd.rec")) old.push_back(entry.path());
  }
  for (const auto& file : old) fs::remove(file);
}

/// `text` with `name` in the place of `file`, and without line and column of it.
std::string renamed(std::string text, const std::string& file, const std::string& name) {
  for (auto at = text.find(file); at != std::string::npos; at = text.find(file, at + name.size())) {
    auto end = at + file.size();
    const auto number = [&text](std::size_t from) {
      const auto after = text.find_first_not_of("0123456789", from + 1);
      return from < text.size() && text[from] == ':' && after != from + 1 ? after : from;
    };
    end = number(number(end));
    text.replace(at, std::min(end, text.size()) - at, name);
  }
  return text;
}

bool lab_in_real_time() {
  const auto* lab = std::getenv("DROVER_LAB");
  return lab != nullptr && std::string_view(lab) == "real";
}

void write_file(const std::string& path, const std::string& text) {
  std::ofstream stream(path);
  stream << text;
  stream.close();
  if (!stream) throw std::runtime_error(path + ": cannot write");
}

}  // namespace

Workplace::Workplace(const WorkplaceSettings& settings)
    : settings_(settings),
      document_(load_scenario_document(settings.scenario_file)),
      private_folder_(temporary_folder()),
      log_folder_(settings.log_folder) {
  for (const auto& change : settings.changes) set_member(document_, change);
  draw_mission(document_, settings.seed);
  const auto folder = fs::absolute(fs::path(settings.scenario_file)).parent_path();
  document_["world"] = (folder / document_.value("world", "")).lexically_normal().string();
  const auto& file = settings.scenario_file;
  if (document_.contains("battery"))
    make_map_absolute(document_["battery"], folder, file + ": battery");
  if (document_.contains("more") && document_["more"].is_object())
    for (const auto& [name, device] : document_["more"].items())
      make_map_absolute(device, folder, file + ": more." + name);
  if (log_folder_.empty()) log_folder_ = private_folder_ + "/log";
  fs::create_directories(log_folder_);
  forget_earlier_run(log_folder_);
  config_file_ = config_file_of(settings.scenario_file);
  auto config = read_config(config_file_);
  if (document_.contains("gateway"))
    change_gateway(config, document_["gateway"], fs::absolute(config_file_).parent_path(),
                   settings.scenario_file);
  if (settings.native) make_native(config);
  if ((settings.native || lab_in_real_time()) && !settings.own_ages) widen_ages(config);
  if (document_.value("/gnss/port"_json_pointer, "").starts_with("usb:")) prepare_udev(config);
  guard_socket_ = config.value("/guard/socket"_json_pointer, "/run/drover/guard.sock");
  daemon_folder_ = config.value("/paths/run"_json_pointer, daemon_folder_);
  fs::create_directories(sim_folder_);
  fs::create_directories(daemon_folder_);
  fs::create_directories(config.value("/paths/state"_json_pointer, std::string("/var/lib/drover")));
  write_files(config);
}

Workplace::~Workplace() {
  std::error_code ignored;
  fs::remove_all(private_folder_, ignored);
}

void Workplace::make_native(ordered_json& config) {
  port_ = free_port();
  sim_folder_ = private_folder_ + "/sim";
  const auto run = private_folder_ + "/run";
  config["paths"] = {{"run", run}, {"state", private_folder_ + "/state"}};
  for (auto& [name, link] : config["links"].items()) {
    if (link.contains("can"))  // the simulator's bus, whatever its link is called
      link["can"] = "unix:" + sim_folder_ + "/" + link.value("can", name) + ".sock";
    if (link.contains("gpio")) link["gpio"] = "files:" + sim_folder_ + "/lines";
    for (const char* port : {"serial", "modbus"})
      if (link.contains(port))
        link[port] = sim_folder_ + "/" + fs::path(link.value(port, "")).filename().string();
  }
  for (auto& [name, device] : config["devices"].items())
    if (is_kind(device, SlotKind::line)) device["line"] = device.value("is", "");  // as its file
  if (config.contains("outputs")) {
    fs::create_directories(sim_folder_ + "/outputs");
    config["links"]["outputs"] = {{"gpio", "files:" + sim_folder_ + "/outputs"}};
    config["outputs"]["link"] = "outputs";
    config["outputs"].erase("watchdog");  // a file cannot be pulsed
  }
  config["guard"]["socket"] = run + "/guard.sock";
  config["mqtt"]["port"] = port_;
  config["control"]["realtime"] = false;
}

/// Where the clock is the host's, robot and gateway share its hold-ups: a desktop lets a process
/// sleep 0.2 s longer than it asked for. A robot's ages are for a machine of its own.
void Workplace::widen_ages(ordered_json& config) {
  for (auto& drive : document_["drives"]) widen_options(drive, kTimeOuts);
  for (auto& device : config["devices"]) {
    widen_options(device, kTimeOuts);
    widen_options(device, kAges);
  }
  config["health"].update(
      {{"drive_stale_s", 1}, {"gnss_stale_s", 2}, {"imu_stale_s", 2}, {"line_stale_s", 0.5}});
  config["estimate"].update({{"wheel_stale_s", 0.5}, {"imu_stale_s", 0.5}});
  config["guard"]["limit_ms"] = kWideGuard_ms;
}

/// A udevd of our own would rename the host's devices: only the lab has none.
void Workplace::prepare_udev(ordered_json& config) {
  if (settings_.native || std::getenv("DROVER_LAB") == nullptr)
    throw std::runtime_error("a receiver on USB needs the lab");
  if (!fs::exists(kUdevd))
    throw std::runtime_error(std::string(kUdevd) + " is missing: install udev");
  const auto folder = fs::absolute(fs::path(settings_.scenario_file)).parent_path();
  udev_rules_ = folder / document_.value("/player/udev_rules"_json_pointer, "");
  const fs::path rules("/run/udev/rules.d");
  fs::create_directories(rules);
  fs::copy_file(udev_rules_, rules / fs::path(udev_rules_).filename());
  for (const auto& device : config["devices"])
    if (is_kind(device, SlotKind::gnss))
      config["links"][device.value("link", "")]["serial"] = "/dev/drover/gnss";
}

void Workplace::write_files(const ordered_json& config) {
  // Beside the logs, too: what was really played.
  for (const auto& folder : {private_folder_, log_folder_}) {
    write_file(folder + "/scenario.json", document_.dump(1));
    write_file(folder + "/drover.json", config.dump(1));
  }
  std::ostringstream broker;
  broker << "listener " << port_ << (settings_.native ? " 127.0.0.1" : "") << "\n"
         << "allow_anonymous true\n"
         << "persistence false\n"
         << "set_tcp_nodelay true\n"
         << "max_packet_size 6356992\n"
         // Another user would lose the promise to die with its parent.
         << "user root\n";
  write_file(private_folder_ + "/mosquitto.conf", broker.str());
}

std::string Workplace::as_written(const std::string& text) const {
  const auto of_scenario = renamed(text, private_file("scenario.json"), settings_.scenario_file);
  return renamed(of_scenario, private_file("drover.json"), config_file_);
}

Program Workplace::program(const std::string& name, const std::vector<std::string>& words) const {
  const auto broker = name == "mosquitto";
  if (name == "udevd") return {name, {kUdevd}};
  auto path = find_program(settings_.program_folder, name);
  if (broker)
    for (const char* folder : {"/usr/sbin", "/usr/local/sbin", "/usr/bin"})
      if (path.empty()) path = find_program(folder, name);
  if (path.empty())
    throw std::runtime_error(name + " is not in " +
                             (broker ? "/usr/sbin" : settings_.program_folder));
  Program program{name, {path}};
  auto add = [&program](std::initializer_list<std::string> more) {
    program.command.insert(program.command.end(), more);
  };
  if (broker) add({"-c", private_file("mosquitto.conf")});
  if (name == "drover-guard") add({"--socket", guard_socket_});
  // A restarted one records beside it: droverd.rec.1, ...
  if (name == "droverd")
    add({"-c", private_file("drover.json"), "--record", log_folder_ + "/droverd.rec"});
  if (name == "drover-sim") {
    add({"--scenario", private_file("scenario.json"), "--seed", std::to_string(settings_.seed),
         "--run-dir", sim_folder_, "--log-dir", log_folder_});
    if (settings_.native) add({"--can-transport", "unix", "--lines", "files"});
  }
  if (name == "drover") {
    add({"--socket", daemon_socket()});
    for (const auto& word : words) add({word});
  }
  return program;
}

}  // namespace drover::sim
