// Whether the robot touched anything: its outline at each true pose against what stood there then.
// All that is judged of gaps comes from here.
#pragma once

#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "drover/time.h"
#include "mission/flat.h"
#include "mission/object_line.h"

namespace drover::mission {

struct TruePose {
  Time time = kNever;
  double x_m = 0;
  double y_m = 0;
  double yaw_rad = 0;
  double vx_mps = 0;
  double wz_radps = 0;
  bool moves() const { return std::abs(vx_mps) > 0.01 || std::abs(wz_radps) > 0.01; }
};

/// What stands where it may not: a fence, say, that is no thing.
struct Fence {
  std::string name;
  Flat flat;
  Time begin = kNever;
  Time end = Time::max();
};

struct Near {
  Time time = kNever;
  std::string what;
  double gap_m = std::numeric_limits<double>::infinity();
  bool moving = false;
};

/// What stands around the robot, from one pose to the next.
class Around final {
 public:
  /// `objects` are borrowed.
  explicit Around(const std::vector<ObjectLine>& objects, std::vector<Fence> fences = {})
      : objects_(objects), fences_(std::move(fences)) {}

  /// From the robot to each thing that is at its heights then, nearest first. Poses come in the
  /// order of their times.
  std::vector<Near> gaps(const TruePose& pose);

 private:
  void follow(Time time);

  const std::vector<ObjectLine>& objects_;
  std::vector<Fence> fences_;
  std::size_t next_ = 0;
  std::map<std::string, TrueSolid> present_;
};

struct Verdict {
  std::size_t poses = 0;             ///< looked at
  std::size_t things = 0;            ///< that stood at the robot's heights
  Near nearest;                      ///< of all
  Near nearest_moving;               ///< of all while it moved
  std::optional<Near> first;         ///< overlap
  std::optional<Near> first_moving;  ///< overlap while it moved
};
/// Over all poses from `begin` to `end`, each against what was there then.
Verdict judge(const std::vector<TruePose>& poses, const std::vector<ObjectLine>& objects,
              const std::vector<Fence>& fences = {}, Time begin = kNever, Time end = Time::max());

/// How far from the robot each thing was at `time`, nearest first.
std::vector<Near> gaps_at(const TruePose& pose, const std::vector<ObjectLine>& objects,
                          const std::vector<Fence>& fences = {});

}  // namespace drover::mission
