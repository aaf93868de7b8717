// Where a way leads out of what constraints permit of the robot's place.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "scene/constraint/setting.h"
#include "scene/plane/steps.h"
#include "scene/world/world.h"

namespace drover::scene {

struct Edge {
  // Until there: the last place at which it holds, to a millimetre and a twentieth of a degree.
  double driven_m = 0;
  double turned_rad = 0;
  std::string which;  ///< as Verdict::which
};

/// The constraints of the world that a place alone breaks: positions, base/x, base/y, base/theta,
/// yaws. Views are none of them: one may cost more than the whole look.
class Edges final {
 public:
  /// Borrows world, robot and terms. Those that hold at `here` only, for what is broken is another
  /// one's to tell; and only as many as may be judged at a hundred poses, many times a second.
  Edges(const World& world, const RobotModel& robot, const Terms& terms, const Pose2& here);

  bool empty() const { return bounds_.empty(); }
  /// The first one on a way; nothing: all of them hold on all of it. What ends and begins again
  /// between two steps is not found.
  std::optional<Edge> first(std::span<const Step> steps) const;
  /// The same on all ways from a place in whichever direction, for who does not know where it
  /// looks: within `driven_m` of it all of them hold. Nothing: within `most_m`.
  std::optional<Edge> around(const Pose2& here, double most_m) const;

 private:
  struct Bound {
    const ConstraintSet* set = nullptr;
    std::size_t item = 0;   ///< as judge_one counts
    bool of_point = false;  ///< base_link's place breaks it, however it is turned
  };
  /// "" when it holds there.
  std::string broken(const Bound& bound, const Pose2& at) const;
  std::string broken(const Bound& bound, const Pose2& at, const Terms& terms) const;
  /// "" when it holds wherever the robot may be that was moved from there by so much.
  std::string broken_about(const Bound& bound, const Pose2& at, double moved_m) const;
  std::string broken_about(const Pose2& at, double moved_m) const;
  /// The part of a step until which it holds, when it does not at its end.
  double last_held(const Bound& bound, const Pose2& from, const Pose2& to) const;

  const World& world_;
  const RobotModel& robot_;
  const Terms& terms_;
  std::vector<Bound> bounds_;
};

}  // namespace drover::scene
