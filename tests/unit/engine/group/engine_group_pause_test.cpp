// After a stop only a true pause begins anew: what was sent and not followed for a reason of the
// gateway's own is none.
#include <gmock/gmock.h>

#include <functional>

#include "unit/engine/group/engine_group_fixture.h"

namespace drover::engine {
namespace {

class EngineGroupPause : public EngineGroup {
 protected:
  /// What is sent at 100 Hz is refused.
  void refuse_s(double seconds) {
    for (int i = 0; i < static_cast<int>(seconds * 200 + 0.5); ++i) {
      if (i % 2 == 0) rig.command(JointTargetsRefused{"the broker is late"}, source);
      tick();
    }
  }
  /// A stream that names this joint alone.
  void send_one_s(std::size_t joint, double seconds, double position_rad) {
    for (int i = 0; i < static_cast<int>(seconds * 200 + 0.5); ++i) {
      JointTargets targets;
      (void)targets.joints.push_back(
          {static_cast<AxisId>(first + joint), 0, position_rad, 0, 60, 3});
      if (i % 2 == 0) rig.command(targets, source);
      tick();
    }
  }
  void estop(bool pressed) { rig.lines[static_cast<std::size_t>(Line::estop)] = pressed; }
  /// It goes on as before, and nothing moves; after a pause it is followed.
  void expect_waits(const char* why) {
    const double was = arm[0].position_rad;
    send_s(3, 1.2);
    EXPECT_EQ(told().state, GroupState::holding) << why;
    EXPECT_NEAR(arm[0].position_rad, was, 0.02) << why;
    EXPECT_NE(reason(), "") << why;
    run_s(1.1);
    EXPECT_EQ(reason(), "") << why;
    send_s(3, 1.2);
    EXPECT_EQ(told().state, GroupState::following) << why << ": " << reason();
    EXPECT_NEAR(arm[0].position_rad, 1.2, 0.05) << why;
  }
};

/// Its messages wait at the broker, and come when it goes on: too late.
TEST_F(EngineGroupPause, IsNoneWhileABrokerHangs) {
  settle();
  send_s(3, 0.4);
  run_s(0.3);
  estop(true);
  run_s(0.3);
  estop(false);
  run_s(1.4);
  refuse_s(1);
  send_s(0.1, 0.4);
  EXPECT_EQ(reason(), "pause your commands for a second, then send again: it was stopped");
  expect_waits("e-stop");
}

TEST_F(EngineGroupPause, IsNoneWhileAllIsRefused) {
  struct Stop {
    const char* name;
    std::function<void()> begins;
    std::function<void()> ends;
  };
  const Stop stops[] = {
      {"cancelled", [&] { rig.command(CancelTask{}); }, [] {}},
      {"stopped", [&] { rig.command(EngageStop{}); }, [&] { rig.command(ResetStop{}); }},
      {"e-stop", [&] { estop(true); }, [&] { estop(false); }},
      {"bumper", [&] { rig.lines[static_cast<std::size_t>(Line::bumper)] = true; },
       [&] { rig.lines[static_cast<std::size_t>(Line::bumper)] = false; }},
      {"guard", [&] { rig.guard_has_bus = true; }, [&] { rig.guard_has_bus = false; }},
      {"silent", [&] { silent[1] = true; }, [&] { silent[1] = false; }},
  };
  settle();
  for (const Stop& stop : stops) {
    send_s(3, 0.4);
    ASSERT_EQ(told().state, GroupState::following) << stop.name << ": " << reason();
    stop.begins();
    refuse_s(1);
    stop.ends();
    refuse_s(2);
    expect_waits(stop.name);
    run_s(1.1);
  }
}

/// Who was refused from his first message on was there already.
TEST_F(EngineGroupPause, IsAskedOfWhoWasOnlyRefusedToo) {
  settle();
  send_s(3, 0.4);
  run_s(2);
  refuse_s(0.3);
  estop(true);
  refuse_s(0.3);
  estop(false);
  refuse_s(0.3);
  expect_waits("e-stop");
}

/// It counts as sent to this joint, though it is malformed.
TEST_F(EngineGroupPause, IsNoneWhileNoNumberIsSound) {
  settle();
  send_s(3, 0.4);
  rig.command(CancelTask{});
  for (int i = 0; i < 200; ++i) {
    send(std::nan(""));
    run_s(0.01);
  }
  expect_waits("cancelled");
}

/// A program that names its joints in turn names each after seconds in which it named others.
TEST_F(EngineGroupPause, IsNoneWhileOthersOfTheGroupAreNamed) {
  settle();
  send_s(3, 0.4);
  send_one_s(0, 1.5, 0.4);
  estop(true);
  send_one_s(0, 0.3, 0.4);
  estop(false);
  const std::array was{arm[0].position_rad, arm[1].position_rad};
  for (int i = 0; i < 3; ++i) {
    send_one_s(1, 1.5, 1.2);
    send_one_s(0, 1.5, 1.2);
  }
  EXPECT_EQ(told().state, GroupState::holding);
  EXPECT_EQ(reason(), "pause your commands for a second, then send again: it was stopped");
  for (std::size_t i = 0; i < arm.size(); ++i) EXPECT_NEAR(arm[i].position_rad, was[i], 0.02) << i;
  expect_waits("in turn");
}

/// Nor is it one that a joint was not named yet when all were stopped.
TEST_F(EngineGroupPause, IsAskedForJointsThatAreNamedOnlyLater) {
  settle();
  send_one_s(0, 2, 0.4);
  estop(true);
  send_one_s(0, 0.3, 0.4);
  estop(false);
  send_one_s(0, 0.5, 0.4);
  const double was = arm[1].position_rad;
  send_one_s(1, 3, 1.2);
  EXPECT_NE(told().state, GroupState::following) << reason();
  EXPECT_NEAR(arm[1].position_rad, was, 0.02);
}

/// Nobody was stopped: a hiccup of the broker costs what it lasts.
TEST_F(EngineGroupPause, IsNotAskedOfWhomNothingStopped) {
  settle();
  send_s(3, 0.4);
  run_s(2);
  refuse_s(1);
  send_s(3, 1.2);
  EXPECT_EQ(told().state, GroupState::following);
  EXPECT_NEAR(arm[0].position_rad, 1.2, 0.05);
}

}  // namespace
}  // namespace drover::engine
