#include "engine/estimate/imu_intake.h"

#include <algorithm>
#include <cmath>

namespace drover::engine::estimate {
namespace {

constexpr double kFastest_radps = 50.0;  // sensors end at 35
constexpr double kHardest_mps2 = 400.0;  // sensors end at 157 or 314
constexpr double kUnitTolerance = 0.05;  // of a quaternion's length
constexpr double kRocks_radps = 0.35;
constexpr Duration kGap = std::chrono::milliseconds(100);
constexpr Duration kRestart = std::chrono::seconds(1);

bool inside(const Vector3& v, double limit) {
  return std::abs(v.x) <= limit && std::abs(v.y) <= limit && std::abs(v.z) <= limit;
}

bool plausible(const ImuSample& sample) {
  const Quaternion& q = sample.orientation;
  const double length = std::sqrt(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z);
  return inside(sample.angular_velocity_radps, kFastest_radps) &&
         inside(sample.acceleration_mps2, kHardest_mps2) &&
         (!sample.has_orientation || std::abs(length - 1) <= kUnitTolerance);
}

}  // namespace

TurnRate ImuIntake::turn(double radps) const {
  TurnRate turn;
  turn.radps = radps;
  turn.rest_bias_radps = bias_.bias_radps().z;
  turn.rest_bias_sigma = bias_.sigma_radps();
  turn.roll_rad = tilt_.roll_rad();
  turn.pitch_rad = tilt_.pitch_rad();
  turn.left_mps2 = left_mps2_;
  turn.rocks = rocks_;
  turn.saturated = saturated_;
  return turn;
}

ImuIntake::Verdict ImuIntake::take(const ImuSample& sample, Time at, bool standing,
                                   double speed_mps) {
  finished_.reset();
  if (!plausible(sample)) return Verdict::absurd;
  if (last_ != kNever && at <= last_) return Verdict::repeated;
  const bool gap = last_ == kNever || at - last_ > kGap;
  if (last_ != kNever && at - last_ > kRestart) tilt_.forget();
  const Vector3 bias = bias_.known() ? bias_.bias_radps() : Vector3{};
  if (!sample.saturated) {
    tilt_.update(sample, at, standing, speed_mps, bias);
    bias_.update(sample.angular_velocity_radps, at, standing);
  }
  const Vector3& rate = sample.angular_velocity_radps;
  const double gravity_left_mps2 =
      kGravity_mps2 * std::cos(tilt_.pitch_rad()) * std::sin(tilt_.roll_rad());
  left_mps2_ = sample.acceleration_mps2.y - gravity_left_mps2;
  rocks_ = std::hypot(rate.x - bias.x, rate.y - bias.y) > kRocks_radps;
  turn_radps_ = rate.z - bias.z;
  const double radps =
      tilt_.vertical_radps({.x = rate.x - bias.x, .y = rate.y - bias.y, .z = rate.z});
  const Time slot = at - at.time_since_epoch() % slot_;
  if (gap) {  // of the time before nothing is known
    from_ = slot;
    turned_rad_ = radps * to_s(at - slot);
    saturated_ = sample.saturated;
    finished_ = TurnSlot{slot, turn(radps)};
  } else {
    // What belongs to the slot that has begun is carried over into the next sum.
    const double over_rad = slot > from_ ? radps * to_s(at - std::max(slot, last_)) : 0.0;
    turned_rad_ += radps * to_s(at - last_) - over_rad;
    saturated_ = saturated_ || sample.saturated;
    if (slot > from_) {
      finished_ = TurnSlot{from_, turn(turned_rad_ / to_s(slot - from_))};
      from_ = slot;
      turned_rad_ = over_rad;
      saturated_ = sample.saturated;
    }
  }
  last_ = at;
  return Verdict::taken;
}

}  // namespace drover::engine::estimate
