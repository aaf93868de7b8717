// A base on one axle: what its wheels say of a turn is worth more than a skidding base's.
#include <gtest/gtest.h>

#include <cmath>

#include "rig.h"

namespace drover::engine::estimate {
namespace {

/// Half a turn by its wheels alone, just after the start. Nothing was learned before.
Rig after_half_a_turn(BaseKind kind) {
  EngineConfig config = rig_config();
  config.base.kind = kind;
  Rig rig(41, config);
  rig.world.disturbance = 0.2;
  rig.stand(5);
  rig.world.position = rig.world.heading = false;
  rig.circle(0.5, 2, 4 * kPi);
  return rig;
}

TEST(EstimateOfADifferentialBase, TrustsItsFirstTurn) {
  const Rig skids = after_half_a_turn(BaseKind::skid_steer);
  const Rig rolls = after_half_a_turn(BaseKind::differential);
  EXPECT_FALSE(skids.last.has_heading);  // it may have turned anywhere
  ASSERT_TRUE(rolls.last.has_heading);
  EXPECT_LT(to_deg(rolls.last.yaw_error_rad), 15);
  EXPECT_LE(rolls.yaw_error_rad(), rolls.last.yaw_error_rad);
  EXPECT_LE(rolls.position_error_m(), rolls.last.predicted_error_m);
}

TEST(EstimateOfADifferentialBase, SaysThatItGetsFartherWithoutAReceiver) {
  const auto metres_left = [](BaseKind kind) {
    EngineConfig config = rig_config();
    config.base.kind = kind;
    Rig rig(42, config);
    rig.stand(5);
    rig.circle(0.5, 3, 10);
    rig.world.position = rig.world.heading = false;
    rig.circle(0.5, 3, 1);
    return rig.last.metres_left;
  };
  EXPECT_GT(metres_left(BaseKind::differential), 1.2 * metres_left(BaseKind::skid_steer));
}

}  // namespace
}  // namespace drover::engine::estimate
