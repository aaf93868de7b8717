// An object that has grown beyond what one message carries, as messages that make it again.
#pragma once

#include <vector>

#include "scene/message/collision_object.h"

namespace drover::scene {

/// The first with the object's operation, the others APPEND; each kind of shape in its order, each
/// with its pose. One message when that is enough, also without any shape. APPENDs may make an
/// object of any size, and whoever stores it must be able to read it again.
std::vector<CollisionObject> in_messages(const CollisionObject& object);

}  // namespace drover::scene
