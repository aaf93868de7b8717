#include "scene/constraint/evaluate.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "scene/constraint/at_start.h"
#include "scene/constraint/kinds.h"
#include "scene/message/check.h"
#include "scene/world/map_change.h"

namespace drover::scene {
namespace {

const std::string& subject(const JointConstraint& joint) {
  return joint.joint_name;
}
const std::string& subject(const PositionConstraint& position) {
  return position.link_name;
}
const std::string& subject(const OrientationConstraint& orientation) {
  return orientation.link_name;
}
const std::string& subject(const VisibilityConstraint& visibility) {
  return visibility.sensor_pose.header.frame_id;
}

/// False: it is not of this list, and `i` is what it is from there on.
template <class Kind>
bool judge_in(const Constraints& set, const std::vector<Kind>& list, const char* list_name,
              std::size_t& i, const Setting& setting, bool named,
              const std::function<void(Verdict)>& take) {
  if (i >= list.size()) {
    i -= list.size();
    return false;
  }
  if (setting.moment == Moment::ahead && known_ahead(list[i]) == Ahead::nothing) return true;
  const Finding finding = finding_of(list[i], setting);
  Verdict verdict{finding.holds, finding.error, weight_of(list[i].weight), "", finding.why};
  // Infinite rather than no number: it is put in order.
  if (std::isnan(verdict.error)) verdict.error = std::numeric_limits<double>::infinity();
  if (named || !finding.holds)
    verdict.which = set.name + "." + check::element(list_name, i) + " (" + subject(list[i]) + ")";
  take(std::move(verdict));
  return true;
}

/// The map about `origin` seen from the one in force, as it is at the robot.
Pose2 map_seen_at(Pose2 base, const GeodeticPoint& origin, const GeodeticPoint& in_force) {
  if (same_origin(origin, in_force)) return {};
  if (!std::isfinite(base.yaw_rad)) base.yaw_rad = 0;  // both maps are there, wherever it looks
  return product(base, back(moved(base, in_force, origin)));
}

}  // namespace

double weight_of(double told) {
  return std::isfinite(told) && told > std::numeric_limits<double>::epsilon() ? told : 1;
}

Setting setting_of(const ConstraintSet& set, const World& world, const RobotModel& robot,
                   const RobotState& state, const Terms& terms, Moment moment) {
  Setting setting{robot, state, world.objects(), terms, {}, moment};
  if (set.origin && world.origin())
    setting.their_map = map_seen_at(state.base, *set.origin, *world.origin());
  return setting;
}

void judge(const Constraints& set, const Setting& setting, bool named,
           const std::function<void(Verdict)>& take) {
  for (std::size_t i = 0; i < count_of(set); ++i) judge_one(set, i, setting, named, take);
}

std::size_t count_of(const Constraints& set) {
  return set.joint_constraints.size() + set.position_constraints.size() +
         set.orientation_constraints.size() + set.visibility_constraints.size();
}

void judge_one(const Constraints& set, std::size_t i, const Setting& setting, bool named,
               const std::function<void(Verdict)>& take) {
  if (judge_in(set, set.joint_constraints, "joint_constraints", i, setting, named, take)) return;
  if (judge_in(set, set.position_constraints, "position_constraints", i, setting, named, take))
    return;
  if (judge_in(set, set.orientation_constraints, "orientation_constraints", i, setting, named,
               take))
    return;
  judge_in(set, set.visibility_constraints, "visibility_constraints", i, setting, named, take);
}

std::vector<Verdict> evaluate(const World& world, const RobotModel& robot, const RobotState& state,
                              const Terms& terms) {
  std::vector<Verdict> verdicts;
  for (const ConstraintSet& set : world.constraints()) {
    const Setting setting = setting_of(set, world, robot, state, terms, Moment::now_here);
    judge(set.message, setting, true,
          [&](Verdict verdict) { verdicts.push_back(std::move(verdict)); });
  }
  std::ranges::stable_sort(verdicts, std::ranges::greater{},
                           [](const Verdict& verdict) { return verdict.weight * verdict.error; });
  return verdicts;
}

std::optional<Verdict> heaviest_broken(const World& world, const RobotModel& robot,
                                       const RobotState& state, const Terms& terms) {
  std::optional<Verdict> worst;
  const auto keep_worst = [&](Verdict verdict) {
    if (verdict.holds) return;
    if (worst && worst->weight * worst->error >= verdict.weight * verdict.error) return;
    worst = std::move(verdict);
  };
  for (const ConstraintSet& set : world.constraints())
    judge(set.message, setting_of(set, world, robot, state, terms, Moment::now_here), false,
          keep_worst);
  return worst;
}

bool all_hold(const std::vector<Verdict>& verdicts) {
  return std::ranges::all_of(verdicts, &Verdict::holds);
}

}  // namespace drover::scene
