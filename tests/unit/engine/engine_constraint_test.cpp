// The whole engine where a constraint of the scene is broken.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "engine_wall.h"

namespace drover::engine {
namespace {

using testing::HasSubstr;

TEST_F(InFrontOfAWall, StandsWhileAConstraintIsBroken) {
  start();
  run_s(5);
  ASSERT_GT(speed_mps(), 0.7);
  broken = "the fence of field_north: 0.20 m outside";
  run_s(3);
  EXPECT_LT(speed_mps(), 0.005);
  EXPECT_EQ(rig.snapshot().nav.status, NavStatus::run);
  EXPECT_TRUE(rig.snapshot().nav.paused);
  EXPECT_FALSE(rig.snapshot().nav.obstacle);
  EXPECT_TRUE(told("field_north")) << rig.why();
  EXPECT_EQ(rig.snapshot().clearance.broken, broken);
  broken.clear();
  run_s(0.9);
  EXPECT_LT(speed_mps(), 0.005);
  run_s(10);
  EXPECT_EQ(rig.snapshot().nav.status, NavStatus::success) << rig.why();
}

TEST_F(InFrontOfAWall, EndsATaskWhoseConstraintIsBrokenForTooLong) {
  start();
  run_s(3);
  broken = "the fence of field_north: 0.20 m outside";
  run_s(rig.config.navigate.obstacle_timeout_s + 2);
  EXPECT_EQ(rig.snapshot().nav.status, NavStatus::error);
  ASSERT_EQ(rig.said<TaskEnded>().size(), 1U);
  EXPECT_THAT(std::string(rig.said<TaskEnded>()[0].reason.view()), HasSubstr("field_north"));
}

TEST_F(InFrontOfAWall, StartsNothingWhereAConstraintIsBroken) {
  broken = "the fence of field_north: 0.20 m outside";
  run_s(0.5);
  start();
  run_s(0.1);
  ASSERT_FALSE(rig.said<CommandRefused>().empty());
  EXPECT_THAT(std::string(rig.said<CommandRefused>().back().reason.view()),
              HasSubstr("field_north"));
  stream_s(0, 0.6);
  stream_s(2, 1);
  EXPECT_LT(std::abs(rig.plant.truth().x_m), 0.001);
  EXPECT_THAT(std::string(rig.snapshot().joint_command.reason.view()), HasSubstr("field_north"));
}

/// Who took it away is not told that it does not hold, but what he waits for.
TEST_F(InFrontOfAWall, SaysOfAConstraintThatWasTakenAwayThatAllHoldAgain) {
  broken = "the fence of field_north: 0.20 m outside";
  run_s(0.5);
  broken.clear();
  run_s(0.3);
  EXPECT_FALSE(told("field_north")) << rig.why();
  EXPECT_TRUE(told("all constraints hold again, but not yet for 1.0 s")) << rig.why();
  start();
  run_s(0.1);
  ASSERT_FALSE(rig.said<CommandRefused>().empty());
  EXPECT_THAT(std::string(rig.said<CommandRefused>().back().reason.view()),
              HasSubstr("all constraints hold again, but not yet for 1.0 s"));
  run_s(0.8);
  EXPECT_FALSE(told("constraints")) << rig.why();
  start();
  run_s(3);
  EXPECT_GT(speed_mps(), 0.2) << rig.why();
}

TEST_F(InFrontOfAWall, EndsJointCommandsWhereAConstraintBreaks) {
  stream_s(0, 0.6);
  stream_s(2, 2);
  ASSERT_GT(speed_mps(), 0.2);
  broken = "the fence of field_north: 0.20 m outside";
  stream_s(2, 1.5);
  EXPECT_LT(speed_mps(), 0.005);
}

}  // namespace
}  // namespace drover::engine
