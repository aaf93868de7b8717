// Joints outside the base: each of one group, with a drive that can do what its rules say.
#include <algorithm>

#include "config/check_subjects.h"
#include "config/taken.h"
#include "text/number.h"
#include "text/suggestion.h"

namespace drover::config {
namespace {

struct Moved {
  const DeviceConfig* device = nullptr;
  std::size_t joint = 0;  ///< in the device's list, and so in its axes
};

Moved find_joint(const std::string& name, const DroverConfig& config) {
  for (const auto& device : config.devices)
    for (std::size_t i = 0; i < device.joints.size(); ++i)
      if (device.joints[i].name == name) return {&device, i};
  return {};
}

/// By their place among the words of a choice, which the reader has seen to.
template <class Kind, std::size_t N>
Kind by_word(const std::array<std::string_view, N>& words, std::string_view word) {
  const auto it = std::find(words.begin(), words.end(), word);
  return static_cast<Kind>(it == words.end() ? 0 : it - words.begin());
}

void limits(const std::string& path, const engine::JointRules& rules, Findings& found) {
  if (rules.min_rad < rules.max_rad || found.has_problem(path)) return;
  found.add(path + ".max_rad",
            "is " + text::number_text(rules.max_rad) + ", and min_rad is " +
                text::number_text(rules.min_rad),
            "the joint moves between the two");
}

/// The end of a stream is no stop, and so nothing holds it then.
void no_falling(const std::string& path, const engine::JointRules& rules, Findings& found) {
  if (!rules.carries_weight || rules.on_silence != engine::OnSilence::release) return;
  if (found.accepts("lets_fall")) return;
  found.add(
      path + ".on_silence",
      "is release, and the joint carries a weight, which falls when its commands cease",
      "hold, or damp, or \"accept\": [\"lets_fall\"] at the top of the file when that is meant");
}

/// Held is a joint also at every stop, whatever on_silence says.
void able_to_hold(const std::string& path, const engine::JointRules& rules, Findings& found) {
  // In arms that hold it is some hundredths of a second; with less they swing for seconds.
  constexpr double kLeastDamping_s = 0.002;
  const double damping = rules.damping_Nmsprad;
  if (found.is_wrong(path + ".stiffness_Nmprad") || found.is_wrong(path + ".damping_Nmsprad"))
    return;
  const bool has_to = rules.carries_weight || rules.on_silence == engine::OnSilence::hold;
  if (rules.stiffness_Nmprad == 0 && has_to)
    found.add(path + ".stiffness_Nmprad",
              std::string("is 0, so nothing keeps the joint in its place when it is held: at "
                          "every stop") +
                  (rules.on_silence == engine::OnSilence::hold
                       ? ", and when its commands cease (on_silence is hold)"
                       : ""),
              rules.carries_weight ? "one at which its weight sags little"
                                   : "a stiffness, or \"on_silence\": \"damp\"");
  if (damping == 0)
    return found.add(path + ".damping_Nmsprad",
                     "is 0: held, the joint swings about, and nothing damps it",
                     "a few hundredths of its stiffness");
  const double least = kLeastDamping_s * rules.stiffness_Nmprad;
  if (damping < least)
    found.warn(path + ".damping_Nmsprad",
               "is " + text::number_text(damping) + ", with a stiffness of " +
                   text::number_text(rules.stiffness_Nmprad) +
                   " Nm/rad: held, the joint swings for long",
               "swings", text::number_text(least) + " or more");
}

/// Whether it falls, and keeps its effort when it is held, nobody else knows.
void ask_for_weight(const std::string& path, Findings& found) {
  const auto key = path + ".carries_weight";
  if (found.given(key)) return;
  found.hint_at(path,
                "does not say whether it carries a weight, which falls without power, and sags "
                "where it is held unless this is told",
                "\"carries_weight\": true, or false when nothing pulls at it");
}

/// What is fed, armed and stopped together has one owner.
void whole_device(const std::string& path, const JointGroup& group, const DeviceConfig& device,
                  Findings& found) {
  for (const auto& other : device.joints)
    if (!has_joint(group, other.name))
      found.add(path,
                "its device " + device.name + " moves \"" + other.name +
                    "\" too, which is not of this group",
                "joints of one device belong to one group");
}

void no_wheel(const std::string& path, const BaseNames& base, const std::string& joint,
              Findings& found) {
  for (const auto& [side, wheels] : {std::pair{"left", &base.left}, {"right", &base.right}})
    if (std::find(wheels->begin(), wheels->end(), joint) != wheels->end())
      return found.add(path, "\"" + joint + "\" is used by groups.base." + side + " already");
}

void joint(const std::string& path, const JointGroup& group, const GroupJoint& given,
           engine::GroupConfig& into, Findings& found) {
  const Moved moved = find_joint(given.name, found.config());
  if (moved.device == nullptr) {
    // One joint, with its device's name: what that is nobody knows without its driver.
    if (found.is_wrong("devices." + given.name + ".driver")) return;
    std::vector<std::string> known;
    for (const auto& device : found.config().devices)
      for (const auto& each : device.joints) known.push_back(each.name);
    return found.add(path, "no device has this joint", text::did_you_mean(given.name, known));
  }
  const auto* const entry = find_driver(moved.device->driver);
  const std::size_t channel = moved.device->joints[moved.joint].channel_index;
  if (entry == nullptr || channel >= entry->channels.size()) return;  // told already
  if (entry->channels[channel].mode != ChannelMode::impedance)
    return found.add(path, "its drive (" + moved.device->driver + ") follows a velocity alone",
                     "outside the base a drive has to follow position, effort, stiffness and "
                     "damping, too; a wheel belongs into groups.base");
  whole_device(path, group, *moved.device, found);
  limits(path, given.rules, found);
  engine::JointRules rules = given.rules;
  rules.axis = static_cast<AxisId>(moved.device->first_axis + moved.joint);
  rules.follows = by_word<JointFollows>(kFollowsWords, given.follows);
  rules.on_silence = by_word<engine::OnSilence>(kSilenceWords, given.on_silence);
  no_falling(path, rules, found);
  able_to_hold(path, rules, found);
  ask_for_weight(path, found);
  (void)into.joints.push_back(rules);  // too many are told by the reader
}

}  // namespace

bool has_joint(const JointGroup& group, const std::string& joint) {
  return std::any_of(group.joints.begin(), group.joints.end(),
                     [&](const GroupJoint& each) { return each.name == joint; });
}

bool has_joint(const std::vector<JointGroup>& groups, const std::string& joint) {
  return std::any_of(groups.begin(), groups.end(),
                     [&](const JointGroup& group) { return has_joint(group, joint); });
}

void check_groups(const GroupNames& groups, Findings& found) {
  auto& engine = found.config().engine;
  Taken taken(found);
  for (const auto& given : groups.others) {
    engine::GroupConfig group;
    group.name = Name(given.name);
    for (const auto& each : given.joints) {
      const auto path = "groups." + given.name + ".joints." + each.name;
      taken.take(each.name, path);
      no_wheel(path, groups.base, each.name, found);
      joint(path, given, each, group, found);
    }
    (void)engine.groups.push_back(group);
  }
}

}  // namespace drover::config
