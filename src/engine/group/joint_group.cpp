// Joints outside the base that belong together, under an owner of their own.
#include "engine/group/joint_group.h"

#include <algorithm>
#include <cmath>

#include "engine/group/group_words.h"
#include "engine/health/heard.h"

namespace drover::engine {
namespace {

constexpr Duration kBetweenLimits = std::chrono::seconds(1);
constexpr Duration kBetweenFound = std::chrono::seconds(1);

int width(std::string_view text) {
  return static_cast<int>(text.size());
}

/// "elbow (position, effort)".
Reason limits_of(const Name& joint, JointValues limited) {
  Reason text = joint.view();
  std::string_view before = " (";
  for (std::size_t i = 0; i < kJointValueWords.size(); ++i) {
    if ((limited & bit(static_cast<JointValue>(i))) == 0) continue;
    text.append(before);
    text.append(kJointValueWords[i]);
    before = ", ";
  }
  text.append(")");
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
    : start_timeout_(start_timeout), notices_(config.joints.size()) {
  told_.name = config.name;
  for (const JointRules& rules : config.joints) joints_.emplace_back(rules);
}

void JointGroup::take(const JointTargets& targets, RequestId::Source source, Time now) {
  if (!std::all_of(targets.joints.begin(), targets.joints.end(), is_sound)) {
    ++told_.refused;
    refuse({}, now);
    return;
  }
  const auto sender = source == RequestId::Source::ros2 ? GroupOwner::ros2 : GroupOwner::broker;
  const auto is_mine = [&](const JointTarget& target) {
    return std::any_of(joints_.begin(), joints_.end(),
                       [&](const JointServo& joint) { return joint.rules().axis == target.axis; });
  };
  if (std::none_of(targets.joints.begin(), targets.joints.end(), is_mine)) return;
  for (JointServo& joint : joints_) {
    // Of all of them: he may name them in turn.
    if (sender != sender_) joint.change_hands();
    for (const JointTarget& target : targets.joints)
      if (joint.rules().axis == target.axis) joint.take(target, now);
  }
  // Who names joints in turn pauses for none of them.
  for (JointServo& joint : joints_) joint.overhear(now);
  ++waiting_;
  sender_ = sender;
}

void JointGroup::refuse(const JointTargetsRefused& refused, Time now) {
  for (JointServo& joint : joints_) joint.refuse(refused.was_there, now);
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
    const bool heard = is_heard(axis, input.now, input.stale);
    const Reason why = heard && !follows ? Reason() : trouble_of(axis, heard);
    if (!why.empty()) return of_joint(axis.joint, why);
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
    if (joint.strained())
      notice(input.now, Notice::Level::warning, "", of_joint(axis.joint, joint.reason()), events);
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
  told_.reason = why_not(input, hindrance);
  count(limited, !hindrance.empty(), input.now);
  const bool off = told_.state == GroupState::idle || told_.state == GroupState::arming;
  if (told_.reason.empty() && off) told_.reason = not_running(joints_, input.axes, told_.state);
  tell(input, lost, limited, events);
  tell_drives(input, events);
  tell_found(input, events);
  tell_pause(hindrance.empty() && awaits_pause(joints_), input.now, events);
}

/// Why it does not follow, and who is held by nobody any more.
Reason JointGroup::why_not(const Input& input, const Reason& hindrance) const {
  // A trouble of its own names a drive already, as it is now.
  if (input.hindrance.empty() && !hindrance.empty()) return hindrance;
  Reason why = hindrance.empty() ? pause_first(joints_, input.axes) : hindrance;
  // Whose commands are refused now goes before what others were left with.
  for (const bool refused : {true, false}) {
    for (std::size_t i = 0; why.empty() && i < joints_.size(); ++i) {
      const Reason& said = joints_[i].reason();
      if (said.empty() || (refused && !joints_[i].refuses(input.now))) continue;
      const AxisSnapshot& axis = input.axes[joints_[i].rules().axis];
      why = joints_[i].by_itself() ? of_joint(axis.joint, said) : said;
    }
  }
  return with_lost(joints_, input.axes, why);
}

void JointGroup::notice(Time now, Notice::Level level, const char* what, std::string_view why,
                        EventQueue& events) const {
  Reason text;
  text.format("%.*s: %s%.*s", width(told_.name), told_.name.view().data(), what, width(why),
              why.data());
  events.notice(now, level, text);
}

/// What ended its commands, or left a joint without hold, is told as that.
void JointGroup::tell_drives(const Input& input, EventQueue& events) {
  for (std::size_t i = 0; i < joints_.size(); ++i) {
    const AxisSnapshot& axis = input.axes[joints_[i].rules().axis];
    const Reason why = trouble_of(axis, is_heard(axis, input.now, input.stale));
    const Reason named = why.empty() ? why : of_joint(axis.joint, why);
    notices_.update(input.now, i, told_.name, axis.joint, named, !joints_[i].lost().empty(),
                    events);
  }
}

/// After a restart, or a drive was gone for a moment: until now somebody else had it, or nobody.
void JointGroup::tell_found(const Input& input, EventQueue& events) {
  for (const JointServo& joint : joints_) found_running_ = found_running_ || joint.found_running();
  if (told_.state == GroupState::following) found_running_ = false;
  const bool held = told_.state == GroupState::holding || told_.state == GroupState::damping;
  if (!found_running_ || !held || input.blocked) return;
  found_running_ = false;
  if (found_told_ != kNever && input.now - found_told_ < kBetweenFound) return;
  found_told_ = input.now;
  notice(input.now, Notice::Level::info, "its drives were found running: held where it is", {},
         events);
}

/// Once: who goes on sending may do so for hours. What stopped it was told when it did.
void JointGroup::tell_pause(bool awaited, Time now, EventQueue& events) {
  if (told_.state == GroupState::following) pause_told_ = false;
  if (!awaited || pause_told_) return;
  pause_told_ = true;
  notice(now, Notice::Level::warning, kPauseFirst, {}, events);
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

void JointGroup::count(bool limited, bool hindered, Time now) {
  // That another joint's commands have ceased refuses nothing.
  const bool unwanted =
      hindered || std::any_of(joints_.begin(), joints_.end(),
                              [now](const auto& joint) { return joint.refuses(now); });
  const bool refused = told_.state != GroupState::following && unwanted;
  (refused ? told_.refused : told_.accepted) += waiting_;
  waiting_ = 0;
  told_.limited += limited ? 1 : 0;
}

void JointGroup::tell(const Input& input, const Reason& lost, bool limited, EventQueue& events) {
  const auto warn = [&](const char* what, std::string_view why) {
    notice(input.now, Notice::Level::warning, what, why, events);
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
      text.append(others);
      return text;
    }
    text.append(text.empty() ? "" : ", ");
    text.append(next);
    --left;
  }
  return text;
}

}  // namespace drover::engine
