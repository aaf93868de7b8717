#include "ros2/networks.h"

#include <arpa/inet.h>
#include <ifaddrs.h>
#include <net/if.h>
#include <sys/socket.h>

#include <algorithm>
#include <array>

namespace drover::ros2 {

std::vector<Network> networks() {
  std::vector<Network> found;
  ifaddrs* all = nullptr;
  if (::getifaddrs(&all) != 0) return found;
  for (const ifaddrs* one = all; one != nullptr; one = one->ifa_next) {
    const bool up = (one->ifa_flags & (IFF_UP | IFF_RUNNING)) == (IFF_UP | IFF_RUNNING);
    if (one->ifa_addr == nullptr || one->ifa_addr->sa_family != AF_INET || !up ||
        (one->ifa_flags & IFF_LOOPBACK) != 0)
      continue;
    std::array<char, INET_ADDRSTRLEN> text{};
    const auto* address = reinterpret_cast<const sockaddr_in*>(one->ifa_addr);
    ::inet_ntop(AF_INET, &address->sin_addr, text.data(), text.size());
    found.push_back({one->ifa_name, text.data(), (one->ifa_flags & IFF_MULTICAST) != 0});
  }
  ::freeifaddrs(all);
  return found;
}

std::optional<Network> chosen(const std::vector<Network>& there, std::string_view wanted,
                              const std::optional<Network>& in_use) {
  const auto first = [&](const auto& is_it) -> std::optional<Network> {
    const auto found = std::find_if(there.begin(), there.end(), is_it);
    return found == there.end() ? std::nullopt : std::optional(*found);
  };
  if (in_use && (wanted.empty() || in_use->name == wanted)) {
    if (auto still = first([&](const Network& one) { return one == *in_use; })) return still;
  }
  if (!wanted.empty()) return first([&](const Network& one) { return one.name == wanted; });
  if (auto best = first([](const Network& one) { return one.multicast; })) return best;
  return first([](const Network&) { return true; });
}

std::string joined(const std::vector<Network>& networks) {
  std::string all;
  for (const auto& one : networks) {
    if (!all.empty()) all += ", ";
    all += one.name + " " + one.address;
  }
  return all.empty() ? "no network" : all;
}

}  // namespace drover::ros2
