// Whether a message of the third document can be followed, whoever brought it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "drover/result.h"
#include "scene/message/collision_object.h"
#include "scene/message/constraints.h"
#include "scene/message/refusal.h"

namespace drover::scene {

/// A dimension of a shape, and the radius of a target. A missing decimal point is found, a hall is
/// not refused.
inline constexpr double kMaxSize_m = 10'000;
/// A dimension of a primitive. What is smaller is a mistake, and its square may be nothing.
inline constexpr double kMinSize_m = 1e-6;
/// A coordinate. Maps may count as a country's grid does, in which 4.5e6 m are usual.
inline constexpr double kMaxCoordinate_m = 1e7;
inline constexpr std::size_t kMaxShapes = 1000;       ///< of a kind, in one message
inline constexpr std::size_t kMaxTriangles = 10'000;  ///< of all meshes of one message
inline constexpr std::size_t kMaxVertices = 30'000;   ///< likewise: no triangle shares one
inline constexpr std::size_t kMaxConstraints = 100;   ///< of one message
inline constexpr std::int32_t kMaxConeSides = 100;    ///< of a visibility cone
inline constexpr std::size_t kMaxNameBytes = 200;     ///< of an id, a name, a frame
inline constexpr double kMaxQuaternionError = 1e-3;   ///< of its length
inline constexpr std::size_t kMaxNotes = 10;          ///< of one message; the last says "and more"

/// A message that may be used: every number finite and inside its bounds, a pose for each shape,
/// turns of unit length.
template <class Message>
struct Accepted {
  Message message;
  /// What was taken otherwise than it was written, each with its place.
  std::vector<std::string> notes;
};

/// ADD, APPEND: at least one shape, in a frame. MOVE: poses only, in a frame; that they are as many
/// as the object has shapes is for who knows it. REMOVE: an id; what else it carries is dropped.
Result<Accepted<CollisionObject>, Refusal> validate(CollisionObject object);
/// Without any constraint it is accepted, too: it clears what had this name.
Result<Accepted<Constraints>, Refusal> validate(Constraints constraints);

}  // namespace drover::scene
