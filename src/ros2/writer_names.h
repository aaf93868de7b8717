// Who wrote a sample, as `ros2 topic info -v` shows him.
#pragma once

#include <dds/dds.h>

#include <string>

namespace drover::ros2 {

/// Sixteen bytes in hex, with dots between.
std::string guid_text(const dds_guid_t& guid);

/// His GUID. Of one that is gone a name that no other one
/// has all the same: programs are told apart by it.
std::string writer_name(dds_entity_t reader, dds_instance_handle_t writer);

}  // namespace drover::ros2
