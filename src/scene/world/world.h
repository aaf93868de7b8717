// What is around the robot and where it may be: messages applied one by one.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "drover/path.h"
#include "drover/result.h"
#include "scene/message/collision_object.h"
#include "scene/message/constraints.h"
#include "scene/message/refusal.h"
#include "scene/world/amount.h"
#include "scene/world/anchors.h"
#include "scene/world/object.h"
#include "scene/world/place.h"

namespace drover::scene {

/// What a message did.
struct Applied {
  enum class Effect : std::uint8_t { added, replaced, extended, moved, removed };
  Effect effect = Effect::added;
  std::uint64_t revision = 0;
  /// What is taken otherwise than somebody may think, each with its place in the message.
  std::vector<std::string> notes{};
};

/// A value: no clock, no descriptor. A refused message changes nothing.
class World final {
 public:
  /// Of a message that was found valid by itself (message/validate.h). Semantics: README.md here.
  Result<Applied, Refusal> apply(const CollisionObject& message, const Placement& placement);
  /// Replaces the set of that name; one that lists nothing removes it. In `map` it stays at its
  /// place on earth; in a frame of the robot it goes along.
  Result<Applied, Refusal> apply(const Constraints& message, const RobotModel& robot);

  /// What was stored under another origin than the one in force: an ADD or APPEND in `map` with the
  /// sigma that its place had, a set of constraints. It is at its place on earth.
  Result<Applied, Refusal> restore(const CollisionObject& message, const GeodeticPoint& origin,
                                   double place_sigma_m = 0);
  Result<Applied, Refusal> restore(const Constraints& message, const RobotModel& robot,
                                   const GeodeticPoint& origin);

  /// The origin of `map` is here from now on: everything stays at its place on earth. False, and
  /// nothing changed, when that is no place.
  bool move_origin(const GeodeticPoint& origin);
  const std::optional<GeodeticPoint>& origin() const { return origin_; }

  /// In the order in which their names first came.
  const std::vector<Object>& objects() const { return objects_; }
  const std::vector<ConstraintSet>& constraints() const { return constraints_; }
  const Object* object(std::string_view id) const;
  const ConstraintSet* constraint_set(std::string_view name) const;
  const Amount& amount() const { return amount_; }
  /// Another one after each change.
  std::uint64_t revision() const { return revision_; }

  /// For a person (`drover scene clear`): no message clears everything.
  void clear();

 private:
  Result<Applied, Refusal> add(const CollisionObject& message, const Ground& ground);
  Result<Applied, Refusal> append(const CollisionObject& message, const Ground& ground);
  Result<Applied, Refusal> move(const CollisionObject& message, const Ground& ground);
  Result<Applied, Refusal> remove(const CollisionObject& message);
  Result<Applied, Refusal> put(const Constraints& message, const RobotModel& robot,
                               const std::optional<GeodeticPoint>& origin);
  Object* find_object(std::string_view id);
  Applied changed(Applied::Effect effect) { return {effect, ++revision_}; }

  std::vector<Object> objects_;
  std::vector<ConstraintSet> constraints_;
  Amount amount_;  ///< of both
  std::optional<GeodeticPoint> origin_;
  std::uint64_t revision_ = 0;
};

}  // namespace drover::scene
