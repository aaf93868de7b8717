// What the driven wheels tell and are told, as one motion of the base.
#pragma once

#include <span>

#include "drover/snapshot.h"
#include "engine/base/kinematics.h"
#include "engine/config.h"

namespace drover::engine {

/// Of a base that takes a twist its edges stand for its wheels.
struct RimMotion {
  double fastest_mps = 0;  ///< of those that are heard, with its sign
  double ahead = 0;        ///< sign of the way of the base; 0: it turns on the spot
  double turn = 0;         ///< of its turn, left positive; 0: it goes more than it turns
  bool heard = false;      ///< at least one is
  bool silent = false;     ///< at least one is not
  bool driven = false;     ///< at least one is heard in closed loop
};

class RimReader final {
 public:
  explicit RimReader(const EngineConfig& config);

  RimMotion told(std::span<const AxisSnapshot> axes, Time now) const;
  /// The commands of the last cycle.
  RimMotion asked(std::span<const AxisSnapshot> axes, Time now) const;
  const Kinematics& base() const { return base_; }

 private:
  BodyMotion motion_of(const Told& told, Time now) const;
  void set_direction(RimMotion& rims, const Told& told, Time now) const;

  Duration stale_;
  Kinematics base_;
  JointSet driven_;
};

}  // namespace drover::engine
