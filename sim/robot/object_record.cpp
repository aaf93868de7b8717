#include "sim/robot/object_record.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <initializer_list>
#include <utility>

#include "sim/robot/log.h"

namespace drover::sim {
namespace {

std::string numbers(std::initializer_list<double> values) {
  std::string text;
  for (const double value : values) {
    std::array<char, 40> digits{};
    const int n = std::snprintf(digits.data(), digits.size(), " %.6f", value);
    text.append(digits.data(), static_cast<std::size_t>(n));
  }
  return text;
}

std::string words_of(const Solid& solid) {
  std::string text(word(solid.kind));
  text += numbers({solid.x_m, solid.y_m, solid.z_m, solid.yaw_rad});
  switch (solid.kind) {
    case Solid::Kind::box: return text + numbers({solid.length_m, solid.width_m, solid.height_m});
    case Solid::Kind::cylinder:
    case Solid::Kind::cone: return text + numbers({solid.radius_m, solid.height_m});
    case Solid::Kind::sphere: return text + numbers({solid.radius_m});
    case Solid::Kind::prism: break;
  }
  text += numbers({solid.height_m});
  for (const auto& corner : solid.corners_m) text += numbers({corner[0], corner[1]});
  return text;
}

bool is_moved(Solid before, const Solid& after) {
  before.x_m = after.x_m;
  before.y_m = after.y_m;
  return before == after;
}

}  // namespace

std::string ObjectRecord::take() {
  return std::exchange(lines_, {});
}

void ObjectRecord::begin(Time now, const std::string& words) {
  append_stamp(lines_, now);
  lines_ += words;
  lines_ += '\n';
}

void ObjectRecord::note_objects(Time now, const Plant& plant) {
  if (plant.object_slots() == 0) return;
  if (!std::exchange(watching_, true))
    begin(now, "watching " + std::to_string(plant.object_slots()));
  auto placed = plant.objects();
  const auto named = [](const std::string& name) {
    return [&name](const Plant::PlacedObject& one) { return one.name == name; };
  };
  for (const auto& one : known_)
    if (std::none_of(placed.begin(), placed.end(), named(one.name))) begin(now, "gone " + one.name);
  for (const auto& one : placed) {
    const auto before = std::find_if(known_.begin(), known_.end(), named(one.name));
    if (before != known_.end() && before->solid == one.solid) continue;
    if (before != known_.end() && is_moved(before->solid, one.solid))
      begin(now, "at " + one.name + numbers({one.solid.x_m, one.solid.y_m}));
    else
      begin(now, "put " + one.name + " " + words_of(one.solid));
  }
  known_ = std::move(placed);
}

void ObjectRecord::note_touches(Time now, const Plant& plant) {
  if (plant.object_slots() == 0) return;
  if (plant.touches().empty() && touching_.empty()) return;
  const BasePose pose = plant.pose();
  const BaseVelocity v = plant.velocity();
  for (auto& one : touching_) one.still = false;
  for (const auto& touch : plant.touches()) {
    auto known = std::find_if(touching_.begin(), touching_.end(),
                              [&touch](const Touching& one) { return one.what == touch.what; });
    if (known == touching_.end()) {
      begin(now, "touch " + std::string(touch.what) +
                     numbers({pose.x_m, pose.y_m, pose.yaw_rad, v.vx_mps, v.vy_mps, v.wz_radps,
                              touch.depth_m}));
      touching_.push_back({std::string(touch.what)});
      known = touching_.end() - 1;
    }
    known->still = true;
    known->depth_m = std::max(known->depth_m, touch.depth_m);
    known->fastest_mps = std::max(known->fastest_mps, std::hypot(v.vx_mps, v.vy_mps));
    known->fastest_radps = std::max(known->fastest_radps, std::abs(v.wz_radps));
  }
  for (const auto& one : touching_)
    if (!one.still)
      begin(now, "leave " + one.what + numbers({one.depth_m, one.fastest_mps, one.fastest_radps}));
  std::erase_if(touching_, [](const Touching& one) { return !one.still; });
}

}  // namespace drover::sim
