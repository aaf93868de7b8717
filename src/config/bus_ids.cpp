#include "config/bus_ids.h"

#include <algorithm>
#include <cstdio>
#include <optional>
#include <string>
#include <utility>

namespace drover::config {
namespace {

constexpr std::uint32_t kStandardBits = 0x7FF;
constexpr std::uint32_t kExtendedBits = 0x1FFFFFFF;

std::uint32_t width(const FrameFilter& filter) {
  return filter.extended ? kExtendedBits : kStandardBits;
}

/// The lowest id that both mean and do not share.
template <class IsShared>
std::optional<std::uint32_t> common_id(const FrameFilter& a, const FrameFilter& b,
                                       const IsShared& is_shared) {
  if (a.extended != b.extended) return {};
  const std::uint32_t both = a.mask & b.mask;
  if ((a.id & both) != (b.id & both)) return {};
  const std::uint32_t lowest = ((a.id & a.mask) | (b.id & b.mask)) & width(a);
  if (a.extended || !is_shared(lowest)) return lowest;
  std::uint32_t open = width(a) & ~(a.mask | b.mask);
  for (std::uint32_t bit = 1; open != 0; bit <<= 1U) {
    if ((open & bit) != 0 && !is_shared(lowest | bit)) return lowest | bit;
    open &= ~bit;
  }
  return {};
}

std::string hex(std::uint32_t id, bool extended) {
  char text[16];
  (void)std::snprintf(text, sizeof text, extended ? "0x%08X" : "0x%03X", static_cast<unsigned>(id));
  return text;
}

/// The option that is this id, or else the one that its ids follow from.
std::string path_of_id(const DeviceConfig& device, std::uint32_t id) {
  constexpr std::uint32_t kHeartbeat = 0x700;
  constexpr const char* kGateway = "gateway_node";
  std::string path = device_path(device);
  if (device.options.has(kGateway) && kHeartbeat + device.options.number(kGateway) == id)
    return device_path(device, std::string("options.") + kGateway);
  for (const char* const key : {"master_id", "id", "node"}) {
    if (!device.options.has(key)) continue;
    path = device_path(device, std::string("options.") + key);
    if (device.options.number(key) == id) break;
  }
  return path;
}

}  // namespace

void BusIds::take(const DeviceConfig& device, const Made& made) {
  if (made.frames == nullptr) return;
  User user{&device, {}, {}};
  const auto heard = made.frames->listens();
  user.ids.assign(heard.begin(), heard.end());
  if (made.actuator != nullptr) {
    for (const auto& rule : made.actuator->rules()) {
      if (rule.shared) {
        user.shared.push_back(rule.id);
      } else {
        user.ids.push_back({rule.id, rule.extended ? kExtendedBits : kStandardBits, rule.extended});
      }
    }
  }
  for (const auto& other : users_)
    if (other.device->link == device.link) compare(other, user);
  users_.push_back(std::move(user));
}

/// Told once: who has one id in common has more, as a rule.
void BusIds::compare(const User& first, const User& second) {
  const auto is_shared = [&](std::uint32_t id) {
    const auto among = [id](const std::vector<std::uint32_t>& ids) {
      return std::find(ids.begin(), ids.end(), id) != ids.end();
    };
    // CANopen's network management, of 000, is read by who wants to.
    return id == 0 ? among(first.shared) || among(second.shared)
                   : among(first.shared) && among(second.shared);
  };
  for (const auto& one : first.ids) {
    for (const auto& other : second.ids) {
      const auto id = common_id(one, other, is_shared);
      if (!id) continue;
      found_.add(path_of_id(*second.device, *id),
                 device_path(*second.device) + " (" + second.device->driver + ") and " +
                     device_path(*first.device) + " (" + first.device->driver +
                     ") both use the id " + hex(*id, one.extended) + " on \"" +
                     second.device->link +
                     "\": what is meant for one, or sent by it, is taken "
                     "for the other's",
                 "another address for one of them, or a bus of its own");
      return;
    }
  }
}

}  // namespace drover::config
