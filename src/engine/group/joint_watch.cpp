// What a joint truly does beside what it was told: whether its drive drives it beyond its limits.
#include "engine/group/joint_watch.h"

#include <algorithm>
#include <cmath>

namespace drover::engine {
namespace {

constexpr double kFar = 2;            // times its fastest speed
constexpr double kEnd = 0.999;        // of what its drive can tell: it may be any more
constexpr double kAhead_radps = 0.5;  // of its set point
constexpr double kMargin_rad = 0.05;
constexpr double kGoes_radps = 0.05;
constexpr double kDrives = 0.02;  // of its largest effort: less is noise
constexpr double kFor_s = 0.05;
/// What somebody drew aside and let go comes back so fast for a moment, and may.
constexpr double kDrawn_s = 0.25;

/// Is it true for longer than `at_most_s`?
bool lasts(bool is, double dt_s, double at_most_s, double& for_s) {
  for_s = is ? for_s + dt_s : 0;
  return for_s > at_most_s;
}

}  // namespace

Reason JointWatch::look(const JointMeasured& measured, const Impedance& told, double velocity_radps,
                        double dt_s) {
  const double way = std::copysign(1.0, measured.velocity_radps);
  const double speed_radps = std::abs(measured.velocity_radps);
  // Of what it is told, as the drive makes it of where the joint is.
  const double pushes_Nm =
      way * (told.effort_Nm + told.damping_Nmsprad * (velocity_radps - measured.velocity_radps));
  const double draws_Nm = way * told.stiffness_Nmprad * (told.position_rad - measured.position_rad);
  const double least_Nm = kDrives * rules_.max_effort_Nm;
  const double gives_Nm = pushes_Nm + draws_Nm;
  const double too_fast_radps =
      std::min(kFar * rules_.max_velocity_radps, kEnd * rules_.drive.velocity_radps);
  const bool fast = gives_Nm > least_Nm && speed_radps > too_fast_radps &&
                    speed_radps - way * velocity_radps > kAhead_radps;
  const double end_rad = way > 0 ? rules_.max_rad : rules_.min_rad;
  const bool beyond = gives_Nm > 0 && speed_radps > kGoes_radps &&
                      way * (measured.position_rad - end_rad) > kMargin_rad;
  const bool pushed = lasts(fast && pushes_Nm > least_Nm, dt_s, kFor_s, fast_s_);
  const bool drawn = lasts(fast, dt_s, kDrawn_s, drawn_s_);
  Reason why;
  if (lasts(beyond, dt_s, kFor_s, beyond_s_))
    why.format("it is driven on at %.2f rad, its limit is %.2f", measured.position_rad, end_rad);
  else if (pushed || drawn)
    why.format("it turns by %.1f rad/s, its limit is %.1f", measured.velocity_radps,
               rules_.max_velocity_radps);
  return why;
}

}  // namespace drover::engine
