// A robot on four wheels with rollers, and a program that moves it with cmd_vel.
#pragma once

#include <algorithm>
#include <cmath>

#include "engine_fixture.h"

namespace drover::engine {

inline EngineConfig on_rollers() {
  EngineConfig config = rig_config();
  config.base.kind = BaseKind::mecanum;
  config.base.track_m = 0.44;
  config.base.wheelbase_m = 0.36;
  config.base.wheel_radius_m = 0.076;
  config.estimate.gnss_late_sigma_s = 0;  // calibrated: only a way ahead shows it
  return config;
}

class ARobotOnRollers : public ::testing::Test {
 protected:
  explicit ARobotOnRollers(const EngineConfig& config = on_rollers(), double y_m = 0)
      : rig(config, 0, y_m) {
    rig.imu = true;
  }
  void say_s(const Twist& twist, double seconds) {
    for (int i = 0; i < static_cast<int>(seconds * 20 + 0.5); ++i) {
      rig.command(FollowTwist{twist});
      rig.run_s(0.05);
      fastest_mps = std::max(fastest_mps, std::abs(rig.snapshot().pose.vy_mps));
    }
  }
  const Pose& pose() const { return rig.snapshot().pose; }

  EngineRig rig;
  double fastest_mps = 0;
};

}  // namespace drover::engine
