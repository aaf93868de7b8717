#include "ros2/joint_command_input.h"

#include <algorithm>

#include "json/json_text.h"
#include "ros2/read_joint_command.h"
#include "ros2/samples.h"
#include "ros2/writer_names.h"

namespace drover::ros2 {
namespace {

constexpr std::int32_t kCommandsAtOnce = 50;

}  // namespace

JointCommandInput::JointCommandInput(dds_entity_t reader, const JointCommandLimits& limits,
                                     bool one_clock)
    : reader_(reader),
      limits_(limits),
      one_clock_(one_clock),
      pace_(limits.messages_Hz, kCommandsAtOnce) {}

/// DDS is asked once for each: they are the owners of joints.
const std::string& JointCommandInput::name_of(dds_instance_handle_t writer) {
  const auto known = std::find_if(names_.begin(), names_.end(),
                                  [writer](const Name& name) { return name.writer == writer; });
  if (known != names_.end()) return known->name;
  Name& name = names_.at(next_name_);
  next_name_ = (next_name_ + 1) % names_.size();
  name = {writer, writer_name(reader_, writer)};
  return name.name;
}

std::string JointCommandInput::line_of(const void* sample, const dds_sample_info_t& info, Time said,
                                       Duration wall) {
  json::JsonText line;
  line.open('{').key("cmd").text("joint_command");
  const auto refused = [&line](std::string_view why) {
    return line.key("refused").text(why).close('}').take();
  };
  const auto late = one_clock_ ? too_late(info, wall, limits_.oldest) : std::string();
  if (!late.empty()) return refused(late);
  const auto message = read_joint_command(
      *static_cast<const aimrt_msgs_msg_dds__JointCommandArray_*>(sample), limits_.joints);
  if (!message) return refused(message.error().view());
  line.key("writer").text(name_of(info.publication_handle));
  line.key("at_ns").integer(said.time_since_epoch().count());
  return line.key("message").text(*message).close('}').take();
}

bool JointCommandInput::take(Time now, Duration wall, Time came,
                             const std::function<void(const std::string&)>& send) {
  const auto look = [&](const void* sample, const dds_sample_info_t& info) {
    const Time said = one_clock_ ? said_at(info, now, wall) : came;
    if (pace_.take(now)) send(line_of(sample, info, said, wall));
  };
  return take_samples<kCommandsAtOnce>(reader_, look) >= 0;
}

}  // namespace drover::ros2
