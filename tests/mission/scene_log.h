// A mission with a planning scene as its logs tell it: beside the record, what stood in the robot's
// way, what it touched, and what was answered.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "mission/judge.h"
#include "mission/record.h"

namespace drover::mission {

/// One answer on scene_feedback.
struct SceneAnswer {
  Time time = kNever;
  std::string topic;
  std::string id;  ///< of the object, or the name of the constraints
  bool done = false;
  std::string path;
  std::string reason;
};

struct SceneLog {
  const Record* record = nullptr;
  std::vector<ObjectLine> objects;
  std::vector<TruePose> poses;
  std::vector<SceneAnswer> answers;

  /// When the n-th line of this verb and name was written. Throws.
  Time at(const std::string& verb, const std::string& name, std::size_t n = 1) const;
  std::vector<ObjectLine> all(const std::string& verb) const;
  /// The pose nearest to `time`. Throws when there is none within 20 ms.
  const TruePose& pose_at(Time time) const;
  /// From the robot's outline at `time` to this thing. Throws when it was not there.
  double gap_at(Time time, const std::string& name) const;
  /// The first answer to this id from `begin` on. Throws.
  const SceneAnswer& answer(const std::string& id, Time begin = kNever) const;
};

/// When the wheels are told more than a ramp to zero with limits.deceleration_mps2 that begins at
/// `from` allows, up to `until`; nothing: they are told to stop by then.
std::optional<Time> first_above_ramp(const Record& record, Time from, Time until);

/// Of $DROVER_MISSION_LOGS/NAME; read once. Throws when there is none.
const SceneLog& scene_log(const std::string& name);
/// Of any record.
SceneLog read_scene_log(const Record& record);

}  // namespace drover::mission
