// The networks of this computer.
#pragma once

#include <string>
#include <vector>

namespace drover::ros2 {

/// "eth0 192.0.2.2", ...: interfaces that are up and have an IPv4 address, without loopback, in
/// order.
std::vector<std::string> networks();

}  // namespace drover::ros2
