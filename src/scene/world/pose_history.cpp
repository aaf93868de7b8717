#include "scene/world/pose_history.h"

#include <algorithm>
#include <cmath>

#include "scene/plane/steps.h"
#include "scene/world/words.h"

namespace drover::scene {
namespace {

std::string seconds(Duration d) {
  return words::number(to_s(d), 1) + " s";
}

}  // namespace

void PoseHistory::add(Time time, const Pose2& pose, double position_sigma_m, double yaw_sigma_rad) {
  const bool has_heading = std::isfinite(yaw_sigma_rad) && yaw_sigma_rad >= 0;
  if (!is_finite(place_of(pose)) || (has_heading && !std::isfinite(pose.yaw_rad))) return;
  if (size_ > 0 && time - newest().time < kSpacing) return;
  while (size_ > 0 && (size_ == kCapacity || time - known(0).time > kReach)) {
    first_ = (first_ + 1) % kCapacity;
    --size_;
  }
  ring_[(first_ + size_) % kCapacity] = {
      time, {pose, position_sigma_m, yaw_sigma_rad}, has_heading};
  ++size_;
}

std::string PoseHistory::problem_of(const Known& known) {
  if (!(known.at.position_sigma_m <= kMostSigma_m))
    return "the robot's place was known to " + words::number(known.at.position_sigma_m, 2) +
           " m only; allowed: " + words::number(kMostSigma_m, 2) + " m";
  if (!known.has_heading) return "it was not known which way the robot looked";
  return {};
}

Result<KnownPose, std::string> PoseHistory::at(Time when, Time arrived) const {
  if (when - arrived > kAhead)
    return "stamped " + seconds(when - arrived) + " ahead of the robot's clock";
  if (size_ == 0) return std::string("the robot's place is not known");
  if (when < known(0).time)
    return "stamped " + seconds(arrived - when) + " ago, the history reaches back " +
           seconds(arrived - known(0).time);
  if (when - newest().time > kAhead)
    return "the robot's place is not known since " + seconds(arrived - newest().time);
  if (when >= newest().time) {
    if (auto problem = problem_of(newest()); !problem.empty()) return problem;
    return newest().at;
  }
  std::size_t later = size_ - 1;
  while (known(later - 1).time > when) --later;
  const Known& a = known(later - 1);
  const Known& b = known(later);
  if (auto problem = problem_of(a); !problem.empty()) return problem;
  if (a.time == when) return a.at;
  if (auto problem = problem_of(b); !problem.empty()) return problem;
  if (b.time - a.time > kPause)
    return "the robot's place was not known when it was stamped, " + seconds(arrived - when) +
           " ago";
  return KnownPose{between(a.at.pose, b.at.pose, to_s(when - a.time) / to_s(b.time - a.time)),
                   std::max(a.at.position_sigma_m, b.at.position_sigma_m),
                   std::max(a.at.yaw_sigma_rad, b.at.yaw_sigma_rad)};
}

}  // namespace drover::scene
