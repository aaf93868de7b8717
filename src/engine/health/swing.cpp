// The little turn to each side on the first way: how it is asked for, and whether it happened.
#include "engine/health/swing.h"

#include <algorithm>
#include <cmath>

#include "drover/angle.h"
#include "engine/base/kinematics.h"

namespace drover::engine {
namespace {

// Shares of the whole way; left, right, left again, and straight at both ends.
constexpr double kStraightShare = 1.0 / 12;
constexpr double kSwingShare = 2.5 / 12;
const double kSwing_rad = to_rad(5.0);
constexpr double kSwingCurve = 0.8;  // of the tightest that a base that steers can drive
// A gyro is right to a tenth of a degree over a swing, a receiver with two antennas to one.
const double kSeen_rad = to_rad(3.0);
constexpr double kMostMore = 2.0;
constexpr double kLongest = 5.0;  // so many times the usual way, for each side
// Drives that follow small set points badly show a quarter of what they are asked for at first.
const double kMostAsked_rad = to_rad(24.0);
const double kMostAskedOnCurves_rad = to_rad(15.0);
// Wheels that skid show a third in the worst case, those of one axle nearly all. What wheels do
// that work against each other is slip.
const double kByWheels_rad = to_rad(10.0);
// Where only places show it: aside they show a tenth of the way and more.
const double kWide_rad = to_rad(12.0);
constexpr double kWideMore = 2.0;
constexpr double kWideStraight_m = 0.6;  // at most
constexpr double kLeastOfSkidding = 0.2;
constexpr double kLeastOfRolling = 0.4;

}  // namespace

double Swing::way_m(const BaseConfig& base, double first_m) {
  const BodyLimits body = limits(kinematics_of(base));
  if (body.pivots || !(first_m > 0)) return first_m;
  return std::max(first_m, kSwing_rad / (kSwingShare * kSwingCurve * body.most_radpm()));
}

Swing::Swing(const BaseConfig& config, double first_m) : first_m_(first_m) {
  const Kinematics base = kinematics_of(config);
  const bool pivots = limits(base).pivots;
  most_asked_rad_ = pivots ? kMostAsked_rad : kMostAskedOnCurves_rad;
  most_more_ = pivots ? kMostMore : 1.0;
  least_share_ = rolls_in_turns(base) ? kLeastOfRolling : kLeastOfSkidding;
}

void Swing::begin() {
  phase_ = Phase::before;
  from_ = {};
  beyond_m_ = 0;
  wide_ = aslant_ = known_ = left_ = right_ = failed_ = false;
  asked_rad_ = wheels_rad_ = 0;
  turned_rad_ = kAbsent;
}

double Swing::side() const {
  if (phase_ == Phase::left || phase_ == Phase::back) return 1;
  return phase_ == Phase::right ? -1 : 0;
}

/// Of this phase, where the robot turns as it is asked to.
double Swing::least_m() const {
  if (phase_ == Phase::before || phase_ == Phase::after) return kStraightShare * first_m_;
  return (phase_ == Phase::right ? 2 : 1) * kSwingShare * first_m_;
}

double Swing::radpm() const {
  if (wide_) return aslant_ ? 0 : side() * kWideMore * usual_radpm();
  const double more = 1 + std::max(beyond_m_, 0.0) / (kSwingShare * first_m_);
  return side() * std::min(more, most_more_) * usual_radpm();
}

double Swing::usual_radpm() const {
  return kSwing_rad / (kSwingShare * first_m_);
}

bool Swing::happened() const {
  return !known_ || (left_ && right_);
}

/// Of each side as much as the wheels say; whoever follows badly gets a longer way for it.
bool Swing::wide_ends(const SwingInput& input) const {
  const double gone_m = input.rolled_m - from_.rolled_m;
  switch (phase_) {
    case Phase::left: return input.shown || gone_m >= kLongest * least_m() + kWideStraight_m;
    case Phase::right:
      return from_.wheels_rad - input.wheels_rad >= 2 * kWide_rad || gone_m >= kLongest * least_m();
    case Phase::back: return input.wheels_rad >= 0 || gone_m >= kLongest * least_m();
    default: return gone_m >= least_m();
  }
}

bool Swing::ends(const SwingInput& input) const {
  if (wide_) return wide_ends(input);
  const double gone_m = input.rolled_m - from_.rolled_m;
  const bool known = std::isfinite(input.turned_rad);
  // Where it came from it goes on.
  if (phase_ == Phase::back && known && input.turned_rad >= 0) return true;
  if (!turns() || !known) return gone_m >= least_m();
  const bool seen = phase_ == Phase::left ? left_ : right_;
  return gone_m >= (seen ? 1 : kLongest) * least_m();
}

void Swing::judge(const SwingInput& input) {
  if (!turns() || !std::isfinite(input.turned_rad)) return;
  const double asked_rad = side() * (input.asked_rad - from_.asked_rad);
  const double wheels_rad = side() * (input.wheels_rad - from_.wheels_rad);
  const double turned_rad = side() * (input.turned_rad - from_.turned_rad);
  bool& seen = phase_ == Phase::left ? left_ : right_;
  seen = seen || turned_rad >= kSeen_rad;
  const bool slips = wheels_rad > kByWheels_rad && turned_rad < least_share_ * wheels_rad;
  const bool stays = asked_rad > most_asked_rad_ && !seen;
  if (!slips && !stays) return;
  failed_ = true;
  asked_rad_ = side() * asked_rad;
  wheels_rad_ = slips ? side() * wheels_rad : 0;
  turned_rad_ = side() * turned_rad;
}

void Swing::step(const SwingInput& input) {
  const bool known = std::isfinite(input.turned_rad);
  known_ = known_ || known;
  // Known only now, or from another one: what went before is nobody's.
  if (known && !std::isfinite(from_.turned_rad)) from_ = input;
  if (is_over() || failed_) return;
  judge(input);
  if (phase_ == Phase::before) wide_ = input.by_places && !known_;
  const double turned_rad = input.wheels_rad - from_.wheels_rad;
  const double gone_m = input.rolled_m - from_.rolled_m;
  aslant_ = wide_ && phase_ == Phase::left &&
            (aslant_ || turned_rad >= kWide_rad || gone_m >= kLongest * least_m());
  while (!is_over() && ends(input)) {
    phase_ = static_cast<Phase>(static_cast<int>(phase_) + 1);
    from_ = input;
    aslant_ = false;
  }
  beyond_m_ = input.rolled_m - from_.rolled_m - least_m();
}

}  // namespace drover::engine
