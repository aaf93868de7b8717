// What the simulator opens: buses, lines, logs, and the socket that it is told by.
#include <sys/epoll.h>
#include <sys/signalfd.h>
#include <sys/timerfd.h>

#include <algorithm>
#include <csignal>
#include <filesystem>

#include "sim/robot/simulator.h"

namespace drover::sim {
namespace {

std::string made_folder(const std::string& folder) {
  if (!folder.empty()) std::filesystem::create_directories(folder);
  return folder;
}

std::string log_file(const SimulatorSettings& settings, const char* name) {
  return settings.log_folder.empty() ? "" : made_folder(settings.log_folder) + "/" + name;
}

Robot make_robot(const SimulatorSettings& settings) {
  const auto scenario = load_scenario(settings.scenario_file);
  return {scenario, make_twins(scenario, settings.seed)};
}

std::unique_ptr<CanPort> make_port(const BusSpec& bus, const SimulatorSettings& settings) {
  if (settings.can_over_unix || bus.kind == CanKind::unix_socket)
    return make_unix_port(settings.run_folder + "/" + bus.name + ".sock");
  if (bus.kind == CanKind::slcan) return make_slcan_port(bus.name);
  return make_socketcan_port(bus.name);
}

link::UniqueFd block_signals() {
  sigset_t set;
  sigemptyset(&set);
  sigaddset(&set, SIGTERM);
  sigaddset(&set, SIGINT);
  ::sigprocmask(SIG_BLOCK, &set, nullptr);
  return link::UniqueFd(::signalfd(-1, &set, SFD_CLOEXEC | SFD_NONBLOCK));
}

void watch(int epoll, int fd, std::uint32_t events) {
  epoll_event event{};
  event.events = events;
  event.data.fd = fd;
  ::epoll_ctl(epoll, EPOLL_CTL_ADD, fd, &event);
}

bool has_serial_drive(const Scenario& scenario) {
  return std::any_of(scenario.drives.begin(), scenario.drives.end(),
                     [](const DriveSpec& drive) { return drive.serial.has_value(); });
}

}  // namespace

Simulator::Simulator(const SimulatorSettings& settings)
    : settings_(settings),
      robot_(make_robot(settings)),
      epoll_(::epoll_create1(EPOLL_CLOEXEC)),
      timer_(::timerfd_create(CLOCK_MONOTONIC, TFD_CLOEXEC | TFD_NONBLOCK)),
      chip_(settings.line_files ? std::nullopt : std::optional<GpioSimChip>(std::in_place)),
      lines_(chip_
                 ? LinePort::gpio_sim(robot_.scenario(), *chip_)
                 : LinePort::files(robot_.scenario(), made_folder(settings.run_folder) + "/lines")),
      can_log_(log_file(settings, "can.log")),
      serial_log_(has_serial_drive(robot_.scenario()) ? log_file(settings, "serial.log") : ""),
      truth_log_(log_file(settings, "truth.csv"), robot_),
      object_log_(robot_.has_objects() ? log_file(settings, "objects.log") : "") {
  made_folder(settings_.run_folder);
  const auto& scenario = robot_.scenario();
  // Before the signals are blocked, which a child (`ip`) would inherit.
  for (const auto& bus : scenario.buses) buses_.push_back(make_port(bus, settings_));
  const std::filesystem::path folder(settings_.run_folder);
  const auto place = [&folder](const std::string& port) {
    return port.starts_with("usb:") ? port : (folder / port).string();
  };
  for (const auto& drive : scenario.drives)
    drive_lines_.push_back(
        drive.serial ? std::make_unique<SerialPort>(place(drive.serial->port), drive.serial->baud)
                     : nullptr);
  if (scenario.gnss) gnss_.emplace(place(scenario.gnss->port), scenario.gnss->baud);
  if (scenario.imu && !scenario.imu->bus)
    imu_.emplace(place(scenario.imu->port), scenario.imu->baud);
  if (scenario.battery) (void)battery_line(*scenario.battery, *robot_.battery_registers());
  if (scenario.lidar) lidar_.emplace(place(scenario.lidar->port), scenario.lidar->baud);
  for (std::size_t i = 0; i < scenario.more.size(); ++i) {
    const auto& [name, gnss, imu, battery] = scenario.more[i];
    auto& line = more_lines_.emplace_back();
    if (gnss) line = std::make_unique<SerialPort>(place(gnss->port), gnss->baud);
    if (imu && !imu->bus) line = std::make_unique<SerialPort>(place(imu->port), imu->baud);
    if (battery) (void)battery_line(*battery, *robot_.more().registers(i));
  }
  if (scenario.outputs && chip_) outputs_.emplace(log_file(settings_, "lines.log"), *chip_);
  if (scenario.relay_feeds_drives) {
    if (chip_) {
      relay_.emplace(*chip_);
    } else {
      relay_.emplace(made_folder(settings_.run_folder + "/outputs"));
    }
  }
  signals_ = block_signals();
  control_.emplace(settings_.run_folder + "/sim.sock", epoll_.get());
  watch(epoll_.get(), timer_.get(), EPOLLIN);
  watch(epoll_.get(), signals_.get(), EPOLLIN);
  for (const auto& bus : buses_) watch_bus(*bus);
}

/// Batteries with one port hang on one line.
BatteryPort& Simulator::battery_line(const BatterySpec& spec, const RegisterTwin& device) {
  const auto path = (std::filesystem::path(settings_.run_folder) / spec.port).string();
  auto it = std::find_if(batteries_.begin(), batteries_.end(),
                         [&path](const auto& line) { return line->path() == path; });
  if (it == batteries_.end())
    it = batteries_.insert(batteries_.end(), std::make_unique<BatteryPort>(path, spec.baud));
  (*it)->add(spec.unit, device);
  return **it;
}

// What a stalled bus does not take must not wake us again and again.
void Simulator::watch_bus(const CanPort& bus) {
  watch(epoll_.get(), bus.descriptor(), EPOLLIN | EPOLLET);
}

}  // namespace drover::sim
