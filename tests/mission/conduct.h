// What every mission must keep, whatever happens in it. Each check returns what is wrong, in words;
// nothing means that all is well.
#pragma once

#include <string>
#include <vector>

#include "mission/record.h"

namespace drover::mission {

using Problems = std::vector<std::string>;
/// The first ten of a kind: more say nothing new.
void add(Problems& problems, std::string text);

/// Every frame on the bus is a drive's, or on the list of what may be sent to a wheel.
Problems check_frames(const Record& record);
/// base_status: the document's keys and no others but bms.valid, nav.owner, nav.why,
/// nav.metres_left and nav.error_bound_m; the document's types; values that the document knows; not
/// retained. feedback: the same.
Problems check_form(const Record& record);
/// base_status: 10.0 Hz to 0.1 while gateway and broker run; back within 2 s of their start.
Problems check_rate(const Record& record);
/// /joint_state and /imu_state 50 times a second, /touch_state 10 times, to a hundredth, while
/// gateway and broker run; the second only while the inertial sensor is heard.
Problems check_aimrt_rates(const Record& record);
/// Whether the mission lets a robot roll that its drives then hold again.
enum class Holding { unmoved, caught };
/// Set points with motion only between an accepted start_task and the end of that task, or while a
/// stream of joint commands lives and in its ramp, or, where it is `caught`, while what rolls is
/// brought to rest; navigation is announced when a task's first goes out.
Problems check_motion(const Record& record, Holding holding = Holding::unmoved);
/// pose and rtk of one message are of one instant, and angle and yaw are one heading.
Problems check_pose(const Record& record);
/// While it moves, what the robot believes is within `bound_m` of the truth.
Problems check_truth(const Record& record, double bound_m);

/// Between `begin` and `end`.
struct Interval {
  Time begin = kNever;
  Time end = kNever;
};
/// When gateway and broker both ran, from the record of what was started and stopped; without what
/// a broker that goes on had held back.
std::vector<Interval> alive(const Record& record);

/// Messages that piled up while the broker stood still, and come as soon as it goes on: they tell
/// what was.
bool held_back(const Record& record, Time time);

/// How the true motion kept to the track from `begin` to `end`.
struct DriveFigures {
  double distance_m = 0;
  double rms_m = 0;  ///< beside the track, each sample weighed by the way since the last
  double max_m = 0;
  double goal_m = 0;  ///< from the target point, at the end of the record
};
DriveFigures drive_figures(const Record& record, Time begin, Time end);

/// How far what it believed was from the truth, while it moved from `begin` to `end`.
struct PoseFigures {
  double rms_m = 0;
  double max_m = 0;
  double rms_deg = 0;
  double max_deg = 0;
};
PoseFigures pose_figures(const Record& record, Time begin, Time end);

/// Seconds with six digits, for messages.
std::string seconds(Time time);
std::string seconds(Duration duration);

}  // namespace drover::mission
