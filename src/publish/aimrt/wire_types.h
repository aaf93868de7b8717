// What stands in the bytes of a JointCommand under a number that it has, and is of another type
// than that field: written by another definition of the message.
#pragma once

#include <string_view>

#include "drover/fixed_text.h"

namespace drover::publish::aimrt {

/// The first such field with its place, like "joints[0].position is no double"; empty when there is
/// none. `bytes` is what protobuf read without an error.
Reason wire_type_problem(std::string_view bytes);

}  // namespace drover::publish::aimrt
