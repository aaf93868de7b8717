// All constraints of the world at one state of the robot.
#pragma once

#include <functional>
#include <optional>
#include <string_view>
#include <vector>

#include "scene/constraint/setting.h"
#include "scene/constraint/verdict.h"
#include "scene/world/world.h"

namespace drover::scene {

/// Of every constraint, those that weigh most first: by weight times error.
std::vector<Verdict> evaluate(const World& world, const RobotModel& robot, const RobotState& state,
                              const Terms& terms = {});
/// Of those that do not hold the one that weighs most; nothing: all hold.
std::optional<Verdict> heaviest_broken(const World& world, const RobotModel& robot,
                                       const RobotState& state, const Terms& terms = {});
/// Satisfied only if all are. No constraints: satisfied.
bool all_hold(const std::vector<Verdict>& verdicts);

/// What one set and state are judged in.
Setting setting_of(const ConstraintSet& set, const World& world, const RobotModel& robot,
                   const RobotState& state, const Terms& terms, Moment moment);
/// 0, absent and what is no weight count as 1.
double weight_of(double told);

/// Judges every constraint of the set; those that are not known ahead are left out then. `take`
/// gets the verdict; `which` of those that hold is empty unless `named`.
void judge(const Constraints& set, const Setting& setting, bool named,
           const std::function<void(Verdict)>& take);
/// Of all kinds, numbered from 0 in the order of the message; and one of them, judged as above.
std::size_t count_of(const Constraints& set);
void judge_one(const Constraints& set, std::size_t i, const Setting& setting, bool named,
               const std::function<void(Verdict)>& take);

}  // namespace drover::scene
