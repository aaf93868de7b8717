// Joints outside the base that belong together, under an owner of their own.
#include "engine/group/joint_group.h"

#include <algorithm>
#include <cmath>

#include "engine/health/heard.h"

namespace drover::engine {
namespace {

constexpr Duration kBetweenLimits = std::chrono::seconds(1);

int width(std::string_view text) {
  return static_cast<int>(text.size());
}

Reason of_joint(const Name& joint, const Reason& what) {
  Reason text;
  text.format("%.*s: %.*s", width(joint), joint.view().data(), width(what), what.view().data());
  return text;
}

void append(Reason& text, std::string_view more) {
  text.format("%.*s%.*s", width(text), text.view().data(), width(more), more.data());
}

/// "elbow (position, effort)".
Reason limits_of(const Name& joint, JointValues limited) {
  Reason text = joint.view();
  std::string_view before = " (";
  for (std::size_t i = 0; i < kJointValueWords.size(); ++i) {
    if ((limited & bit(static_cast<JointValue>(i))) == 0) continue;
    append(text, before);
    append(text, kJointValueWords[i]);
    before = ", ";
  }
  append(text, ")");
  return text;
}

/// Whoever makes the message: what cannot be would be in the set point for ever.
bool is_sound(const JointTarget& target) {
  const bool finite = std::isfinite(target.position_rad) && std::isfinite(target.velocity_radps) &&
                      std::isfinite(target.effort_Nm) && std::isfinite(target.stiffness_Nmprad) &&
                      std::isfinite(target.damping_Nmsprad);
  return finite && target.stiffness_Nmprad >= 0 && target.damping_Nmsprad >= 0;
}

bool is_heard(const AxisSnapshot& axis, Time now, Duration stale) {
  return axis.health == SourceState::fresh && tells_motion(axis, now, stale) &&
         std::isfinite(axis.motion.position_rad);
}

}  // namespace

JointGroup::JointGroup(const GroupConfig& config, Duration start_timeout)
    : start_timeout_(start_timeout) {
  told_.name = config.name;
  for (const JointRules& rules : config.joints) joints_.emplace_back(rules);
}

void JointGroup::take(const JointTargets& targets, RequestId::Source source, Time now) {
  if (!std::all_of(targets.joints.begin(), targets.joints.end(), is_sound)) {
    ++told_.refused;
    refuse(now);
    return;
  }
  bool mine = false;
  for (const JointTarget& target : targets.joints) {
    for (JointServo& joint : joints_) {
      if (joint.rules().axis != target.axis) continue;
      joint.take(target, now);
      mine = true;
    }
  }
  if (!mine) return;
  ++waiting_;
  sender_ = source == RequestId::Source::ros2 ? GroupOwner::ros2 : GroupOwner::broker;
}

void JointGroup::refuse(Time now) {
  for (JointServo& joint : joints_) joint.refuse(now);
}

void JointGroup::end(const Reason& why) {
  for (JointServo& joint : joints_) joint.end(why);
}

/// Why none of its joints may follow anybody: the first that cannot. A fault is cleared by who
/// begins anew, and ends what others follow.
Reason JointGroup::trouble(const Input& input) const {
  const bool follows = std::any_of(joints_.begin(), joints_.end(),
                                   [](const JointServo& joint) { return joint.following(); });
  for (const JointServo& joint : joints_) {
    const AxisSnapshot& axis = input.axes[joint.rules().axis];
    if (!is_heard(axis, input.now, input.stale)) {
      const Reason& said = axis.source.reason;
      return of_joint(axis.joint, said.empty() ? Reason("its drive is silent") : said);
    }
    if (follows && axis.state == AxisState::fault && !axis.lapsed)
      return of_joint(axis.joint, axis.fault);
  }
  return {};
}

void JointGroup::step(const Input& input, std::span<AxisCommand> commands, std::span<bool> may_move,
                      EventQueue& events) {
  const Reason hindrance = input.hindrance.empty() ? trouble(input) : input.hindrance;
  const bool ready = std::all_of(joints_.begin(), joints_.end(), [&](const JointServo& joint) {
    return !joint.asked(input.now) || input.axes[joint.rules().axis].state == AxisState::running;
  });
  Reason lost;
  for (JointServo& joint : joints_) {
    const AxisSnapshot& axis = input.axes[joint.rules().axis];
    const bool followed = joint.following();
    const bool was_well = joint.lost().empty();
    joint.step({input.now, input.dt, axis, is_heard(axis, input.now, input.stale), hindrance,
                start_timeout_, input.blocked, ready});
    const bool stopped = followed && !joint.following() && !hindrance.empty();
    if (lost.empty() && stopped) lost = hindrance;
    if (lost.empty() && joint.failed()) lost = of_joint(axis.joint, joint.reason());
    // Of one that followed it is told as the end of its commands.
    const bool told = followed && input.hindrance.empty();
    if (was_well && !told && !joint.lost().empty()) tell_lost(axis, joint, input.now, events);
  }
  // Together, or none: what one cannot do any more the others do not go on with.
  if (!lost.empty()) end(lost);
  told_.state = GroupState::idle;
  bool limited = false;
  for (JointServo& joint : joints_) {
    const AxisId axis = joint.rules().axis;
    commands[axis] = joint.command();
    may_move[axis] = joint.may_move();
    told_.state = std::min(told_.state, joint.state());
    limited = limited || joint.limited() != 0;
  }
  told_.owner = owner(input.estop);
  told_.reason = hindrance;
  for (std::size_t i = 0; told_.reason.empty() && i < joints_.size(); ++i)
    if (const Reason& why = joints_[i].reason(); !why.empty())
      told_.reason =
          joints_[i].by_itself() ? of_joint(input.axes[joints_[i].rules().axis].joint, why) : why;
  count(limited);
  tell(input, lost, limited, events);
}

void JointGroup::tell_lost(const AxisSnapshot& axis, const JointServo& joint, Time now,
                           EventQueue& events) const {
  Reason text;
  text.format("%.*s: %.*s is not held any more: %.*s", width(told_.name), told_.name.view().data(),
              width(axis.joint), axis.joint.view().data(), width(joint.lost()),
              joint.lost().view().data());
  events.notice(now, Notice::Level::error, text);
}

GroupOwner JointGroup::owner(bool estop) const {
  if (estop) return GroupOwner::estop;
  const bool owned = std::any_of(joints_.begin(), joints_.end(),
                                 [](const JointServo& joint) { return joint.follows(); });
  return owned ? sender_ : GroupOwner::nobody;
}

void JointGroup::count(bool limited) {
  const bool refused = told_.state != GroupState::following && !told_.reason.empty();
  (refused ? told_.refused : told_.accepted) += waiting_;
  waiting_ = 0;
  told_.limited += limited ? 1 : 0;
}

void JointGroup::tell(const Input& input, const Reason& lost, bool limited, EventQueue& events) {
  const auto warn = [&](const char* what, std::string_view why) {
    Reason text;
    text.format("%.*s: %s%.*s", width(told_.name), told_.name.view().data(), what, width(why),
                why.data());
    events.notice(input.now, Notice::Level::warning, text);
  };
  if (!lost.empty()) warn("joint commands ended: ", lost);
  if (!limited || (limited_told_ != kNever && input.now - limited_told_ < kBetweenLimits)) return;
  limited_told_ = input.now;
  constexpr std::string_view kWhat = "more was asked than the limits allow: ";
  const auto begins = told_.name.view().size() + std::string_view(": ").size() + kWhat.size();
  warn(kWhat.data(), all_limited(input.axes, Reason::capacity() - begins));
}

/// With what was asked of each; those that have no room are counted.
Reason JointGroup::all_limited(std::span<const AxisSnapshot> axes, std::size_t room) const {
  constexpr std::string_view kLongest = " and 15 more";
  Reason text;
  auto left = std::count_if(joints_.begin(), joints_.end(),
                            [](const JointServo& joint) { return joint.limited() != 0; });
  for (const JointServo& joint : joints_) {
    if (joint.limited() == 0) continue;
    const Reason next = limits_of(axes[joint.rules().axis].joint, joint.limited());
    const auto needs = text.view().size() + std::string_view(", ").size() + next.view().size() +
                       (left > 1 ? kLongest.size() : 0);
    if (!text.empty() && needs > room) {
      Reason others;
      others.format(" and %ld more", static_cast<long>(left));
      append(text, others);
      return text;
    }
    append(text, text.empty() ? "" : ", ");
    append(text, next);
    --left;
  }
  return text;
}

}  // namespace drover::engine
