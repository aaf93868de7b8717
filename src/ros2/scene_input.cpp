#include "ros2/scene_input.h"

#include <moveit_msgs.h>

#include <algorithm>

#include "ros2/read_scene.h"
#include "ros2/samples.h"
#include "ros2/scene_line.h"

namespace drover::ros2 {
namespace {

/// Few: out of DDS' 64 kB each may become ten times as much.
constexpr std::int32_t kScenesAtOnce = 10;

}  // namespace

std::string SceneInput::line_of(const void* sample, const dds_sample_info_t& info, Time now,
                                Duration wall) const {
  const Duration age = one_clock_ ? wall - Duration{info.source_timestamp} : Duration{};
  // A stamp before this computer's start, or none, is as old as can be told.
  const Time said = std::max(now - std::max(age, Duration{}), Time{Duration{1}});
  if (kind_ == Kind::objects) {
    const auto& object = *static_cast<const moveit_msgs_msg_dds__CollisionObject_*>(sample);
    return scene_line("collision_object", text_of(object.id_), read_collision_object(object), said);
  }
  const auto& constraints = *static_cast<const moveit_msgs_msg_dds__Constraints_*>(sample);
  return scene_line("planning_constraints", text_of(constraints.name_),
                    read_constraints(constraints), said);
}

SceneInput::Taken SceneInput::take(Time now, Duration wall,
                                   const std::function<void(std::string)>& give) {
  const auto look = [&](const void* sample, const dds_sample_info_t& info) {
    if (pace_.take(now))
      give(line_of(sample, info, now, wall));
    else
      ++passed_over_;
  };
  const auto taken = take_samples<kScenesAtOnce>(reader_, look);
  if (taken < 0) return Taken::failed;
  return taken == kScenesAtOnce ? Taken::some : Taken::all;
}

}  // namespace drover::ros2
