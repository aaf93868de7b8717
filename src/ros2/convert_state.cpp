#include <algorithm>

#include "ros2/convert.h"

namespace drover::ros2 {

diagnostic_msgs_msg_dds__DiagnosticArray_ diagnostics(Stamp_ns at_ns, std::string_view robot,
                                                      std::span<const DiagnosticTold> told,
                                                      Arena& arena) {
  diagnostic_msgs_msg_dds__DiagnosticArray_ message{};
  message.header_ = {time_of(at_ns), arena.text("")};
  auto* status = arena.fill(message.status_, told.size());
  for (const DiagnosticTold& one : told) {
    status->level_ = static_cast<std::uint8_t>(std::clamp(one.level, 0, 2));
    status->name_ = arena.text("drover: " + one.name);
    status->message_ = arena.text(one.message);
    status->hardware_id_ = arena.text(robot);
    auto* pair = arena.fill(status->values_, one.values.size());
    for (const auto& [key, value] : one.values) *pair++ = {arena.text(key), arena.text(value)};
    ++status;
  }
  return message;
}

aimrt_msgs_msg_dds__TouchSensorStateArray_ touch_state(const TouchTold& touch,
                                                       std::uint32_t sequence, Arena& arena) {
  aimrt_msgs_msg_dds__TouchSensorStateArray_ message{};
  message.header_ = {time_of(touch.at_ns), arena.text(kBaseFrame), sequence};
  auto* name = arena.fill(message.names_, touch.each.size());
  auto* state = arena.fill(message.states_, touch.each.size());
  for (const TouchTold::One& one : touch.each) {
    *name++ = arena.text(one.name);
    *arena.fill(state++->pressure_, 1) = one.touched ? 1 : 0;
  }
  return message;
}

tf2_msgs_msg_dds__TFMessage_ fixed_frames(Stamp_ns at_ns, std::span<const FixedFrame> frames,
                                          Arena& arena) {
  tf2_msgs_msg_dds__TFMessage_ message{};
  auto* one = arena.fill(message.transforms_, frames.size());
  for (const FixedFrame& frame : frames)
    *one++ = {{time_of(at_ns), arena.text(kBaseFrame)},
              arena.text(frame.name),
              {{frame.x_m, frame.y_m, frame.z_m},
               quaternion(frame.roll_rad, frame.pitch_rad, frame.yaw_rad)}};
  return message;
}

}  // namespace drover::ros2
