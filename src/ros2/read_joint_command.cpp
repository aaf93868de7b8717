#include "ros2/read_joint_command.h"

#include <cmath>

#include "json/json_text.h"
#include "json/located_json.h"
#include "ros2/samples.h"

namespace drover::ros2 {
namespace {

/// No joint of ours has such a name.
constexpr std::size_t kLongestJointName = 255;
constexpr std::size_t kShownOfAName = 40;
constexpr std::uint32_t kWholeSecond_ns = 1'000'000'000;

/// As protobuf's JSON says what is no number.
void value(json::JsonText& out, const char* name, double told) {
  out.key(name);
  if (std::isfinite(told))
    out.number(told);
  else
    out.text(std::isnan(told) ? "NaN" : told > 0 ? "Infinity" : "-Infinity");
}

}  // namespace

Result<std::string, Reason> read_joint_command(
    const aimrt_msgs_msg_dds__JointCommandArray_& message, std::size_t joints) {
  const auto& stamp = message.header_.stamp_;
  if (stamp.sec_ < 0 || stamp.nanosec_ >= kWholeSecond_ns)
    return Reason("header.stamp is no time since 1970");
  const std::size_t count = message.joints_._length;
  if (count > joints)
    return Reason("it names " + std::to_string(count) + " joints, this robot has " +
                  std::to_string(joints));
  json::JsonText out;
  out.open('{').key("header").open('{');
  out.key("time_stamp")
      .text(std::to_string(static_cast<std::uint64_t>(stamp.sec_) * kWholeSecond_ns +
                           stamp.nanosec_));
  out.close('}').key("joints").open('[');
  for (std::size_t i = 0; i < count; ++i) {
    const auto& joint = message.joints_._buffer[i];
    const auto name = text_of(joint.name_);
    if (name.size() > kLongestJointName)
      return Reason("joint '" + json::shown(name, kShownOfAName) + "': there is no such joint");
    out.open('{').key("name").text(name);
    value(out, "position", joint.position_);
    value(out, "velocity", joint.velocity_);
    value(out, "effort", joint.effort_);
    value(out, "stiffness", joint.stiffness_);
    value(out, "damping", joint.damping_);
    out.close('}');
  }
  return out.close(']').close('}').take();
}

}  // namespace drover::ros2
