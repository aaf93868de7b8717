#include "publish/aimrt/joint_command.h"

#include <google/protobuf/stubs/logging.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "json/located_json.h"
#include "publish/aimrt/sensor.pb.h"
#include "publish/aimrt/wire_types.h"

namespace drover::publish::aimrt {

namespace {

constexpr double kAbsurd = 1e5;  // rad, rad/s, Nm, Nm/rad: no wheel and no joint
constexpr Duration kMaxAhead = std::chrono::seconds(1);
constexpr std::size_t kShownName = 40;

double ms(std::uint64_t ns) {
  return static_cast<double>(ns) * 1e-6;
}

/// What it would be if it were of today, though it should be nanoseconds; nullptr: none of these.
const char* other_unit(std::uint64_t stamp, std::uint64_t now_ns) {
  struct Unit {
    const char* name;
    std::uint64_t ns;
  };
  constexpr std::uint64_t kDay_ns = 86'400'000'000'000;
  for (const Unit& unit : {Unit{"seconds", 1'000'000'000}, Unit{"milliseconds", 1'000'000},
                           Unit{"microseconds", 1'000}}) {
    if (stamp > UINT64_MAX / unit.ns) continue;
    const std::uint64_t meant_ns = stamp * unit.ns;
    if (std::max(meant_ns, now_ns) - std::min(meant_ns, now_ns) < kDay_ns) return unit.name;
  }
  return nullptr;
}

/// Why the stamp is not believed; empty when it is.
Reason stamp_problem(std::uint64_t stamp_ns, Duration max_age, Duration wall,
                     std::uint64_t last_stamp_ns) {
  Reason reason;
  if (stamp_ns == 0) return reason;
  const auto now_ns = static_cast<std::uint64_t>(std::max<Duration::rep>(wall.count(), 0));
  const auto latest_ns = now_ns + static_cast<std::uint64_t>(kMaxAhead.count());
  const auto max_age_ns = static_cast<std::uint64_t>(max_age.count());
  // A clock at 1970 makes a day of every number.
  const bool dated = now_ns > 365 * std::uint64_t{86'400'000'000'000};
  const char* const unit = dated ? other_unit(stamp_ns, now_ns) : nullptr;
  if (unit != nullptr) {
    reason.format("time_stamp %llu is in %s: nanoseconds since 1970 are wanted",
                  static_cast<unsigned long long>(stamp_ns), unit);
  } else if (now_ns > stamp_ns && now_ns - stamp_ns > max_age_ns) {
    reason.format("time_stamp is %.0f ms old, %.0f ms are allowed", ms(now_ns - stamp_ns),
                  ms(max_age_ns));
  } else if (stamp_ns > latest_ns) {
    reason.format("time_stamp is %.0f ms ahead of the robot's clock", ms(stamp_ns - now_ns));
  } else if (stamp_ns <= last_stamp_ns && last_stamp_ns <= latest_ns) {
    // A last stamp beyond the latest possible one is from before the clock was set back.
    reason = "time_stamp is not newer than the last accepted one";
  }
  return reason;
}

/// What a joint follows, for people; and whether a value of its command has to be 0.
struct Followed {
  const char* what;
  bool velocity, effort, stiffness, damping;  ///< may be told
};

Followed followed(const JointRule& rule) {
  if (!rule.follows) return {"this drive follows velocity only", true, false, false, true};
  switch (*rule.follows) {
    case JointFollows::impedance: return {"it follows all five", true, true, true, true};
    case JointFollows::position:
      return {"it follows a position, as stiffly as is configured", true, false, false, false};
    case JointFollows::velocity: return {"it follows a velocity", true, false, false, true};
    case JointFollows::effort: break;
  }
  return {"it follows an effort", false, true, false, true};
}

/// Why the numbers of one joint cannot be followed; empty when they can.
Reason number_problem(const JointCommandEntry& joint, const JointRule& rule) {
  const Followed may = followed(rule);
  struct Field {
    const char* name;
    double value;
    bool may_be_told;
  };
  // A position without stiffness has no weight, whoever follows it.
  const std::array<Field, 5> fields{{{"position", joint.position_rad, true},
                                     {"velocity", joint.velocity_radps, may.velocity},
                                     {"effort", joint.effort_Nm, may.effort},
                                     {"stiffness", joint.stiffness, may.stiffness},
                                     {"damping", joint.damping, may.damping}}};
  Reason reason;
  for (const auto& field : fields) {
    if (std::isfinite(field.value)) continue;
    reason.format("%s is %s", field.name, std::isnan(field.value) ? "NaN" : "infinite");
    return reason;
  }
  for (const auto& field : fields) {
    if (std::abs(field.value) <= kAbsurd) continue;
    reason.format("%s %g is beyond the limit of %g", field.name, field.value, kAbsurd);
    return reason;
  }
  for (const auto& field : fields) {
    if (field.may_be_told || field.value == 0) continue;
    reason.format("%s is %g, but %s: 0", field.name, field.value, may.what);
    return reason;
  }
  for (const auto& field : {fields[3], fields[4]}) {
    if (field.value >= 0) continue;
    reason.format("%s %g is negative", field.name, field.value);
    return reason;
  }
  // Zeros alone are an effort of 0: of a program that balances it, say.
  const bool limp = joint.stiffness == 0 && joint.damping == 0 && joint.effort_Nm == 0;
  const bool asks = joint.position_rad != 0 || joint.velocity_radps != 0;
  if (rule.carries_weight && rule.follows == JointFollows::impedance && limp && asks)
    reason = "stiffness, damping and effort are 0: it carries a weight, and would fall";
  return reason;
}

}  // namespace

Result<JointCommandMessage, Reason> decode_joint_command(std::string_view bytes) {
  if (bytes.size() > kMaxCommandBytes) return Reason();
  // The library would write to stderr for each message with bad UTF-8.
  static const bool quiet = (google::protobuf::SetLogHandler(nullptr), true);
  (void)quiet;
  ::aimrt::protocols::sensor::JointCommand decoded;
  if (!decoded.ParseFromArray(bytes.data(), static_cast<int>(bytes.size()))) return Reason();
  if (Reason why = wire_type_problem(bytes); !why.empty()) return why;
  JointCommandMessage message;
  message.stamp_ns = decoded.header().time_stamp();
  message.sequence = decoded.header().sequence_num();
  message.frame_id = decoded.header().frame_id();
  message.joints.reserve(static_cast<std::size_t>(decoded.joints_size()));
  for (const auto& joint : decoded.joints()) {
    message.joints.push_back({joint.name(), joint.position(), joint.velocity(), joint.effort(),
                              joint.stiffness(), joint.damping()});
  }
  return message;
}

std::vector<JointRule>::const_iterator find_joint(const JointCommandRules& rules,
                                                  std::string_view name) {
  return std::find_if(rules.joints.begin(), rules.joints.end(),
                      [name](const JointRule& joint) { return joint.name == name; });
}

Result<JointTargets, Reason> accept_joint_command(const JointCommandMessage& message,
                                                  const JointCommandRules& rules, Duration wall,
                                                  std::uint64_t last_stamp_ns) {
  Reason reason = stamp_problem(message.stamp_ns, rules.max_age, wall, last_stamp_ns);
  if (!reason.empty()) return reason;
  if (rules.joints.empty()) return Reason("this robot has no joints: its base takes a twist");
  if (message.joints.empty()) return Reason("it names no joint");
  if (message.joints.size() > rules.joints.size()) {
    reason.format("it names %zu joints, this robot has %zu", message.joints.size(),
                  rules.joints.size());
    return reason;
  }
  JointTargets targets;
  std::array<bool, kMaxAxes> named{};
  for (const auto& joint : message.joints) {
    const auto refused = [&joint](std::string_view why) {
      return Reason("joint '" + json::shown(joint.name, kShownName) + "': " + std::string(why));
    };
    const auto known = find_joint(rules, joint.name);
    if (known == rules.joints.end()) return refused("there is no such joint");
    const auto axis = static_cast<std::size_t>(known - rules.joints.begin());
    if (axis >= named.size()) return refused("there is no such joint");
    if (std::exchange(named[axis], true)) return refused("it is named twice");
    reason = number_problem(joint, *known);
    if (!reason.empty()) return refused(reason);
    // No more than the robot's joints, each once: it fits.
    (void)targets.joints.push_back({static_cast<AxisId>(axis), joint.velocity_radps,
                                    joint.position_rad, joint.effort_Nm, joint.stiffness,
                                    joint.damping});
  }
  return targets;
}

}  // namespace drover::publish::aimrt
