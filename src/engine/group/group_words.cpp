// The sentences that a group of joints says of itself.
#include "engine/group/group_words.h"

#include <algorithm>

namespace drover::engine {

Reason of_joint(const Name& joint, const Reason& what) {
  Reason text = joint.view();
  text.append(": ");
  text.append(what);
  return text;
}

Reason trouble_of(const AxisSnapshot& axis, bool heard) {
  if (!heard) {
    const Reason& said = axis.source.reason;
    return said.empty() ? Reason("its drive is silent") : said;
  }
  if (axis.state != AxisState::fault || axis.lapsed) return {};
  return axis.fault.empty() ? Reason("its drive has a fault") : axis.fault;
}

bool awaits_pause(std::span<const JointServo> joints) {
  return std::any_of(joints.begin(), joints.end(),
                     [](const JointServo& joint) { return joint.awaits_pause(); });
}

Reason pause_first(std::span<const JointServo> joints, std::span<const AxisSnapshot> axes) {
  if (!awaits_pause(joints)) return {};
  Reason cause;
  for (const JointServo& joint : joints) {
    if (!cause.empty() || joint.stopped_by().empty()) continue;
    cause = joint.stopped_by_itself() ? of_joint(axes[joint.rules().axis].joint, joint.stopped_by())
                                      : joint.stopped_by();
  }
  Reason text = kPauseFirst;
  if (cause.empty()) return text;
  text.append(" by ");
  text.append(cause);
  return text;
}

Reason with_lost(std::span<const JointServo> joints, std::span<const AxisSnapshot> axes,
                 const Reason& why) {
  Reason text;
  const Reason* first = nullptr;
  for (const JointServo& joint : joints) {
    if (joint.lost().empty()) continue;
    if (why.view().find(joint.lost().view()) != std::string_view::npos) continue;
    if (first != nullptr) text.append(", ");
    text.append(axes[joint.rules().axis].joint);
    if (first == nullptr) first = &joint.lost();
  }
  if (first == nullptr) return why;
  text.append(": not held by anybody: ");
  text.append(*first);
  if (!why.empty()) text.append("; ");
  text.append(why);
  return text;
}

Reason not_running(std::span<const JointServo> joints, std::span<const AxisSnapshot> axes,
                   GroupState state) {
  for (const JointServo& joint : joints) {
    const AxisSnapshot& axis = axes[joint.rules().axis];
    if (const Reason trouble = trouble_of(axis, true); !trouble.empty())
      return of_joint(axis.joint, trouble);
  }
  if (state != GroupState::arming) return {};
  for (const JointServo& joint : joints) {
    const AxisSnapshot& axis = axes[joint.rules().axis];
    if (joint.state() == GroupState::arming && axis.state != AxisState::running)
      return of_joint(axis.joint, "its drive comes into closed loop");
  }
  return {};
}

}  // namespace drover::engine
