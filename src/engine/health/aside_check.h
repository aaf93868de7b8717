// The first way aside of a base that goes sideways: it goes slowly until the receiver has seen it
// go the way that its wheels say. The same four wheels turn and drive a base as well whose front
// and rear wheels are listed the wrong way round: only a way aside shows that.
#pragma once

#include "drover/measurement.h"
#include "drover/path.h"
#include "drover/twist.h"
#include "engine/config.h"
#include "engine/health/mark_ring.h"

namespace drover::engine {

struct AsideInput {
  Time now = kNever;
  Duration dt{};
  Twist body;                ///< as its wheels tell it
  bool still = false;        ///< nobody moves it, and its wheels rest
  double yaw_rad = kAbsent;  ///< of the base, absent while unknown
};

/// Only the side is judged, not how far: rollers slip. What nobody can see (no RTK fix, no heading)
/// is not: after the first way it goes aside as asked. It is proved anew in each program.
class AsideCheck final {
 public:
  /// Bases that cannot go sideways, and those without a first way, have nothing to prove.
  explicit AsideCheck(const EngineConfig& config);

  void on_position(const GnssPosition& position, Time at);
  /// Another receiver speaks from now on, from there.
  void forget_receiver(const AntennaConfig& antenna);
  void step(const AsideInput& input);

  bool proved() const { return proved_; }
  /// What disagrees; empty when nothing does. Stays until the base rests.
  const Reason& fault() const { return fault_; }
  /// How fast it may go aside now; infinite once the first way is gone.
  double cap_mps() const;
  /// A program's twist in its direction, no faster aside than that.
  Twist slowed(const Twist& wanted) const;
  /// A task's: it goes on ahead, and less far aside.
  Twist bounded(const Twist& wanted) const;
  /// Of joints that make this motion no rim is faster.
  double rim_cap_mps(const Twist& stream) const;
  /// In words for an operator, while it holds back what is asked for so; empty otherwise.
  Reason slowly(const Twist& asked) const;

 private:
  /// Where the antenna is by the wheels but for what they went aside, and that: m east and north.
  struct Mark {
    Time at = kNever;
    PathPoint place;
    PathPoint aside;
    double ahead_m = 0;  ///< rolled, in either direction
  };

  void compare();
  void look_from(const PathPoint& place, const Mark& wheels);
  bool jumps(const PathPoint& place, const Mark& wheels, double sigma_m);
  void judge(const PathPoint& place, const Mark& wheels, double sigma_m);

  EstimateConfig estimate_;
  double first_m_;
  bool proved_;
  AntennaConfig antenna_;
  PathPoint way_;    ///< of the base, but for what it went aside
  PathPoint aside_;  ///< in all
  double yaw_rad_ = kAbsent;
  double ahead_m_ = 0;
  double rolled_m_ = 0;  ///< aside, in either direction, since it was at fault last
  Time still_since_ = kNever;
  MarkRing<Mark> marks_;
  GnssPosition position_;
  Time position_at_ = kNever;
  bool fresh_position_ = false;
  GnssPosition origin_;  ///< ways by the receiver count from there
  bool has_origin_ = false;
  int places_ = 0;      ///< that make the mean from which the way aside counts
  PathPoint from_;      ///< that mean: the receiver's place less that by the wheels
  PathPoint last_;      ///< likewise, the last one
  Mark began_;          ///< where the comparison began, by the wheels
  Mark compared_;       ///< where it was done last
  bool goes_ = false;   ///< aside, by the last one
  int odd_places_ = 0;  ///< in succession
  Reason fault_;
};

}  // namespace drover::engine
