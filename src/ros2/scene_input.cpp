#include "ros2/scene_input.h"

#include <moveit_msgs.h>

#include "ros2/read_scene.h"
#include "ros2/samples.h"
#include "ros2/scene_line.h"

namespace drover::ros2 {
namespace {

/// Of one look, on the wire: the longest message, or a hundred short ones. Out of it may become ten
/// times as much.
constexpr std::size_t kBytesAtOnce = 60'000;

/// What `write` makes of `message`; empty: it is no Message.
template <class Message, class Write>
std::string read_wire(const ddsi_serdata& message, const dds_topic_descriptor_t& type,
                      const Write& write) {
  Message sample{};
  const auto clear = [&type](Message* it) { dds_sample_free(it, &type, DDS_FREE_CONTENTS); };
  const std::unique_ptr<Message, decltype(clear)> content(&sample, clear);
  if (!ddsi_serdata_to_sample(&message, &sample, nullptr, nullptr)) return {};
  return write(sample);
}

}  // namespace

std::string SceneInput::line_of(const SceneQueue::Waiting& waiting, Time now, Duration wall) const {
  const Time said = one_clock_ ? said_at(waiting.said, now, wall) : now;
  if (kind_ == Kind::objects)
    return read_wire<moveit_msgs_msg_dds__CollisionObject_>(
        *waiting.message, moveit_msgs_msg_dds__CollisionObject__desc, [said](const auto& object) {
          return scene_line("collision_object", text_of(object.id_), read_collision_object(object),
                            said);
        });
  return read_wire<moveit_msgs_msg_dds__Constraints_>(
      *waiting.message, moveit_msgs_msg_dds__Constraints__desc, [said](const auto& constraints) {
        return scene_line("planning_constraints", text_of(constraints.name_),
                          read_constraints(constraints), said);
      });
}

SceneInput::Taken SceneInput::take(Time now, Duration wall,
                                   const std::function<void(std::string)>& give) {
  if (queue_.failed()) return Taken::failed;
  for (std::size_t bytes = 0; bytes < kBytesAtOnce;) {
    const auto waiting = queue_.pop();
    if (!waiting) return Taken::all;
    bytes += waiting->bytes;
    auto line = pace_.take(now) ? line_of(*waiting, now, wall) : std::string();
    if (line.empty())
      ++lost_;
    else
      give(std::move(line));
  }
  return Taken::some;
}

}  // namespace drover::ros2
