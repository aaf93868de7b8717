// What is held again, what a person lets go, and what is remembered over a restart.
#include <cmath>

#include "engine_fixture.h"

namespace drover::engine {
namespace {

using ::testing::HasSubstr;

class ARobotThatHolds : public AnEngine {
 protected:
  void drive_and_stop() {
    drive();
    rig.command(CancelTask{});
    rig.run_s(3);
    ASSERT_EQ(rig.snapshot().hold, HoldState::held);
  }
  /// Another program takes over; the drives let go meanwhile.
  void restart(bool drives_idle = true) {
    const Remembered left = rig.out.remembered;
    rig.engine = std::make_unique<Engine>(rig.config);
    rig.engine->recall(left, rig.now);
    if (drives_idle)
      for (auto& drive : rig.drives) drive = {};
    rig.tick();
    rig.set_origin();
  }
  /// Whether the relay was closed at any time of these seconds.
  bool has_relay_s(double seconds) {
    bool closed = false;
    for (int i = 0; i < static_cast<int>(seconds * 200 + 0.5); ++i) {
      rig.tick();
      closed = closed || rig.out.outputs[static_cast<std::size_t>(Output::enable_relay)];
    }
    return closed;
  }
  WheelSpeeds speeds(double mps) const {
    const double radps = mps / rig.config.base.wheel_radius_m;
    return {radps, radps};
  }
  /// The drives lost their supply until the base rolled by `mps`; ends when they run again.
  void catch_at(double mps) {
    for (auto& drive : rig.drives) drive = {.silent = true, .position_rad = drive.position_rad};
    rig.carried = speeds(mps);
    rig.run_s(2);
    for (auto& drive : rig.drives) drive.silent = false;
    for (int i = 0; i < 100 && rig.drives[0].state != AxisState::running; ++i) rig.tick();
    ASSERT_EQ(rig.drives[0].state, AxisState::running);
    rig.carried.reset();
  }
  /// The base stands on ground that falls by so much, for one cycle of its inertial sensor.
  void tick_tilted(double deg) {
    rig.environment.imu_configured = true;
    rig.environment.imu[0].state = SourceState::fresh;
    rig.environment.imu[0].last_good = rig.now;
    Measurement m;
    m.time = m.received = rig.now;
    ImuSample sample;
    sample.has_orientation = true;
    sample.orientation = {std::cos(to_rad(deg) / 2), 0, std::sin(to_rad(deg) / 2), 0};
    sample.acceleration_mps2 = {9.81 * std::sin(to_rad(deg)), 0, 9.81 * std::cos(to_rad(deg))};
    m.value = sample;
    rig.engine->on_measurement(m);
    rig.tick();
  }
  void tilt_s(double deg, double seconds) {
    for (int i = 0; i < static_cast<int>(seconds * 200); ++i) tick_tilted(deg);
  }
};

TEST_F(ARobotThatHolds, IsHeldAgainAfterARestart) {
  drive_and_stop();
  restart();
  rig.run_s(1);
  EXPECT_EQ(rig.snapshot().hold, HoldState::held);
  for (const auto& drive : rig.drives) EXPECT_EQ(drive.state, AxisState::running);
}
TEST_F(ARobotThatHolds, IsHeldAgainAfterADipOfItsSupply) {
  drive_and_stop();
  for (auto& drive : rig.drives) drive.state = AxisState::idle;
  rig.tick();
  rig.tick();
  EXPECT_EQ(rig.snapshot().hold, HoldState::catching);
  rig.start(path, 40, 0.5);
  rig.tick();
  EXPECT_THAT(refusal(), HasSubstr("being taken back"));
  rig.run_s(1);
  EXPECT_EQ(rig.snapshot().hold, HoldState::held);
}
TEST_F(ARobotThatHolds, IsRampedDownFromASpeedThatNoCommandMayHave) {
  drive_and_stop();
  catch_at(2.4);
  const double fall_radps =
      1.001 * rig.config.limits.deceleration_mps2 / rig.config.base.wheel_radius_m * 0.005;
  double before_radps = rig.out.axes[0].velocity_radps;
  ASSERT_GT(before_radps * rig.config.base.wheel_radius_m, 2.2);
  for (int i = 0; i < 800; ++i) {
    rig.tick();
    const double asked_radps = rig.out.axes[0].velocity_radps;
    ASSERT_LE(asked_radps, before_radps);
    ASSERT_GE(asked_radps, before_radps - fall_radps) << i * 0.005 << " s, " << rig.why();
    before_radps = asked_radps;
  }
  EXPECT_EQ(before_radps, 0);
  EXPECT_LT(rig.plant.truth().vx_mps, 0.01);
  EXPECT_EQ(rig.snapshot().hold, HoldState::held) << rig.why();
}
TEST_F(ARobotThatHolds, IsLetGoWhenItGetsFasterWhileItIsCaught) {
  drive_and_stop();
  catch_at(2.4);
  rig.carried = speeds(4);
  rig.run_s(1);
  EXPECT_THAT(rig.why(), HasSubstr("runs away"));
  EXPECT_EQ(rig.out.axes[0].velocity_radps, 0);
}
TEST_F(ARobotThatHolds, IsNotHeldAgainAfterAnEstop) {
  drive_and_stop();
  rig.lines[0] = true;
  rig.run_s(0.1);
  rig.lines[0] = false;
  for (auto& drive : rig.drives) drive.state = AxisState::idle;
  rig.run_s(1);
  EXPECT_EQ(rig.drives[0].state, AxisState::idle);
  restart();
  rig.run_s(1);
  EXPECT_EQ(rig.drives[0].state, AxisState::idle);
  rig.command(ArmHold{});
  rig.run_s(1);
  EXPECT_EQ(rig.snapshot().hold, HoldState::held);
}
TEST_F(ARobotThatHolds, GetsNoPowerBeforeTheEmergencyStopsLineTells) {
  drive_and_stop();
  rig.line_unknown.fill(true);
  restart();
  EXPECT_FALSE(has_relay_s(0.35)) << "both programs were dead, and it had fallen";
  rig.line_unknown.fill(false);
  EXPECT_TRUE(has_relay_s(0.1));
  rig.run_s(1);
  EXPECT_EQ(rig.snapshot().hold, HoldState::held);
}
TEST_F(ARobotThatHolds, GetsNoPowerAfterARestartWhileTheEmergencyStopIsPressed) {
  drive_and_stop();
  rig.line_unknown.fill(true);
  restart();
  EXPECT_FALSE(has_relay_s(0.01));
  rig.line_unknown.fill(false);
  rig.lines[0] = true;
  EXPECT_FALSE(has_relay_s(2));
  EXPECT_EQ(rig.snapshot().hold, HoldState::idle) << "an e-stop ends the holding";
}
TEST_F(ARobotThatHolds, KeepsThePowerThatTheGuardKeptUntilTheLineTells) {
  drive_and_stop();
  for (const bool pressed : {false, true}) {
    rig.line_unknown.fill(true);
    rig.environment.relay_found_closed = true;
    restart(false);
    EXPECT_TRUE(has_relay_s(0.35));
    EXPECT_EQ(rig.drives[0].state, AxisState::running);
    rig.line_unknown.fill(false);
    rig.lines[0] = pressed;
    rig.tick();
    rig.tick();
    EXPECT_EQ(has_relay_s(0.5), !pressed);
  }
}
TEST_F(ARobotThatHolds, WasNeverHeldWithoutAPersonWhoArmedIt) {
  rig.settle();
  restart(false);
  rig.run_s(2);
  EXPECT_EQ(rig.drives[0].state, AxisState::idle);
  EXPECT_EQ(rig.snapshot().hold, HoldState::idle);
}
TEST_F(ARobotThatHolds, IsReleasedByAPersonAndStartsOnlyAfterHold) {
  drive_and_stop();
  rig.command(ReleaseHold{});
  rig.tick();
  EXPECT_THAT(refusal(), HasSubstr("tilt is not known"));
  rig.command(ReleaseHold{true});
  rig.run_s(0.1);
  EXPECT_EQ(rig.drives[0].state, AxisState::idle);
  EXPECT_EQ(rig.snapshot().hold, HoldState::released);
  restart();
  rig.run_s(3);
  EXPECT_EQ(rig.snapshot().hold, HoldState::released);
  rig.start(path, 40, 0.5);
  rig.tick();
  EXPECT_EQ(refusal(), "the drives are released: drover hold");
  rig.command(ArmHold{});
  rig.run_s(1);
  EXPECT_EQ(rig.snapshot().hold, HoldState::held);
}
TEST_F(ARobotThatHolds, IsNotReleasedWhileItIsDriven) {
  drive();
  rig.command(ReleaseHold{true});
  rig.tick();
  EXPECT_THAT(refusal(), HasSubstr("is being driven"));
  EXPECT_EQ(rig.snapshot().nav.status, NavStatus::run);
}
TEST_F(ARobotThatHolds, RemembersAStopOverARestartUntilItIsReset) {
  drive();
  rig.command(EngageStop{});
  rig.run_s(1);
  restart();
  rig.run_s(3);
  EXPECT_TRUE(rig.snapshot().stop_latched);
  EXPECT_THAT(rig.why(), HasSubstr("emergency stop of an operator"));
  rig.start(path, 40, 0.5);
  rig.run_s(2);
  EXPECT_THAT(refusal(), HasSubstr("reset the stop first"));
  EXPECT_EQ(rig.fastest_command_radps(), 0);
  rig.command(ResetStop{});
  rig.tick();
  EXPECT_FALSE(rig.snapshot().stop_latched);
  EXPECT_TRUE(rig.out.remembered.stop.empty());
}
TEST_F(ARobotThatHolds, ResetsAStopThatIsForTheRobotOnlyThere) {
  Remembered left;
  left.stop = "it did not stop";
  left.stop_at_robot = true;
  left.power_cut = true;
  rig.engine->recall(left, rig.now);
  rig.settle();
  constexpr auto kRelay = static_cast<std::size_t>(Output::enable_relay);
  EXPECT_FALSE(rig.out.outputs[kRelay]);
  rig.command(ResetStop{});  // the rig's commands come over the network
  rig.tick();
  EXPECT_THAT(refusal(), HasSubstr("at the robot"));
  rig.engine->on_command({{RequestId::Source::cli, 1}, rig.now, ResetStop{}}, rig.now);
  rig.tick();
  EXPECT_FALSE(rig.snapshot().stop_latched);
  EXPECT_TRUE(rig.out.outputs[kRelay]);
}
TEST_F(ARobotThatHolds, ArmsNoWheelThatRanAwayBeforeARestartUntilAReset) {
  drive();
  rig.drives[0].by_itself_radps = 12;
  rig.run_s(0.5);
  rig.drives[0].by_itself_radps = 0;
  rig.run_s(1);
  restart();
  rig.run_s(1);
  rig.command(ArmHold{});
  rig.tick();
  EXPECT_THAT(refusal(), HasSubstr("a wheel ran away: drover reset"));
  EXPECT_NE(rig.snapshot().hold, HoldState::held);
  rig.command(ResetStop{});
  rig.run_s(0.1);
  rig.command(ArmHold{});
  rig.run_s(1);
  EXPECT_EQ(rig.snapshot().hold, HoldState::held) << rig.why();
}
TEST_F(ARobotThatHolds, TellsThatATaskWasOnItsWay) {
  drive();
  restart();
  rig.run_s(1);
  const auto notices = rig.said<Notice>();
  EXPECT_TRUE(std::any_of(notices.begin(), notices.end(), [](const Notice& notice) {
    return notice.text.view().find("a task was on its way") != std::string_view::npos;
  }));
  EXPECT_EQ(rig.fastest_command_radps(), 0);
}
TEST_F(ARobotThatHolds, EndsATaskOnSteepGroundWithARampAndStartsNoneThere) {
  rig.config.base.hold = HoldBy::level_ground_only;
  rig.engine = std::make_unique<Engine>(rig.config);
  drive();
  tilt_s(2, 1);
  EXPECT_EQ(rig.snapshot().nav.status, NavStatus::run) << rig.why();
  tilt_s(6, 0.25);
  EXPECT_EQ(rig.snapshot().nav.status, NavStatus::run) << "a stone is no slope";
  tilt_s(6, 3);
  EXPECT_EQ(rig.snapshot().nav.status, NavStatus::error);
  EXPECT_THAT(rig.why(), HasSubstr("the ground falls by 6.0 degrees"));
  EXPECT_EQ(rig.snapshot().hold, HoldState::held);
  rig.start(path, 40, 0.5);
  rig.tick();
  EXPECT_THAT(refusal(), HasSubstr("the ground falls by"));
}
TEST_F(ARobotThatHolds, WithABrakeStopsForNoSlope) {
  drive();
  tilt_s(6, 1);
  EXPECT_EQ(rig.snapshot().nav.status, NavStatus::run) << rig.why();
}

}  // namespace
}  // namespace drover::engine
