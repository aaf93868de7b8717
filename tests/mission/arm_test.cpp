// An arm beside the base, of wheels or a chassis that takes a twist: each is stopped by what is its
// own, and by what is of all.
#include "mission/arm_motion.h"
#include "mission/arm_wire.h"

namespace drover::mission {
namespace {

class Arm : public testing::TestWithParam<const char*> {};
class ArmKill : public testing::TestWithParam<const char*> {};
/// All missions of an arm of DAMIAO motors.
class ArmWires : public testing::TestWithParam<const char*> {};

TEST_P(ArmWires, HaveNoStepInWhatTheirMotorsAreTold) {
  EXPECT_THAT(check_arm_steps(record(GetParam()), read_arm_bounds(GetParam())), testing::IsEmpty());
}

TEST_P(Arm, FollowsWhileTheBaseDrives) {
  const Record& log = record(GetParam());
  const Time raised = log.event("event raise#1") + 4s;
  EXPECT_NEAR(arm_at(log, 0, raised), 0.5, 0.01);
  // Each sags by its weight over its stiffness, 100 and 50 Nm/rad.
  EXPECT_NEAR(arm_at(log, kShoulder, raised), 0.8 - 2.39 / 100, 0.01);
  EXPECT_NEAR(arm_at(log, kElbow, raised), 0.6 - 0.11 / 50, 0.01);
  EXPECT_GT(speed_at(log, raised), 0.04);
}

/// The fastest of the three, from one line of the true motion to the next.
double fastest_radps(const Record& log, Time begin, Time end) {
  double fastest = 0;
  for (std::size_t i = 1; i < log.truth.size(); ++i) {
    const TruthLine& line = log.truth[i];
    if (line.time < begin || line.time > end) continue;
    const double dt_s = to_s(line.time - log.truth[i - 1].time);
    for (std::size_t joint = 0; joint < 3; ++joint)
      fastest = std::max(
          fastest, std::abs(line.arm_rad.at(joint) - log.truth[i - 1].arm_rad.at(joint)) / dt_s);
  }
  return fastest;
}

// Its limit is 1 rad/s, and that is how fast its set point moves (ArmWires). The joint is a mass on
// the spring and damper that the command asks for: 80 Nm/rad and 3 Nms/rad make a damping ratio of
// 0.4 of the 0.15 kgm2 of the base's joint. It lags behind while its set point gathers speed, makes
// that up, and is faster for so long; most so the shoulder, which leaves its stop only when
// stiffness times the distance carries 3.5 Nm. Then it has the set point's speed.
TEST_P(Arm, StepsOfPositionAreMadeByItsLimits) {
  const Record& log = record(GetParam());
  const Time begin = log.event("event raise#1");
  const double gathers = fastest_radps(log, begin, begin + 1s);
  const double then = fastest_radps(log, begin + 1050ms, begin + 4s);
  figure("fastest of its joints, which leave their stops", gathers, "rad/s");
  figure("fastest of its joints then", then, "rad/s");
  EXPECT_LT(gathers, 1.3);
  EXPECT_GT(then, 0.9);
  EXPECT_LT(then, 1.06);
  const Time lift = log.event("event lift#1");
  EXPECT_LT(fastest_radps(log, lift, lift + 700ms), 1.25) << "where it was held";
  EXPECT_LT(fastest_radps(log, lift + 700ms, lift + 4s), 1.06);
}

// 5 N down at the tip: torque by lever, angle by stiffness; what the weight changes with it is less
// than a tenth.
TEST_P(Arm, GivesUnderAPushAsStiffnessSays) {
  const Record& log = record(GetParam());
  const Time pushed = log.event("event pushed#1");
  // The true motion is told each 50 ms: its next line may be of a moment that gave already.
  const Time before = pushed - 100ms;
  const double shoulder = arm_at(log, kShoulder, before);
  const double elbow = arm_at(log, kElbow, before);
  const double lever_m = 0.3 * std::cos(shoulder + elbow);
  const double shoulder_lever_m = 0.3 * std::cos(shoulder) + lever_m;
  const Time stands = pushed + 1900ms;
  const double shoulder_gave = shoulder - arm_at(log, kShoulder, stands);
  const double elbow_gave = elbow - arm_at(log, kElbow, stands);
  figure("shoulder gave", shoulder_gave, "rad");
  figure("elbow gave", elbow_gave, "rad");
  EXPECT_NEAR(shoulder_gave, 5 * shoulder_lever_m / 100, 0.1 * shoulder_gave);
  EXPECT_NEAR(elbow_gave, 5 * lever_m / 50, 0.1 * elbow_gave + 0.0005);
}

TEST_P(Arm, AFailedDriveStopsTheArmAndNotTheBase) {
  const Record& log = record(GetParam());
  const Time failed = log.event("event failed#1");
  const Time again = log.event("event lower#1");
  expect_nav_stays(log, "NAV_RUN", failed, again);
  EXPECT_NEAR(speed_at(log, again), 0.4, 0.05);
  // The others hold where they were, though the elbow's weight is gone from the shoulder's lever.
  EXPECT_LT(strayed(log, kShoulder, failed, again), 0.03);
  EXPECT_LT(strayed(log, 0, failed, again), 0.01);
}

TEST_P(Arm, AnEstopStopsBothAndTheArmIsHeld) {
  const Record& log = record(GetParam());
  const Time pressed = log.event("event pressed#1");
  EXPECT_LT(speed_at(log, pressed + 1500ms), 0.01);
  for (std::size_t joint = 0; joint < 3; ++joint)
    EXPECT_LT(strayed(log, joint, pressed + 200ms, log.event("event again#1")), 0.02) << joint;
}

TEST_P(Arm, FollowsAgainAfterTheFaultAndAfterTheEstop) {
  const Record& log = record(GetParam());
  const Time lowered = log.event("event pressed#1") - 100ms;
  EXPECT_NEAR(arm_at(log, kBaseYaw, lowered), -0.5, 0.01);
  EXPECT_NEAR(arm_at(log, kShoulder, lowered), 0.4 - 3.4 / 100, 0.01);
  EXPECT_NEAR(arm_at(log, kElbow, lowered), 0.2 - 0.5 / 50, 0.01);
  // The e-stop ended that stream, which went on; a new one is followed.
  const Time lifted = log.event("event lift#1") + 3900ms;
  EXPECT_NEAR(arm_at(log, kBaseYaw, lifted), 0.3, 0.01);
  EXPECT_NEAR(arm_at(log, kShoulder, lifted), 1.0 - 2 / 100., 0.01);
  EXPECT_NEAR(arm_at(log, kElbow, lifted), 0.5, 0.01);
}

TEST_P(Arm, TheTaskEndsAtItsGoal) {
  expect_good_drive(record(GetParam()), 2);
}

TEST_P(ArmKill, IsLetDownSlowlyByTheGuardAndHeldByTheNextDaemon) {
  const Record& log = record(GetParam());
  const Time killed = log.event("event killed#1");
  const double held = arm_at(log, kShoulder, killed);
  EXPECT_NEAR(held, 1.0, 0.05);
  EXPECT_LT(strayed(log, kShoulder, log.event("event held#1") - 4s, killed), 0.01);
  const Time back = log.event("event restarted#1");
  const double sank = held - arm_at(log, kShoulder, back);
  figure("sank before the next began", sank, "rad");
  EXPECT_GT(sank, 0.1);
  EXPECT_LT(sank, 0.6);  // 3.9 Nm at most, over 4.9 Nms/rad, for 0.7 s
  const double caught = held - arm_at(log, kShoulder, back + 2s);
  figure("sank in all", caught, "rad");
  EXPECT_LT(caught, 1.0);
  EXPECT_LT(strayed(log, kShoulder, back + 2s, log.event("event both#1")), 0.01);
}

TEST_P(ArmKill, TheBaseIsStoppedByTheGuard) {
  const Record& log = record(GetParam());
  const Time killed = log.event("event killed#1");
  const Time back = log.event("event restarted#1");
  EXPECT_GT(speed_at(log, killed), 0.3);
  // What lay in the line's queue when it died may still leave.
  EXPECT_THAT(log.moving(killed + 100ms, back), testing::IsEmpty());
  tell_way_to_rest(log, killed, back);
  EXPECT_LT(roll(log, killed, back).way_m, 0.35);
}

TEST_P(ArmKill, StaysHeldWhileTheBaseDrivesAnew) {
  expect_good_drive(record(GetParam()), 2);
}

// The guard hears it as well, and has the wheels; it could only let the arm sink.
TEST_P(ArmKill, IsHeldByDroverStop) {
  const Record& log = record(GetParam());
  const Time stopped = log.event("event stopped#1");
  EXPECT_LT(strayed(log, kShoulder, stopped - 500ms, log.event("event both#1")), 0.02);
}

TEST_P(ArmKill, TheGuardOnlyDampsIt) {
  const Record& log = record(GetParam());
  EXPECT_THAT(check_arm_only_damped(log, log.event("event killed#1") + 100ms,
                                    log.event("event restarted#1")),
              testing::IsEmpty());
}

// What no software holds, and the README says so.
TEST_P(ArmKill, FallsWhenBothProgramsAreGone) {
  const Record& log = record(GetParam());
  const Time both = log.event("event both#1");
  const Time lies = both + 1s;
  figure("fell", arm_at(log, kShoulder, both) - arm_at(log, kShoulder, lies), "rad");
  EXPECT_NEAR(arm_at(log, kShoulder, lies), -0.6, 0.03);
}

/// Commands to the arm's motors, whoever sent them.
std::size_t frames_to_the_arm(const Record& log, Time begin, Time end) {
  return static_cast<std::size_t>(
      std::count_if(log.can.begin(), log.can.end(), [&](const CanLine& line) {
        return line.time >= begin && line.time <= end && line.bus == "can1" && line.frame.id >= 1 &&
               line.frame.id <= 3;
      }));
}

TEST(ScoutArmBus, TheBaseDrivesOnWhileTheArmsBusIsAway) {
  const Record& log = record("scout_arm_bus");
  const Time lost = log.event("event arm_lost#1");
  expect_nav_stays(log, "NAV_RUN", lost, log.event("event both_lost#1"));
  EXPECT_NEAR(speed_at(log, log.event("event arm_back#1")), 0.4, 0.02);
}

TEST(ScoutArmBus, TheArmIsRefusedMeanwhileAndThatIsTold) {
  const Record& log = record("scout_arm_bus");
  EXPECT_LT(strayed(log, 0, log.event("event arm_lost#1"), log.event("event follows#1")), 0.01);
  const auto arm = asked_status(log).at("groups").at(0);
  EXPECT_EQ(arm.at("reason"), "base_yaw: can1: no such CAN interface");
  EXPECT_GT(arm.at("refused"), 0);
}

TEST(ScoutArmBus, TheArmFollowsAgainWhenItsBusIsBack) {
  const Record& log = record("scout_arm_bus");
  EXPECT_NEAR(arm_at(log, 0, log.event("event follows#1")), 0.5, 0.01);
  EXPECT_NEAR(arm_at(log, 0, log.event("event follows#1") + 3s), 0, 0.01);
}

TEST(ScoutArmBus, OfBothBusesTheBasesMayComeBackAlone) {
  const Record& log = record("scout_arm_bus");
  const Time back = log.event("event base_back#1");
  EXPECT_LT(speed_at(log, back), 0.01);
  EXPECT_GT(log.answered("start_nav_success", 2), back);
  EXPECT_NEAR(speed_at(log, log.event("event killed#1") - 50ms), 0.4, 0.02);
}

TEST(ScoutArmBus, TheGuardStopsTheBaseWhoseDroverdIsKilledThen) {
  const Record& log = record("scout_arm_bus");
  const Time killed = log.event("event killed#1");
  const Time restarted = log.event("event restarted#1");
  EXPECT_THAT(log.moving(killed + 100ms, restarted), testing::IsEmpty());
  tell_way_to_rest(log, killed, restarted);
  EXPECT_LT(roll(log, killed, restarted).way_m, 0.45);
}

TEST(ScoutArmBus, TheNextDroverdDrivesWithoutTheArmToTheGoal) {
  const Record& log = record("scout_arm_bus");
  EXPECT_LT(log.answered("start_nav_success", 3), log.event("event arm_back_at_last#1"));
  expect_good_drive(log, 3);
  EXPECT_NEAR(arm_at(log, 0, log.event("event follows_again#1") + 3s), 0.5, 0.01);
}

TEST(ScoutArmBus, TheGuardStopsTheArmOnTheInterfaceThatCameBack) {
  const Record& log = record("scout_arm_bus");
  const Time killed = log.event("event killed_at_last#1");
  EXPECT_GT(frames_to_the_arm(log, killed + 100ms, killed + 1s), 30U);
  EXPECT_THAT(check_arm_only_damped(log, killed + 100ms, killed + 900ms), testing::IsEmpty());
}

TEST(ScoutArmBusLate, TheBaseDrivesWithoutTheArmAndSaysThatNobodyReachesIt) {
  const Record& log = record("scout_arm_bus_late");
  EXPECT_NEAR(speed_at(log, log.event("event raise#1")), 0.4, 0.02);
  expect_nav_stays(log, "NAV_RUN", log.answered("start_nav_success"), log.event("event killed#1"));
  const auto status = asked_status(log);
  EXPECT_EQ(status.at("links").at(1).at("reason"),
            "can1: no such CAN interface; drover-guard has no way there either");
  EXPECT_GT(status.at("groups").at(0).at("refused"), 0);
}

TEST(ScoutArmBusLate, TheArmFollowsWhenItsBusCame) {
  const Record& log = record("scout_arm_bus_late");
  EXPECT_LT(strayed(log, kShoulder, log.event("event off#1"), log.event("event raise#1")), 0.01);
  // It sags by its weight over its stiffness.
  EXPECT_NEAR(arm_at(log, kShoulder, log.event("event killed#1")), 0.8, 0.05);
}

TEST(ScoutArmBusLate, TheGuardLetsItSinkSlowlyAndStopsTheBase) {
  const Record& log = record("scout_arm_bus_late");
  const Time killed = log.event("event killed#1");
  const Time back = log.event("event restarted#1");
  const double sank = arm_at(log, kShoulder, killed) - arm_at(log, kShoulder, back);
  figure("sank before the next began", sank, "rad");
  EXPECT_GT(sank, 0.1);
  EXPECT_LT(sank, 0.6);  // as of scout_arm_kill
  EXPECT_THAT(check_arm_only_damped(log, killed + 100ms, back), testing::IsEmpty());
  EXPECT_THAT(log.moving(killed + 100ms, back), testing::IsEmpty());
  EXPECT_LT(roll(log, killed, back).way_m, 0.35);
  expect_good_drive(log, 2);
}

// The button that is nearest may be the chassis'.
TEST(ScoutArmEstop, TheChassisOwnEstopStopsTheArmAndTheTask) {
  const Record& log = record("scout_arm_estop");
  const Time pressed = log.event("event pressed#1");
  EXPECT_GT(strayed(log, 0, pressed - 300ms, pressed), 0.2) << "it does not move";
  const auto& error = log.first_status("NAV_ERROR", pressed);
  EXPECT_LT(error.time - pressed, 500ms);
  EXPECT_THAT(error.why, testing::HasSubstr("the chassis' emergency stop is pressed"));
  // Braked by the limit of acceleration, from 1 rad/s; then it rests.
  const double braked = strayed(log, 0, pressed, pressed + 1s);
  figure("its first joint moved on", braked, "rad");
  EXPECT_LT(braked, 0.4);
  for (const std::size_t joint : {std::size_t{0}, kShoulder, kElbow})
    EXPECT_LT(strayed(log, joint, pressed + 1s, log.event("event begun#1")), 0.03) << joint;
}

TEST(ScoutArmEstop, NoStreamBeginsWhileItIsPressedNorGoesOnWhenItIsReleased) {
  const Record& log = record("scout_arm_estop");
  const Time begun = log.event("event begun#1");
  ASSERT_GT(begun + 5s - log.event("event released#1"), 2s) << "the stream goes on after it";
  for (const std::size_t joint : {std::size_t{0}, kShoulder, kElbow})
    EXPECT_LT(strayed(log, joint, begun, log.event("event again#1")), 0.03) << joint;
  const auto arm = asked_status(log).at("groups").at(0);
  EXPECT_EQ(arm.at("reason"), "the base: the chassis' emergency stop is pressed");
  EXPECT_GT(arm.at("refused"), 0);
}

TEST(ScoutArmEstop, ANewStreamAndANewStartAreFollowedThen) {
  const Record& log = record("scout_arm_estop");
  EXPECT_NEAR(arm_at(log, 0, log.event("event lower#1") + 3s), 0.3, 0.02);
  expect_good_drive(log, 2);
}

std::string name_of(const testing::TestParamInfo<const char*>& one) {
  return one.param;
}
// Its motors do not tell that they are on, and to ask them would drop what they carry.
TEST(CubemarsArmKill, SinksAsSlowlyUnderTheNextDaemonAsUnderTheGuard) {
  const Record& log = record("cubemars_arm_kill");
  const Time killed = log.event("event killed#1");
  EXPECT_NEAR(arm_at(log, kShoulder, killed), 1.0, 0.05);
  double fastest = 0;
  for (Time at = killed; at < log.event("event stopped#1") - 1s; at += 500ms)
    fastest = std::max(fastest, 2 * strayed(log, kShoulder, at, at + 500ms));
  figure("fastest of its shoulder", fastest, "rad/s");
  EXPECT_LT(fastest, 0.9);  // 3.9 Nm at most, over 4.9 Nms/rad
  EXPECT_GT(arm_at(log, kShoulder, log.event("event restarted#1") + 500ms), -0.5) << "it lies";
  const auto lets_go = [&](const CanLine& line) {
    return line.time >= killed && line.bus == "can1" && line.frame.data[0] == 0xFF &&
           line.frame.data[7] == 0xFD;
  };
  EXPECT_EQ(std::count_if(log.can.begin(), log.can.end(), lets_go), 0);
}

TEST(CubemarsArmKill, TheBaseDrivesAnew) {
  expect_good_drive(record("cubemars_arm_kill"), 2);
}

INSTANTIATE_TEST_SUITE_P(Each, Arm, testing::Values("arm", "scout_arm", "cubemars_arm"), name_of);
INSTANTIATE_TEST_SUITE_P(Each, ArmWires,
                         testing::Values("arm", "arm_kill", "scout_arm", "scout_arm_kill",
                                         "scout_arm_bus", "scout_arm_bus_late", "scout_arm_estop",
                                         "arm_faults", "arm_hung", "arm_sinks", "arm_holds",
                                         "arm_steps", "arm_push", "arm_trust", "arm_mirrored",
                                         "arm_release", "arm_presses", "arm_silence", "arm_restart",
                                         "arm_led", "two_arms"),
                         name_of);
INSTANTIATE_TEST_SUITE_P(Each, ArmKill, testing::Values("arm_kill", "scout_arm_kill"), name_of);

}  // namespace
}  // namespace drover::mission
