// What the battery does to tasks.
#include "engine_fixture.h"

namespace drover::engine {
namespace {

class AnEngineWithABattery : public AnEngine {
 protected:
  AnEngineWithABattery() {
    EngineConfig config = rig_config();
    config.battery_configured = true;
    config.health.battery_stale_s = 120;
    rig = EngineRig(config);
    rig.environment.battery[0].state = SourceState::fresh;
    sample.soc_percent = 70;
    tell();
  }
  void tell() {
    Measurement m;
    m.time = m.received = rig.now;
    m.value = sample;
    rig.engine->on_measurement(m);
  }
  BatterySample sample;
};

TEST_F(AnEngineWithABattery, RefusesAStartWhileTheChargerIsConnected) {
  sample.charger_connected = true;
  tell();
  rig.settle();
  rig.start(path, 40, 0.5);
  rig.tick();
  EXPECT_EQ(refusal(), "charging: unplug the charger first");
  expect_no_motion_for_s(1);
}

TEST_F(AnEngineWithABattery, RefusesAStartAsSoonAsItChargesAtRestAndNotAfterItBraked) {
  rig.settle();
  sample.charges = true;
  tell();
  rig.tick();
  rig.start(path, 40, 0.5);
  rig.tick();
  EXPECT_EQ(refusal(), "charging: unplug the charger first");
  expect_no_motion_for_s(1);
  sample.charges = false;
  tell();
  rig.tick();
  rig.start(path, 40, 0.5);
  rig.run_s(3);
  ASSERT_GT(rig.fastest_command_radps(), 0) << rig.why();
  sample.charges = true;
  tell();
  rig.run_s(1);
  EXPECT_EQ(rig.snapshot().nav.status, NavStatus::run) << "a brake charges, too";
  rig.command(CancelTask{});
  rig.run_s(1.5);
  rig.start(path, 40, 0.5);
  rig.run_s(2);
  EXPECT_GT(rig.fastest_command_radps(), 0) << rig.why();
}

TEST_F(AnEngineWithABattery, RefusesEveryMotionWhenItFellSilentAtTheCharger) {
  sample.charger_connected = true;
  tell();
  rig.settle();
  rig.environment.battery[0].state = SourceState::stale;
  rig.run_s(121);
  const std::string plugged = "the charger was connected when the battery was last heard";
  rig.start(path, 40, 0.5);
  rig.tick();
  EXPECT_EQ(refusal(), plugged);
  rig.command(FindHeading{});
  rig.tick();
  EXPECT_EQ(refusal(), plugged);
  JointTargets still;
  (void)still.joints.push_back({0, 0});
  rig.command(still);
  rig.tick();
  EXPECT_FALSE(rig.snapshot().joint_command.active);
  expect_no_motion_for_s(1);
  sample.charger_connected = false;
  tell();
  rig.environment.battery[0].state = SourceState::fresh;
  rig.tick();
  rig.start(path, 40, 0.5);
  rig.run_s(2);
  EXPECT_GT(rig.fastest_command_radps(), 0) << rig.why();
}

TEST_F(AnEngineWithABattery, FailsATaskWithARampWhenTheChargerIsPluggedIn) {
  drive();
  sample.charger_connected = true;
  tell();
  rig.tick();
  EXPECT_GT(rig.fastest_command_radps(), 0) << "a ramp, no jolt";
  ASSERT_EQ(rig.said<TaskEnded>().size(), 1U);
  EXPECT_EQ(rig.said<TaskEnded>()[0].how, TaskEnded::How::failed);
  EXPECT_EQ(rig.said<TaskEnded>()[0].reason, "charging: unplug the charger first");
  rig.run_s(2);
  EXPECT_EQ(rig.fastest_command_radps(), 0);
  sample.charger_connected = false;
  tell();
  expect_no_motion_for_s(2);
}

TEST_F(AnEngineWithABattery, RefusesAStartWithALowOneAndLetsATaskGoOn) {
  drive();
  sample.soc_percent = 15;
  for (int i = 0; i < 22; ++i) {
    tell();
    rig.run_s(1);
  }
  EXPECT_EQ(rig.snapshot().nav.status, NavStatus::run);
  EXPECT_EQ(rig.why(), "battery low: 15 %");
  rig.command(CancelTask{});
  rig.run_s(2);
  rig.start(path, 40, 0.5);
  rig.tick();
  EXPECT_EQ(refusal(), "battery low: 15 %");
}

TEST_F(AnEngineWithABattery, RefusesAStartWithOneThatIsEmptyJustNow) {
  rig.settle();
  for (const auto& [percent, reason] :
       {std::pair{5.0, "battery empty: 5 %, at least 10 % are needed"},
        std::pair{15.0, "battery low: 15 %"}}) {
    sample.soc_percent = percent;
    tell();
    rig.tick();
    EXPECT_EQ(rig.why(), reason) << "what a start would be refused for is told at rest";
    rig.start(path, 40, 0.5);
    rig.tick();
    EXPECT_EQ(refusal(), reason);
  }
  expect_no_motion_for_s(1);
}

TEST_F(AnEngineWithABattery, LetsATaskGoOnThroughASag) {
  drive();
  sample.soc_percent = 3;
  tell();
  rig.run_s(5);
  EXPECT_EQ(rig.snapshot().nav.status, NavStatus::run);
  EXPECT_EQ(rig.why(), "") << "it may be a sag";
}

TEST_F(AnEngineWithABattery, TellsAtRestOnceWhyNothingWouldStart) {
  rig.settle();
  sample.soc_percent = 5;
  for (int i = 0; i < 22; ++i) {
    tell();
    rig.run_s(1);
    const auto& why = rig.snapshot().why;
    ASSERT_EQ(why.size(), 1u) << "after " << i << " s";
    EXPECT_EQ(why[0].view(), "battery empty: 5 %, at least 10 % are needed");
  }
  sample.soc_percent = 70;
  tell();
  rig.tick();
  ASSERT_EQ(rig.snapshot().why.size(), 1u) << "it was empty a moment ago";
}

TEST_F(AnEngineWithABattery, LetsNothingNewBeginWithALowOneAndAStreamGoOn) {
  const auto stream_s = [this](double radps, double seconds) {
    JointTargets targets;
    for (AxisId id = 0; id < 4; ++id) (void)targets.joints.push_back({id, radps});
    for (int i = 0; i < static_cast<int>(seconds * 50); ++i) {
      rig.command(targets);
      for (int k = 0; k < 4; ++k) rig.tick();
    }
  };
  rig.settle();
  stream_s(0, 0.5);
  stream_s(2, 2);
  sample.soc_percent = 15;
  for (int i = 0; i < 22; ++i) {
    tell();
    stream_s(0.2, 1);
  }
  ASSERT_EQ(rig.why(), "battery low: 15 %");
  EXPECT_GT(rig.fastest_command_radps(), 0) << "what runs goes on";
  rig.run_s(2);
  stream_s(0, 0.5);
  stream_s(2, 1);
  EXPECT_EQ(rig.fastest_command_radps(), 0);
  EXPECT_EQ(rig.snapshot().joint_command.reason.view(), "battery low: 15 %");
  rig.command(FindHeading{});
  rig.tick();
  EXPECT_EQ(refusal(), "battery low: 15 %");
  expect_no_motion_for_s(1);
}

TEST_F(AnEngineWithABattery, DrivesOnWhenTheBatteryIsSilentAndSaysSo) {
  drive();
  rig.environment.battery[0].state = SourceState::stale;
  rig.environment.battery[0].reason = "no answer";
  rig.run_s(5);
  EXPECT_EQ(rig.snapshot().nav.status, NavStatus::run);
  EXPECT_EQ(rig.why(), "battery unknown: no answer");
  EXPECT_EQ(rig.snapshot().battery.health, SourceState::stale);
}

}  // namespace
}  // namespace drover::engine
