// The links: what each carries, and what two may not share.
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <span>

#include "config/check_subjects.h"
#include "config/taken.h"
#include "drover/baud.h"
#include "drover/guard_protocol.h"
#include "text/suggestion.h"

namespace drover::config {
namespace {

constexpr std::size_t kLongestInterface = 15;  // the kernel's, without the zero at its end

/// "" when it is a device or tcp:ADDRESS:PORT. No names: to resolve one may take longer than
/// anything here waits.
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

Wire wire_of(const LinkConfig& link) {
  if (!link.serial.empty()) return Wire::bytes;
  if (!link.modbus.empty()) return Wire::registers;
  return link.gpio.empty() ? Wire::can : Wire::levels;
}

/// The key that says which kind of link it is.
std::string kind_key(Wire wire) {
  switch (wire) {
    case Wire::can: return "can";
    case Wire::bytes: return "serial";
    case Wire::registers: return "modbus";
    case Wire::levels: break;
  }
  return "gpio";
}

void check_baud(const LinkConfig& link, std::span<const int> known, Findings& found) {
  if (std::find(known.begin(), known.end(), link.baud) != known.end()) return;
  std::string all;
  for (const int baud : known) all += (all.empty() ? "" : ", ") + std::to_string(baud);
  found.add(link_path(link, "baud"),
            "is " + std::to_string(link.baud) + ", but a line has one of " + all);
}

/// Of a line that says nothing of it: what its device speaks.
int usual_baud(const LinkConfig& link, Findings& found) {
  for (const auto& device : found.config().devices) {
    const auto* entry = find_driver(device.driver);
    if (device.link == link.name && entry != nullptr && !entry->bauds.empty())
      return entry->bauds[0];
  }
  return kUsualBaud;
}

bool is_meant_for_modbus(const LinkConfig& link, Findings& found) {
  const auto& devices = found.config().devices;
  return link.wire == Wire::bytes &&
         std::any_of(devices.begin(), devices.end(), [&link](const auto& device) {
           const auto* entry = find_driver(device.driver);
           return device.link == link.name && entry != nullptr && entry->wire == Wire::registers;
         });
}

/// Speed and parity are of the lines that have them.
void check_pace(LinkConfig& link, Findings& found) {
  const auto refuse = [&](std::string_view key, const char* instead = "leave it out") {
    if (found.given(link_path(link, key)))
      found.add(link_path(link, key), "is of no use on " + std::string(words(link.wire)), instead);
  };
  // Of a device that speaks Modbus the link's key is what is wrong.
  if (link.wire != Wire::registers && !is_meant_for_modbus(link, found)) refuse("parity");
  if (link.wire == Wire::can)
    refuse("baud", "leave it out: BitRate= in /etc/systemd/network/80-can0.network is this one's");
  if (link.wire == Wire::levels) refuse("baud");
  if (link.wire == Wire::bytes) {
    if (link.baud == 0) link.baud = usual_baud(link, found);
    check_baud(link, kSerialBauds, found);
  } else if (link.wire == Wire::registers && link.baud != 0) {
    check_baud(link, kModbusBauds, found);
  }
}

/// A relative one would be looked for in whichever folder droverd works.
void check_port(const LinkConfig& link, std::string_view key, const std::string& port,
                Findings& found) {
  if (port.empty() || port.starts_with('/') || port.starts_with("tcp:")) return;
  const auto whole = (port.starts_with("dev/") ? "/" : "/dev/") + port;
  const bool is_slip = port.starts_with("dev/") || port.starts_with("tty");
  found.add(
      link_path(link, key),
      "\"" + port + "\" is no absolute path: it would be looked for in droverd's working folder",
      is_slip ? "did you mean \"" + whole + "\"?" : "a path like \"/dev/ttyUSB0\"");
}

/// Longer ones the kernel cuts, or refuses when it is too late.
void check_interface(const LinkConfig& link, Findings& found) {
  if (link.can.starts_with("unix:")) return;
  if (const auto slash = link.can.rfind('/'); slash != std::string::npos) {
    const auto name = link.can.substr(slash + 1);
    std::string instead = "did you mean \"" + name + "\"?";
    if (name.empty()) instead = "a name like \"can0\"";
    if (name.starts_with("tty"))
      instead = "slcand makes one of a serial adapter: its name, like \"slcan0\"";
    return found.add(link_path(link, "can"),
                     "\"" + link.can + "\" is no name of an interface: they have no slash",
                     instead);
  }
  if (link.can.find_first_of(" \t:") != std::string::npos)
    return found.add(
        link_path(link, "can"),
        "\"" + link.can + "\" is no name of an interface: they have neither spaces nor colons",
        "a name like \"can0\", as \"ip link\" tells it");
  if (link.can.size() <= kLongestInterface) return;
  found.add(link_path(link, "can"), "\"" + link.can +
                                        "\" is no name of an interface: they have up to " +
                                        std::to_string(kLongestInterface) + " characters");
}

/// One program opens a line; two devices would take each other's bytes.
void check_addresses(Findings& found) {
  Taken taken(found);
  for (const auto& link : found.config().links) {
    const auto& written = address(link);
    const bool is_port = link.wire == Wire::bytes || link.wire == Wire::registers;
    const auto plain = is_port
                           ? "port " + std::filesystem::path(written).lexically_normal().string()
                           : kind_key(link.wire) + " " + written;
    taken.take(plain, link_path(link, kind_key(link.wire)), written);
  }
}

}  // namespace

std::string_view words(Wire wire) {
  switch (wire) {
    case Wire::can: return "a CAN bus";
    case Wire::bytes: return "a serial line";
    case Wire::registers: return "a Modbus line";
    case Wire::levels: break;
  }
  return "a GPIO chip";
}

void check_links(Findings& found) {
  std::size_t buses = 0;
  for (auto& link : found.config().links) {
    link.wire = wire_of(link);
    if (address(link).empty()) continue;  // told already
    check_pace(link, found);
    check_interface(link, found);
    check_port(link, "serial", link.serial, found);
    check_port(link, "modbus", link.modbus, found);
    if (const auto why = check_modbus_port(link.modbus); !why.empty())
      found.add(link_path(link, "modbus"), why);
    if (link.wire == Wire::can && ++buses == kMaxBuses + 1)
      found.add(link_path(link),
                "is one CAN bus too many: there may be " + std::to_string(kMaxBuses));
  }
  check_addresses(found);
}

/// drover-guard has its own way to each link on which something moves.
void check_guarded_links(Findings& found) {
  const auto moves = [&found](const LinkConfig& link) {
    return std::any_of(
        found.config().devices.begin(), found.config().devices.end(), [&link](const auto& device) {
          const auto* entry = find_driver(device.driver);
          return device.link == link.name && entry != nullptr && !entry->channels.empty();
        });
  };
  std::size_t guarded = 0;
  for (const auto& link : found.config().links)
    if (moves(link) && ++guarded == kGuardMaxLinks + 1)
      found.add(link_path(link),
                "is one link too many on which something moves: drover-guard stops " +
                    std::to_string(kGuardMaxLinks));
}

void check_use_of_links(Findings& found) {
  const auto& config = found.config();
  if (found.has_problem("outputs.link")) return;
  for (const auto& device : config.devices)
    if (device.link.empty() || found.has_problem(device_path(device, "link")))
      return;  // it may be meant
  if (config.devices.empty()) return;
  check_guarded_links(found);
  for (const auto& link : config.links) {
    const bool used = config.outputs.link == link.name ||
                      std::any_of(config.devices.begin(), config.devices.end(),
                                  [&link](const auto& device) { return device.link == link.name; });
    if (!used) found.add(link_path(link), "no device hangs on it", "leave it out");
  }
}

const LinkConfig* find_link(const std::string& name, const std::string& path, Findings& found) {
  const auto& links = found.config().links;
  const auto it = std::find_if(links.begin(), links.end(),
                               [&name](const auto& link) { return link.name == name; });
  if (it != links.end()) return &*it;
  const auto names = collect(links, [](const auto& link) { return link.name; });
  if (!found.has_problem(path) && !found.is_wrong("links"))
    found.add(path, "there is no link named \"" + name + "\"", text::did_you_mean(name, names));
  return nullptr;
}

}  // namespace drover::config
