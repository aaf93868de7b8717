// Who is not met because of a quality of service: DDS tells nobody but us.
#pragma once

#include <dds/dds.h>

#include <cstdint>
#include <string>
#include <vector>

namespace drover::ros2 {

struct Unmet {
  std::int64_t count = 0;         ///< that are there now
  std::vector<std::string> news;  ///< which ones are new since last time, for a person
};

/// Adds who is not met by `writer` of `topic` ("odom"). `known`: how many ever were so last time.
void add_unmet_readers(dds_entity_t writer, const std::string& topic, std::uint32_t& known,
                       Unmet& unmet);
/// Likewise by `reader`.
void add_unmet_writers(dds_entity_t reader, const std::string& topic, std::uint32_t& known,
                       Unmet& unmet);

}  // namespace drover::ros2
