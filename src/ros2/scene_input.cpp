#include "ros2/scene_input.h"

#include <moveit_msgs.h>

#include <algorithm>
#include <array>

#include "ros2/read_scene.h"
#include "ros2/scene_line.h"

namespace drover::ros2 {
namespace {

/// Few: out of DDS' 64 kB each may become ten times as much.
constexpr std::int32_t kScenesAtOnce = 10;

std::string_view name_in(const char* name) {
  return name == nullptr ? std::string_view() : name;
}

}  // namespace

std::string SceneInput::line_of(const void* sample, const dds_sample_info_t& info, Time now,
                                Duration wall) const {
  const Duration age = one_clock_ ? wall - Duration{info.source_timestamp} : Duration{};
  // A stamp before this computer's start, or none, is as old as can be told.
  const Time said = std::max(now - std::max(age, Duration{}), Time{Duration{1}});
  if (kind_ == Kind::objects) {
    const auto& object = *static_cast<const moveit_msgs_msg_dds__CollisionObject_*>(sample);
    return scene_line("collision_object", name_in(object.id_), read_collision_object(object), said);
  }
  const auto& constraints = *static_cast<const moveit_msgs_msg_dds__Constraints_*>(sample);
  return scene_line("planning_constraints", name_in(constraints.name_),
                    read_constraints(constraints), said);
}

SceneInput::Taken SceneInput::take(Time now, Duration wall,
                                   const std::function<void(std::string)>& give) {
  std::array<void*, kScenesAtOnce> samples{};
  std::array<dds_sample_info_t, kScenesAtOnce> infos{};
  const auto taken = dds_take(reader_, samples.data(), infos.data(), kScenesAtOnce, kScenesAtOnce);
  for (std::int32_t i = 0; i < taken; ++i) {
    if (!infos[i].valid_data) continue;
    if (pace_.take(now))
      give(line_of(samples[i], infos[i], now, wall));
    else
      ++passed_over_;
  }
  if (taken < 0) return Taken::failed;
  if (taken > 0) dds_return_loan(reader_, samples.data(), taken);
  return taken == kScenesAtOnce ? Taken::some : Taken::all;
}

}  // namespace drover::ros2
