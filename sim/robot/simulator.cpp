#include "sim/robot/simulator.h"

#include <sys/epoll.h>
#include <sys/signalfd.h>
#include <sys/timerfd.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <csignal>
#include <cstdio>
#include <ctime>
#include <filesystem>
#include <fstream>

namespace drover::sim {
namespace {

constexpr std::uint64_t kMaxCatchUp = 20;  // ticks
constexpr Duration kFlushPeriod = std::chrono::seconds(1);

Duration read_clock(clockid_t clock) {
  timespec now{};
  ::clock_gettime(clock, &now);
  return std::chrono::seconds(now.tv_sec) + Duration(now.tv_nsec);
}

timespec to_timespec(Duration d) {
  return {static_cast<time_t>(d.count() / 1'000'000'000), d.count() % 1'000'000'000};
}

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

// What a stalled bus does not take must not wake us again and again.
constexpr std::uint32_t kOnce = EPOLLIN | EPOLLET;

void watch(int epoll, int fd, std::uint32_t events = EPOLLIN) {
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
      truth_log_(log_file(settings, "truth.csv"), robot_.scenario()),
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
  watch(epoll_.get(), timer_.get());
  watch(epoll_.get(), signals_.get());
  for (const auto& bus : buses_) watch(epoll_.get(), bus->descriptor(), kOnce);
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

Simulator::~Simulator() {
  ::unlink((settings_.run_folder + "/ready").c_str());
}

void Simulator::run() {
  write_lines();
  measure_clocks();
  const auto now = read_clock(CLOCK_MONOTONIC);
  start_ = Time{(now / kTick + 1) * kTick};
  previous_ = start_ - kTick;
  next_truth_ = next_flush_ = start_;
  itimerspec times{to_timespec(kTick), to_timespec(start_.time_since_epoch())};
  ::timerfd_settime(timer_.get(), TFD_TIMER_ABSTIME, &times, nullptr);

  std::printf("drover-sim ready: %s, seed %llu, %zu drives, run folder %s\n",
              robot_.scenario().name.c_str(), static_cast<unsigned long long>(settings_.seed),
              robot_.scenario().drives.size(), settings_.run_folder.c_str());
  std::fflush(stdout);
  std::ofstream(settings_.run_folder + "/ready") << ::getpid() << "\n";

  Time next = start_;
  while (!quit_) {
    on_events(-1);
    if (expired_ > kMaxCatchUp) {
      left_out_ += expired_ - kMaxCatchUp;
      next += kTick * static_cast<std::int64_t>(expired_ - kMaxCatchUp);
      expired_ = kMaxCatchUp;
    }
    for (; expired_ > 0 && !quit_; --expired_, next += kTick) tick(next);
  }
  can_log_.flush();
  serial_log_.flush();
  truth_log_.flush();
  object_log_.flush();
}

void Simulator::on_events(int timeout_ms) {
  std::array<epoll_event, 16> events{};
  const int n = ::epoll_wait(epoll_.get(), events.data(), events.size(), timeout_ms);
  for (int i = 0; i < n; ++i) {
    const int fd = events[static_cast<std::size_t>(i)].data.fd;
    if (fd == timer_.get()) {
      std::uint64_t expirations = 0;
      if (::read(fd, &expirations, sizeof expirations) == sizeof expirations)
        expired_ += expirations;
    } else if (fd == signals_.get()) {
      quit_ = true;
    } else if (!drain_bus(fd)) {
      control_->on_event(fd, [this](std::string_view text) { return command(text); });
    }
  }
}

bool Simulator::drain_bus(int fd) {
  for (const auto& bus : buses_) {
    if (bus->descriptor() != fd) continue;
    bus->drain();
    return true;
  }
  return false;
}

void Simulator::tick(Time now) {
  ++ticks_;
  const auto& events = robot_.scenario().events;
  while (next_event_ < events.size() && now - start_ >= events[next_event_].at) {
    const auto answer = command(events[next_event_].command);
    if (answer.starts_with("error"))
      std::fprintf(stderr, "drover-sim: event '%s': %s\n", events[next_event_].command.c_str(),
                   answer.c_str());
    ++next_event_;
  }
  if (relay_) robot_.set_relay(relay_->closed());
  exchange_can(now);
  hear_drives(now);
  robot_.step(now);
  send_can(now);
  write_lines();
  if (outputs_) outputs_->sample(now);
  exchange_serial(now);
  for (const auto& line : batteries_) line->pump(now, kTick);
  keep_records(now);
  previous_ = now;
}

void Simulator::exchange_can(Time now) {
  for (std::size_t i = 0; i < buses_.size(); ++i) {
    received_.clear();
    buses_[i]->receive({previous_, now, wall_minus_monotonic_}, received_);
    frames_in_ += received_.size();
    for (const auto& received : received_) {
      can_log_.write(received.received, robot_.scenario().buses[i].name, received.frame);
      robot_.on_frame(i, received.frame, now);
    }
  }
}

void Simulator::send_can(Time now) {
  for (std::size_t i = 0; i < buses_.size(); ++i) {
    const auto& frames = robot_.frames(i);
    if (frames.empty()) continue;
    buses_[i]->send(frames);
    frames_out_ += frames.size();
    for (const auto& frame : frames) can_log_.write(now, robot_.scenario().buses[i].name, frame);
  }
}

void Simulator::hear_drives(Time now) {
  for (std::size_t i = 0; i < drive_lines_.size(); ++i) {
    if (!drive_lines_[i]) continue;
    drive_lines_[i]->listen(kTick);
    robot_.on_drive_bytes(i, drive_lines_[i]->heard(), now);
    serial_log_.write(now, robot_.scenario().drives[i].serial->port, drive_lines_[i]->heard());
  }
}

void Simulator::exchange_serial(Time now) {
  for (std::size_t i = 0; i < drive_lines_.size(); ++i)
    if (drive_lines_[i]) drive_lines_[i]->pump(robot_.drive_bytes(i), kTick);
  // What is written to a receiver does not concern this one.
  if (gnss_) gnss_->pump(robot_.gnss_bytes(), kTick);
  if (lidar_) lidar_->pump(robot_.lidar_bytes(), kTick);
  for (std::size_t i = 0; i < more_lines_.size(); ++i) {
    if (!more_lines_[i]) continue;
    if (const int baud = robot_.more().baud(i); baud != 0) more_lines_[i]->set_baud(baud);
    more_lines_[i]->pump(robot_.more().bytes(i), kTick);
    robot_.more().on_bytes(i, more_lines_[i]->heard(), now);
  }
  if (!imu_) return;
  imu_->set_baud(robot_.imu_baud());
  imu_->pump(robot_.imu_bytes(), kTick);
  robot_.on_imu_bytes(imu_->heard(), now);
}

void Simulator::write_lines() {
  for (std::size_t i = 0; i < kLineNames; ++i) {
    const auto line = static_cast<LineName>(i);
    lines_.set(line, robot_.line_high(line));
  }
}

void Simulator::keep_records(Time now) {
  if (now >= next_truth_) {
    truth_log_.write(robot_.truth());
    next_truth_ = now + robot_.scenario().truth_period;
  }
  if (robot_.has_objects()) object_log_.append(robot_.take_object_lines());
  if (now >= next_flush_) {
    can_log_.flush();
    serial_log_.flush();
    truth_log_.flush();
    object_log_.flush();
    if (outputs_) outputs_->flush();
    measure_clocks();
    next_flush_ = now + kFlushPeriod;
  }
}

// The kernel stamps CAN frames with the wall clock.
void Simulator::measure_clocks() {
  const auto before = read_clock(CLOCK_MONOTONIC);
  const auto wall = read_clock(CLOCK_REALTIME);
  const auto after = read_clock(CLOCK_MONOTONIC);
  wall_minus_monotonic_ = wall - (before + (after - before) / 2);
}

std::string Simulator::command(std::string_view text) {
  if (text == "quit") {
    quit_ = true;
    return "ok";
  }
  if (text.starts_with("can ")) return command_can(text.substr(4));
  if (text.starts_with("tap ")) return command_tap(text.substr(4));
  if (text.starts_with("lines ")) return command_lines(text.substr(6));
  for (const std::string_view device : {"gnss ", "imu "})
    for (const std::string_view verb : {"plug", "unplug"})
      if (text.starts_with(device) && text.substr(device.size()) == verb)
        return command_plug(device.substr(0, device.size() - 1), verb);
  constexpr std::string_view kLidar = "lidar ";
  if (lidar_ && text.starts_with(kLidar)) return command_lidar(text.substr(kLidar.size()));
  std::string_view verb;
  if (SerialPort* const line = drive_line(text, verb); line != nullptr) {
    verb == "plug" ? line->plug() : line->unplug();
    return "ok";
  }
  if (auto answer = command_more(text); !answer.empty()) return answer;
  constexpr std::string_view kBattery = "battery ";
  if (robot_.battery_registers() != nullptr && text.starts_with(kBattery)) {
    const auto what = text.substr(kBattery.size());
    if (!what.starts_with("soc") && !what.starts_with("charger"))
      return batteries_.front()->command(what);
  }
  return robot_.command(text);
}

/// Both edges at one instant: over before anybody can read the level.
std::string Simulator::command_tap(std::string_view name) {
  const auto* const found = std::find(kLineText.begin(), kLineText.end(), name);
  if (found == kLineText.end()) return "error: say: tap estop|bumper|zone_far|zone_near";
  const auto line = static_cast<LineName>(found - kLineText.begin());
  const bool high = robot_.line_high(line);
  lines_.set(line, !high);
  lines_.set(line, high);
  return "ok";
}

std::string Simulator::command_can(std::string_view text) {
  const auto space = text.find(' ');
  for (std::size_t i = 0; i < buses_.size() && space != std::string_view::npos; ++i)
    if (robot_.scenario().buses[i].name == text.substr(0, space)) {
      auto answer = buses_[i]->command(text.substr(space + 1));
      watch(epoll_.get(), buses_[i]->descriptor(), kOnce);  // it may have another one now
      return answer;
    }
  return "error: say: can BUS slcan TEXT|stall|flow|bus_off|restart|unplug|plug|disconnect, with "
         "a bus of the scenario";
}

std::string Simulator::command_lines(std::string_view verb) {
  if (!chip_) return "error: these lines are files";
  if (verb != "plug" && verb != "unplug") return "error: say plug or unplug";
  if (!chip_->set_live(verb == "plug")) return "error: the kernel refused";
  if (verb == "unplug") return "ok";
  lines_ = LinePort::gpio_sim(robot_.scenario(), *chip_);
  if (outputs_) outputs_->reopen(*chip_);
  if (relay_) relay_->reopen(*chip_);
  return "ok";
}

/// The line that "drive NAME plug" or "drive NAME unplug" speaks of; nullptr: something else is
/// said.
SerialPort* Simulator::drive_line(std::string_view text, std::string_view& verb) {
  constexpr std::string_view kDrive = "drive ";
  const auto space = text.rfind(' ');
  if (!text.starts_with(kDrive) || space < kDrive.size()) return nullptr;
  verb = text.substr(space + 1);
  if (verb != "plug" && verb != "unplug") return nullptr;
  const auto name = text.substr(kDrive.size(), space - kDrive.size());
  for (std::size_t i = 0; i < drive_lines_.size(); ++i)
    if (robot_.scenario().drives[i].is_called(name)) return drive_lines_[i].get();
  return nullptr;
}

/// "gnss NAME plug", "battery NAME silent": of the lines of further devices; empty: something else
/// is said.
std::string Simulator::command_more(std::string_view text) {
  const auto& more = robot_.scenario().more;
  std::vector<std::size_t> on_line(batteries_.size());  // devices so far
  const auto line_of = [&](const BatterySpec& spec) {
    const auto path = (std::filesystem::path(settings_.run_folder) / spec.port).string();
    std::size_t i = 0;
    while (batteries_[i]->path() != path) ++i;
    return i;
  };
  if (const auto& first = robot_.scenario().battery) ++on_line[line_of(*first)];
  for (std::size_t i = 0; i < more.size(); ++i) {
    const auto begin = std::string(more[i].kind()) + " " + more[i].name + " ";
    const std::size_t line = more[i].battery ? line_of(*more[i].battery) : 0;
    const std::size_t place = more[i].battery ? on_line[line]++ : 0;
    if (!text.starts_with(begin)) continue;
    const auto what = text.substr(begin.size());
    if (more[i].battery && !what.starts_with("soc") && !what.starts_with("charger"))
      return batteries_[line]->command(what, place);
    if (!more_lines_[i] || (what != "plug" && what != "unplug")) return {};
    if (what == "unplug") {
      more_lines_[i]->unplug();
      return "ok";
    }
    more_lines_[i]->plug();
    return more[i].imu ? robot_.command(begin + "restart") : "ok";
  }
  return {};
}

/// Its plug is a state like the others.
std::string Simulator::command_lidar(std::string_view state) {
  if (state == "unplugged") {
    lidar_->unplug();
    return "ok";
  }
  if (state == "normal") lidar_->plug();
  return robot_.command("lidar " + std::string(state));
}

std::string Simulator::command_plug(std::string_view device, std::string_view verb) {
  auto& port = device == "imu" ? imu_ : gnss_;
  // Not there, or on a bus.
  if (!port) return robot_.command(std::string(device) + " " + std::string(verb));
  if (verb == "unplug") {
    port->unplug();
    return "ok";
  }
  port->plug();
  // It lives on the cable's supply.
  return device == "imu" ? robot_.command("imu restart") : "ok";
}

std::string Simulator::summary() const {
  std::uint64_t can_dropped = 0;
  for (const auto& bus : buses_) can_dropped += bus->dropped();
  std::array<char, 256> text{};
  std::uint64_t serial_dropped = (gnss_ ? gnss_->dropped() : 0) + (imu_ ? imu_->dropped() : 0);
  serial_dropped += lidar_ ? lidar_->dropped() : 0;
  for (const auto& line : more_lines_) serial_dropped += line ? line->dropped() : 0;
  for (const auto& line : drive_lines_) serial_dropped += line ? line->dropped() : 0;
  const int n = std::snprintf(
      text.data(), text.size(),
      "%llu ticks (%llu left out), CAN frames %llu in, %llu out, %llu dropped, serial bytes "
      "dropped %llu",
      static_cast<unsigned long long>(ticks_), static_cast<unsigned long long>(left_out_),
      static_cast<unsigned long long>(frames_in_), static_cast<unsigned long long>(frames_out_),
      static_cast<unsigned long long>(can_dropped),
      static_cast<unsigned long long>(serial_dropped));
  return {text.data(), static_cast<std::size_t>(n)};
}

}  // namespace drover::sim
