// The first gate: the only way a wanted motion becomes a commanded one.
#pragma once

#include <cstdint>
#include <span>

#include "drover/snapshot.h"
#include "drover/twist.h"
#include "engine/base/kinematics.h"
#include "engine/config.h"

namespace drover::engine {

/// How motion ends, if it has to.
enum class Stop : std::uint8_t {
  none,
  controlled,  ///< ramps down with the configured deceleration, along the curve being driven
  immediate,   ///< zero at once
};

/// What one owner wants of the base.
struct Offer {
  Owner owner = Owner::nobody;
  Twist target;
  Time issued = kNever;
};

enum class TargetRefusal : std::uint8_t {
  none,
  nobody,      ///< nobody wants anything: at rest
  stop,        ///< a stop is in force
  stale,       ///< the wish of the owner in force is too old
  not_finite,  ///< not a number
};

/// Limits of speed, acceleration and jerk between wishes and wheels. What is refused becomes a ramp
/// to zero. Ahead and aside have one speed and one acceleration, which are bounded together. Fails
/// closed: without a fresh, finite wish of somebody the base comes to rest.
class TargetGate final {
 public:
  /// A wish older than `max_age` is not followed. Of a base that steers a twist is a speed and a
  /// curve: on no tighter one than it can, which comes no faster than its wheels are turned, and
  /// slowly until it is there; at rest, and on a ramp to rest, the curve stays.
  TargetGate(const LimitsConfig& limits, Duration max_age, const BodyLimits& body = {});

  /// The twist to command now. Of several offers the highest rank counts, and only that one: a
  /// stale or senseless wish of the owner in force does not hand the base to the next.
  const Twist& step(Time now, Duration dt, std::span<const Offer> offers, Stop stop);
  /// Forgets all motion: on arming and after an immediate stop.
  void reset();
  /// Goes on no faster than the base does, in each part: it may have stopped by itself meanwhile.
  void slow_to(const Twist& measured);
  /// Where the wheels of a base that steers are found at rest, as the curve that they make.
  void find_wheels(double curvature_radpm);

  bool at_rest() const { return is_zero(twist_); }
  const Twist& twist() const { return twist_; }
  TargetRefusal refusal() const { return refusal_; }
  std::uint64_t not_finite() const { return not_finite_; }

 private:
  Twist choose(Time now, std::span<const Offer> offers);
  Twist on_curve(const Twist& wanted);
  void follow(const Twist& target, double dt_s);
  void follow_way(double& mps, double& mps2, double target_mps, double share, double dt_s) const;
  void ramp_down(double dt_s);

  LimitsConfig limits_;
  Duration max_age_;
  BodyLimits body_;
  double wanted_radpm_ = 0;  ///< curvature, of a base that steers
  double radpm_ = 0;         ///< likewise, as commanded
  Twist twist_;
  double acceleration_mps2_ = 0;
  double aside_mps2_ = 0;  ///< likewise, to the left
  TargetRefusal refusal_ = TargetRefusal::nobody;
  std::uint64_t not_finite_ = 0;
};

/// For people; empty for `none`.
std::string_view text(TargetRefusal refusal);

}  // namespace drover::engine
