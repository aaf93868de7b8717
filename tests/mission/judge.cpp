#include "mission/judge.h"

#include <algorithm>

namespace drover::mission {
namespace {

Near near(const TruePose& pose, const std::string& name, const Flat& thing) {
  return {pose.time, name, gap_m(outline(pose.x_m, pose.y_m, pose.yaw_rad), thing), pose.moves()};
}

}  // namespace

void Around::follow(Time time) {
  for (; next_ < objects_.size() && objects_[next_].time <= time; ++next_) {
    const ObjectLine& line = objects_[next_];
    if (line.verb == "put") present_[line.name] = line.solid;
    if (line.verb == "gone") present_.erase(line.name);
    if (line.verb == "at") {
      auto& solid = present_.at(line.name);
      solid.x_m = line.numbers.at(0);
      solid.y_m = line.numbers.at(1);
    }
  }
}

std::vector<Near> Around::gaps(const TruePose& pose) {
  follow(pose.time);
  std::vector<Near> found;
  for (const auto& [name, solid] : present_)
    if (const auto thing = flat(solid)) found.push_back(near(pose, name, *thing));
  for (const auto& fence : fences_)
    if (pose.time >= fence.begin && pose.time <= fence.end)
      found.push_back(near(pose, fence.name, fence.flat));
  std::sort(found.begin(), found.end(),
            [](const Near& a, const Near& b) { return a.gap_m < b.gap_m; });
  return found;
}

std::vector<Near> gaps_at(const TruePose& pose, const std::vector<ObjectLine>& objects,
                          const std::vector<Fence>& fences) {
  return Around(objects, fences).gaps(pose);
}

Verdict judge(const std::vector<TruePose>& poses, const std::vector<ObjectLine>& objects,
              const std::vector<Fence>& fences, Time begin, Time end) {
  Verdict verdict;
  Around around(objects, fences);
  for (const auto& pose : poses) {
    if (pose.time < begin || pose.time > end) continue;
    ++verdict.poses;
    const auto found = around.gaps(pose);
    verdict.things = std::max(verdict.things, found.size());
    if (found.empty()) continue;
    const Near& one = found.front();
    if (one.gap_m < verdict.nearest.gap_m) verdict.nearest = one;
    if (one.moving && one.gap_m < verdict.nearest_moving.gap_m) verdict.nearest_moving = one;
    if (!(one.gap_m < 0)) continue;
    if (!verdict.first) verdict.first = one;
    if (one.moving && !verdict.first_moving) verdict.first_moving = one;
  }
  return verdict;
}

}  // namespace drover::mission
