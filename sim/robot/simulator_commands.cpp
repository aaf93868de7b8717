// What the simulator is told while it runs: plugs, lines and buses; the rest is for its robot.
#include <algorithm>
#include <filesystem>

#include "sim/robot/simulator.h"

namespace drover::sim {

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
      watch_bus(*buses_[i]);  // it may have another descriptor now
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

}  // namespace drover::sim
