// The engine with its rig, and what tests of it say again and again.
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "engine_rig.h"

namespace drover::engine {

class AnEngine : public ::testing::Test {
 protected:
  /// Settled, then under way on a straight track at 0.5 m/s.
  void drive() {
    rig.settle();
    rig.start(path, 40, 0.5);
    rig.run_s(4);
    ASSERT_EQ(rig.snapshot().nav.status, NavStatus::run) << rig.why();
    ASSERT_GT(rig.fastest_command_radps(), 1);
    ASSERT_EQ(rig.said<NavigationStarted>().size(), 1U);
  }
  /// From the next cycle on there is no motion, and none comes back when the cause goes.
  void expect_stopped_at_once(const std::string& reason) {
    rig.tick();
    expect_stopped_now(reason);
  }
  void expect_stopped_now(const std::string& reason) {
    EXPECT_EQ(rig.fastest_command_radps(), 0);
    EXPECT_FALSE(rig.out.motion_permitted);
    EXPECT_EQ(rig.snapshot().nav.status, NavStatus::error);
    EXPECT_THAT(rig.why(), ::testing::HasSubstr(reason));
    ASSERT_EQ(rig.said<TaskEnded>().size(), 1U);
    EXPECT_EQ(rig.said<TaskEnded>()[0].how, TaskEnded::How::failed);
    EXPECT_THAT(std::string(rig.said<TaskEnded>()[0].reason.view()), ::testing::HasSubstr(reason));
    EXPECT_EQ(rig.said<PathReleased>().size(), 1U);
    EXPECT_TRUE(rig.snapshot().stop_latched);
  }
  void expect_no_motion_for_s(double seconds) {
    for (int i = 0; i < static_cast<int>(seconds * 200); ++i) {
      rig.tick();
      ASSERT_EQ(rig.fastest_command_radps(), 0);
    }
  }
  std::string refusal() {
    const auto refused = rig.said<CommandRefused>();
    return refused.empty() ? "" : std::string(refused.back().reason.view());
  }

  Path path = straight_path(20);
  EngineRig rig;
};

}  // namespace drover::engine
