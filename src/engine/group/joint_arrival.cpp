// Whether a joint comes to its set point, or presses on against something for ever.
#include "engine/group/joint_arrival.h"

#include <cmath>

namespace drover::engine {
namespace {

/// Of its largest effort: what hangs on it, or pushes it, takes less.
constexpr double kPresses = 0.8;
constexpr double kComes_rad = 0.05;
// Of a way that its set point went:
constexpr double kWay_rad = 0.2;
constexpr double kStays = 0.1;
constexpr double kGoesWith = 0.5;
constexpr double kNoWay_rad = 0.05;  ///< less, and at rest: there is none

}  // namespace

void JointArrival::look(const JointMeasured& measured, const Impedance& told, double set_rad,
                        double velocity_radps, bool followed, double dt_s) {
  look_at_pressing(measured, told, set_rad, velocity_radps, dt_s);
  if (!followed) {
    asked_rad_ = went_rad_ = stays_s_ = 0;
    before_rad_ = kAbsent;
  } else {
    look_at_way(measured, velocity_radps, dt_s);
  }
  if (!presses() && stays_s_ <= kFor_s) why_.clear();
}

void JointArrival::look_at_pressing(const JointMeasured& measured, const Impedance& told,
                                    double set_rad, double velocity_radps, double dt_s) {
  const double by_speed_Nm = told.damping_Nmsprad * velocity_radps;
  const double draws_Nm = told.stiffness_Nmprad * (set_rad - measured.position_rad) + by_speed_Nm;
  const double gives_Nm = told.stiffness_Nmprad * (told.position_rad - measured.position_rad) +
                          by_speed_Nm + told.effort_Nm;
  const double way = std::copysign(1.0, draws_Nm);
  const double least_Nm = kPresses * rules_.max_effort_Nm;
  const bool hard = way * draws_Nm > least_Nm && way * gives_Nm > least_Nm;
  const bool comes = way * (measured.position_rad - from_rad_) > kComes_rad;
  if (!hard || comes || way != way_) {
    pressed_s_ = 0;
    way_ = way;
    from_rad_ = measured.position_rad;
    return;
  }
  const bool before = presses();
  pressed_s_ += dt_s;
  if (before || !presses()) return;
  // Short enough to stand behind what is said of a stop.
  why_.format("it presses with %.1f Nm and comes no nearer: blocked, pushed, or mirrored",
              way * gives_Nm);
}

/// A law that is too soft to press hard.
void JointArrival::look_at_way(const JointMeasured& measured, double velocity_radps, double dt_s) {
  if (std::isfinite(before_rad_)) went_rad_ += measured.position_rad - before_rad_;
  before_rad_ = measured.position_rad;
  asked_rad_ += velocity_radps * dt_s;
  const double asked_rad = std::abs(asked_rad_);
  const double went_rad = std::copysign(1.0, asked_rad_) * went_rad_;
  const bool rests = velocity_radps == 0 && asked_rad < kNoWay_rad;
  if (rests || went_rad > kGoesWith * asked_rad) {
    asked_rad_ = went_rad_ = stays_s_ = 0;
    return;
  }
  const bool stays = asked_rad > kWay_rad && went_rad < kStays * asked_rad;
  const bool before = stays_s_ > kFor_s;
  stays_s_ = stays ? stays_s_ + dt_s : 0;
  if (before || stays_s_ <= kFor_s || presses()) return;
  why_.format(
      "its set point went by %.2f rad, and it by %.2f rad: it is blocked, held, or carries more "
      "than it is given",
      asked_rad_, went_rad_);
}

}  // namespace drover::engine
