// Whether what a joint's drive measures can be believed.
#include "engine/group/joint_trust.h"

#include <algorithm>
#include <cmath>

namespace drover::engine {
namespace {

// Of its largest effort:
constexpr double kPushes = 0.1;   ///< less may be friction, or its neighbours' motion
constexpr double kCarries = 0.8;  ///< so much against a weight, and no weight gets faster
constexpr double kChanged = 0.2;  ///< so much more or less turns what is there by some bits
constexpr double kProved_rad = 0.1;
constexpr double kBeside = 0.5;  ///< of its set point's speed
constexpr double kAgainst_rad = 0.03;
constexpr double kFlees_radps = 0.2;
constexpr double kSlower = 0.9;  ///< than it was: who brakes
constexpr double kFaster = 1.3;  ///< than when that began: nobody brakes it
// Of what went its way before: who leans on it, or swings it, goes against its law as well. Beyond
// these, against nearly all of its effort and ever faster, it flees.
constexpr double kFlight = 2;      ///< times its fastest speed
constexpr double kTellable = 0.5;  ///< of what its drive can tell: beyond that nothing gets faster
constexpr double kFast_radps = 1;  ///< a slow one is soon pushed so
constexpr double kEverFaster = 1.5;
constexpr int kTimes = 3;  ///< measured so
// What is told reaches a drive a cycle later, and what it does is told one later; each cycle more
// makes it faster.
constexpr double kStands_s = 0.018;
constexpr double kRunsOn_radps = 0.5;
// What was so fast a moment ago does not stand so still so soon, whatever it ran into:
constexpr double kTurned_radps = 0.3;
constexpr double kBrakes_s = 0.02;  ///< or what its acceleration makes in this, where that is more
constexpr double kStoodStill_s = 0.014;
constexpr double kSoon_s = 0.03;
constexpr double kLastStep = 1e-5;  ///< of a range: less than its drive can tell
constexpr double kApart_rad = 0.02;
/// Who told nothing for so long heard nothing either.
constexpr double kHeldUp_s = 0.03;
/// Nobody is found to stand by fewer measurements, however seldom they come.
constexpr double kLongest_s = 0.006;

}  // namespace

JointTrust::JointTrust(const JointRules& rules) : rules_(rules) {}

Reason JointTrust::look(const JointMeasured& measured, double since_s, const Impedance& told,
                        double velocity_radps) {
  if (!(since_s > 0)) return {};
  // Who leads a joint by hand that is only damped goes against its damping.
  const double wanted_Nm = told.effort_Nm + told.damping_Nmsprad * velocity_radps +
                           told.stiffness_Nmprad * (told.position_rad - measured.position_rad);
  const double gives_Nm = wanted_Nm - told.damping_Nmsprad * measured.velocity_radps;
  if (const Reason beyond = look_at_range(measured); !beyond.empty()) return beyond;
  const double heard_s = std::min(since_s, kHeldUp_s);
  follow(measured, velocity_radps, heard_s);
  Reason why = look_at_sign(measured, wanted_Nm, gives_Nm, heard_s);
  if (why.empty()) why = look_at_motion(measured, since_s);
  if (!why.empty()) return why;
  if (since_s <= kHeldUp_s) return look_at_encoder(measured, gives_Nm, since_s);
  forget_stand();  // what it was told meanwhile it never gave
  return {};
}

void JointTrust::look_away() {
  moved_radps_ = kAbsent;
  against_rad_ = 0;  // what it did meanwhile nobody saw
  forget_stand();
}

void JointTrust::forget_stand() {
  stands_rad_ = kAbsent;
  stands_s_ = still_s_ = 0;
}

/// A drive tells the end of its range of all that lies beyond it, too, and keeps its own law about
/// where the joint truly is. A limit that stands there itself says that nothing does.
Reason JointTrust::look_at_range(const JointMeasured& measured) const {
  const double low_rad = rules_.drive.min_rad;
  const double high_rad = rules_.drive.max_rad;
  const double step_rad = kLastStep * (high_rad - low_rad);
  Reason why;
  if (!std::isfinite(step_rad)) return why;
  const bool low =
      low_rad < rules_.min_rad - kApart_rad && measured.position_rad < low_rad + step_rad;
  const bool high =
      high_rad > rules_.max_rad + kApart_rad && measured.position_rad > high_rad - step_rad;
  if (low || high)
    why.format("its drive tells the end of its range, %.2f rad: where it is is not known",
               measured.position_rad);
  return why;
}

/// What goes with its set point is held to it by a drive that turns the right way.
void JointTrust::follow(const JointMeasured& measured, double velocity_radps, double since_s) {
  const double set_radps = std::abs(velocity_radps);
  const bool with = std::abs(measured.velocity_radps - velocity_radps) < kBeside * set_radps;
  if (with) with_rad_ += set_radps * since_s;
}

/// Is it so fast that it may flee? Of what never went with its set point nobody knows anything.
bool JointTrust::is_fast(double speed_radps) const {
  if (!is_proved()) return speed_radps > kFlees_radps;
  const double far_radps =
      std::min(kFlight * rules_.max_velocity_radps, kTellable * rules_.drive.velocity_radps);
  return speed_radps > std::max(far_radps, kFast_radps);
}

/// Does it go on against that, and gets no slower?
bool JointTrust::goes_against(double speed_radps, double wanted_Nm, double gives_Nm) const {
  const bool asks = !is_proved() && !rules_.carries_weight;
  const bool pushed = asks && wanted_Nm < -kPushes * rules_.max_effort_Nm;
  const bool held = gives_Nm < -kCarries * rules_.max_effort_Nm;
  return (pushed || held) && is_fast(speed_radps) && speed_radps >= kSlower * fastest_radps_;
}

/// Of a drive of the wrong sign each law is one that flees: the farther it is the harder and
/// faster. What is braked, or caught, goes against its torque as well, and gets slower.
Reason JointTrust::look_at_sign(const JointMeasured& measured, double wanted_Nm, double gives_Nm,
                                double since_s) {
  const double speed_radps = std::abs(measured.velocity_radps);
  const double way = std::copysign(1.0, measured.velocity_radps);
  if (!goes_against(speed_radps, way * wanted_Nm, way * gives_Nm)) {
    against_rad_ = fastest_radps_ = 0;
    return {};
  }
  if (against_rad_ == 0) {
    began_radps_ = speed_radps;
    faster_ = 0;
  }
  against_rad_ += speed_radps * since_s;
  if (speed_radps > fastest_radps_) ++faster_;
  fastest_radps_ = std::max(fastest_radps_, speed_radps);
  const bool flees = is_proved() ? faster_ >= kTimes && speed_radps > kEverFaster * began_radps_
                                 : speed_radps > kFaster * began_radps_;
  Reason why;
  if (against_rad_ > kAgainst_rad && flees)
    why.format(
        "it turns by %.1f rad/s against %.1f Nm: its drive turns the wrong way, or it is pushed",
        measured.velocity_radps, gives_Nm);
  return why;
}

/// What turned stands to the bit all at once: its law drives it on, and its damping holds it no
/// more, so that nobody waits until the torque has grown.
Reason JointTrust::look_at_motion(const JointMeasured& measured, double since_s) {
  const double least_radps = std::max(kTurned_radps, kBrakes_s * rules_.max_acceleration_radps2);
  moved_s_ += since_s;
  const bool fast = std::abs(measured.velocity_radps) > least_radps;
  // Told once it may be a frame that lies.
  if (fast && fast_) {
    moved_radps_ = measured.velocity_radps;
    moved_s_ = 0;
  }
  fast_ = fast;
  still_s_ = stands(measured) ? still_s_ + since_s : 0;
  Reason why;
  if (std::isfinite(moved_radps_) && moved_s_ < kSoon_s && still_s_ > kStoodStill_s)
    why.format(
        "it turned by %.1f rad/s, and stood to the bit at once: its encoder stands still, or it "
        "is blocked",
        moved_radps_);
  return why;
}

/// Equal to the bit is meant.
bool JointTrust::stands(const JointMeasured& measured) const {
  return measured.position_rad == stands_rad_ && measured.velocity_radps == 0;
}

/// What is there gives way by some bits when it is pressed harder, also at a stop or in a brake.
Reason JointTrust::look_at_encoder(const JointMeasured& measured, double gives_Nm, double since_s) {
  if (!stands(measured)) {
    stands_rad_ = measured.position_rad;
    least_Nm_ = most_Nm_ = gives_Nm;
    stands_s_ = 0;
    return {};
  }
  least_Nm_ = std::min(least_Nm_, gives_Nm);
  most_Nm_ = std::max(most_Nm_, gives_Nm);
  const double changed_Nm = most_Nm_ - least_Nm_;
  const bool changed = changed_Nm > kChanged * rules_.max_effort_Nm;
  stands_s_ += changed ? std::min(since_s, kLongest_s) : 0;
  Reason why;
  if (stands_s_ > kStands_s)
    why.format(
        "it stands to the bit while its torque changed by %.1f Nm: its encoder stands still, or "
        "it is blocked",
        changed_Nm);
  return why;
}

/// It went with its set point for long enough.
bool JointTrust::is_proved() const {
  return with_rad_ > kProved_rad;
}

bool JointTrust::runs_on(const JointMeasured& measured) const {
  const double speed_radps = std::abs(measured.velocity_radps);
  return fastest_radps_ > 0 && speed_radps > fastest_radps_ + kRunsOn_radps;
}

}  // namespace drover::engine
