#include "publish/aimrt/joint_command.h"

#include <google/protobuf/stubs/logging.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "json/located_json.h"
#include "publish/aimrt/sensor.pb.h"

namespace drover::publish::aimrt {

namespace {

constexpr double kAbsurd = 1e5;  // rad, rad/s: no wheel and no joint
constexpr Duration kMaxAhead = std::chrono::seconds(1);
constexpr std::size_t kShownName = 40;

double ms(std::uint64_t ns) {
  return static_cast<double>(ns) * 1e-6;
}

/// Why the stamp is not believed; empty when it is.
Reason stamp_problem(std::uint64_t stamp_ns, Duration max_age, Duration wall,
                     std::uint64_t last_stamp_ns) {
  Reason reason;
  if (stamp_ns == 0) return reason;
  const auto now_ns = static_cast<std::uint64_t>(std::max<Duration::rep>(wall.count(), 0));
  const auto latest_ns = now_ns + static_cast<std::uint64_t>(kMaxAhead.count());
  const auto max_age_ns = static_cast<std::uint64_t>(max_age.count());
  if (now_ns > stamp_ns && now_ns - stamp_ns > max_age_ns) {
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

/// Why the numbers of one joint cannot be followed; empty when they can.
Reason number_problem(const JointCommandEntry& joint) {
  struct Field {
    const char* name;
    double value;
  };
  const std::array<Field, 5> fields{{{"position", joint.position_rad},
                                     {"velocity", joint.velocity_radps},
                                     {"effort", joint.effort_Nm},
                                     {"stiffness", joint.stiffness},
                                     {"damping", joint.damping}}};
  Reason reason;
  for (const auto& [name, value] : fields) {
    if (std::isfinite(value)) continue;
    reason.format("%s is %s", name, std::isnan(value) ? "NaN" : "infinite");
    return reason;
  }
  for (const auto& [name, value] : {fields[0], fields[1]}) {
    if (std::abs(value) <= kAbsurd) continue;
    reason.format("%s %g is absurd", name, value);
    return reason;
  }
  for (const auto& [name, value] : {fields[2], fields[3]}) {
    if (value == 0) continue;
    reason.format("%s is %g, but this drive follows velocity only: 0", name, value);
    return reason;
  }
  if (joint.damping < 0) reason.format("damping %g is negative", joint.damping);
  return reason;
}

}  // namespace

std::optional<JointCommandMessage> decode_joint_command(std::string_view bytes) {
  if (bytes.size() > kMaxCommandBytes) return std::nullopt;
  // The library would write to stderr for each message with bad UTF-8.
  static const bool quiet = (google::protobuf::SetLogHandler(nullptr), true);
  (void)quiet;
  ::aimrt::protocols::sensor::JointCommand decoded;
  if (!decoded.ParseFromArray(bytes.data(), static_cast<int>(bytes.size()))) return std::nullopt;
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
    const auto known = std::find(rules.joints.begin(), rules.joints.end(), joint.name);
    if (known == rules.joints.end()) return refused("there is no such joint");
    const auto axis = static_cast<std::size_t>(known - rules.joints.begin());
    if (axis >= named.size()) return refused("there is no such joint");
    if (std::exchange(named[axis], true)) return refused("it is named twice");
    reason = number_problem(joint);
    if (!reason.empty()) return refused(reason);
    // No more than the robot's joints, each once: it fits.
    (void)targets.joints.push_back({static_cast<AxisId>(axis), joint.velocity_radps});
  }
  return targets;
}

}  // namespace drover::publish::aimrt
