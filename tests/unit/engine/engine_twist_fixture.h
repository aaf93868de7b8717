// The engine with a base that takes a twist and tells one, on level ground and on a slope.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "engine_rig.h"

namespace drover::engine {

inline EngineConfig twist_config() {
  EngineConfig config = rig_config();
  config.joints.clear();
  config.base.kind = BaseKind::twist;
  config.base.left.clear();
  config.base.right.clear();
  return config;
}

class ABaseThatTakesATwist : public ::testing::Test {
 protected:
  explicit ABaseThatTakesATwist(const EngineConfig& config = twist_config()) : rig(config) {}
  void drive() {
    rig.settle();
    rig.start(path, path_end, 0.5);
    rig.run_s(4);
    ASSERT_EQ(rig.snapshot().nav.status, NavStatus::run) << rig.why();
    ASSERT_GT(rig.out.base.twist.vx_mps, 0.4);
    ASSERT_TRUE(rig.out.motion_permitted);
  }
  bool has_power() const { return rig.out.outputs[static_cast<std::size_t>(Output::enable_relay)]; }
  bool at_rest() const {
    return rig.out.base.twist.vx_mps == 0 && rig.out.base.twist.wz_radps == 0;
  }

  std::string told() const {
    std::string all;
    for (const Reason& why : rig.snapshot().why) all += std::string(why.view()) + "; ";
    return all;
  }

  Path path = straight_path(6);
  std::uint32_t path_end = 12;
  EngineRig rig;
};

/// Nothing but its device holds it.
class ABaseThatTakesATwistOnASlope : public ABaseThatTakesATwist {
 protected:
  ABaseThatTakesATwistOnASlope() : ABaseThatTakesATwist(held_by_its_device()) { rig.imu = true; }
  void tilt() { rises_by(8); }
  void tilt_down() { rises_by(-8); }
  /// The same, and the gyro tells it: at once it is known how steep it is.
  void go_over_the_edge() {
    tilt_down();
    rig.pitch_radps = to_rad(80);
    rig.run_s(0.1);
    rig.pitch_radps = 0;
  }
  void rises_by(double ahead_deg) {
    const double rad = to_rad(ahead_deg);
    rig.gravity_mps2 = {9.81 * std::sin(rad), 0, 9.81 * std::cos(rad)};
  }

 private:
  static EngineConfig held_by_its_device() {
    EngineConfig config = twist_config();
    config.base.hold = HoldBy::level_ground_only;
    return config;
  }
};

}  // namespace drover::engine
