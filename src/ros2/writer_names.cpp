#include "ros2/writer_names.h"

#include <array>
#include <cstdio>
#include <memory>

namespace drover::ros2 {

std::string guid_text(const dds_guid_t& guid) {
  std::string name;
  for (const auto byte : guid.v) {
    std::array<char, 4> hex{};
    std::snprintf(hex.data(), hex.size(), "%02x", static_cast<unsigned>(byte));
    name += (name.empty() ? "" : ".") + std::string(hex.data());
  }
  return name;
}

std::string writer_name(dds_entity_t reader, dds_instance_handle_t writer) {
  const std::unique_ptr<dds_builtintopic_endpoint_t, void (*)(dds_builtintopic_endpoint_t*)> told(
      dds_get_matched_publication_data(reader, writer), dds_builtintopic_free_endpoint);
  if (!told) return "one that is gone, number " + std::to_string(writer);
  return guid_text(told->key);
}

}  // namespace drover::ros2
