// The networks of this computer, and which of them the domain uses.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace drover::ros2 {

struct Network {
  std::string name;     ///< of its interface
  std::string address;  ///< this computer's there, IPv4
  bool multicast = true;

  bool operator==(const Network&) const = default;
};

/// Interfaces that are up and have an IPv4 address, without loopback, as the kernel orders them.
std::vector<Network> networks();

/// DDS programs that use one network answer the first of several addresses, also one that they
/// cannot reach: so it is one. That of the interface `wanted`, or none; where nothing is wanted the
/// one in use while it is there, then the first, as DDS programs choose theirs.
std::optional<Network> chosen(const std::vector<Network>& there, std::string_view wanted,
                              const std::optional<Network>& in_use);

/// "eth0 192.0.2.2, wlan0 ..."; "no network".
std::string joined(const std::vector<Network>& networks);

}  // namespace drover::ros2
