// The document's words for operations.
#pragma once

#include <cstdint>
#include <string_view>

#include "scene/message/collision_object.h"

namespace drover::publish {

/// Empty: there is no such operation.
constexpr std::string_view operation_word(std::uint8_t operation) {
  switch (operation) {
    case scene::CollisionObject::ADD: return "ADD";
    case scene::CollisionObject::REMOVE: return "REMOVE";
    case scene::CollisionObject::APPEND: return "APPEND";
    case scene::CollisionObject::MOVE: return "MOVE";
    default: return {};
  }
}

}  // namespace drover::publish
