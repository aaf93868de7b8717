// A ROS 2 user on the robot's computer, who is plain DDS.
#pragma once

#include <dds/dds.h>

#include <cstdint>
#include <string>

#include "ros2/topics.h"

namespace drover::test {

/// Whether he was told to stay on this computer, and how.
enum class User : std::uint8_t {
  humble,    ///< ROS_LOCALHOST_ONLY=1: he uses lo
  jazzy,     ///< ROS_AUTOMATIC_DISCOVERY_RANGE=LOCALHOST: he uses the network's address
  defaults,  ///< he was not: multicast in his network
};

/// Of his domain, as rmw_cyclonedds says it.
std::string settings_of(User user);

dds_entity_t make_writer(dds_entity_t participant, const ros2::TopicKind& kind,
                         dds_reliability_kind_t reliability);

/// As rmw_cyclonedds makes it.
dds_entity_t make_reader(dds_entity_t participant, const ros2::TopicKind& kind,
                         dds_reliability_kind_t reliability,
                         dds_durability_kind_t durability = DDS_DURABILITY_VOLATILE);

}  // namespace drover::test
