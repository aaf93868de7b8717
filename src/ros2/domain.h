// A DDS domain with one participant, as closed as it was asked for.
#pragma once

#include <dds/dds.h>

#include <optional>
#include <span>
#include <stdexcept>
#include <string>

#include "ros2/networks.h"

namespace drover::ros2 {

/// Whom the domain meets.
enum class Reach : std::uint8_t {
  localhost,  ///< programs on this computer: its sockets take nothing from a network
  network,    ///< and whoever reaches its network
};

/// The domain cannot be made as it was asked for, so there is none.
struct NoDomain : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Cyclone DDS' configuration. `network`: the one that is used beside loopback.
std::string domain_settings(Reach reach, const std::optional<Network>& network);

class Domain final {
 public:
  /// Call it in a thread without real-time priority: those of DDS inherit it. Throws NoDomain, also
  /// when its sockets cannot be closed towards networks: nobody reads or writes then.
  Domain(int number, Reach reach, const std::optional<Network>& network);
  ~Domain();
  Domain(const Domain&) = delete;
  Domain& operator=(const Domain&) = delete;

  dds_entity_t participant() const { return participant_; }

 private:
  dds_entity_t domain_ = 0;
  dds_entity_t participant_ = 0;
};

/// Closes each internet datagram socket of this process to networks: it takes what came over the
/// loopback device, whatever address that was sent to, and sends nothing over another one. Returns
/// how many there were. Throws NoDomain when one cannot be closed.
std::size_t close_to_networks();

}  // namespace drover::ros2
