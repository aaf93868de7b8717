// Base and arm each with a fault of its own, and what stops both: its effect on the wire and in the
// true motion.
#include "mission/arm_motion.h"
#include "mission/arm_wire.h"

namespace drover::mission {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

/// From `begin` to `end` each motor of the arm is told to keep a place.
void expect_stiff(const Record& log, Time begin, Time end) {
  for (std::size_t joint = 0; joint < damiao::kMotors; ++joint)
    expect_stiff(log, joint, begin, end);
}

struct Place3 {
  double base_yaw;
  double shoulder;
  double elbow;
};

/// It sags by its weight over its stiffness, not more than 3.9 Nm over 100.
void expect_at(const Record& log, Time time, const Place3& asked) {
  EXPECT_NEAR(arm_at(log, kBaseYaw, time), asked.base_yaw, 0.01);
  EXPECT_NEAR(arm_at(log, kShoulder, time), asked.shoulder, 0.04);
  EXPECT_NEAR(arm_at(log, kElbow, time), asked.elbow, 0.02);
}

struct WheelFault {
  const char* happened;
  const char* joint;
  const char* follows;  ///< the stream that the arm follows then
  Place3 from;
  Place3 to;
  const char* started;  ///< when the base is to drive again
  std::size_t start;
};

const WheelFault kWheelFaults[] = {
    {"event wheel_silent#1",
     "wheel rear_left: no encoder estimates",
     "event turns#1",
     {0.5, 0.8, 0.6},
     {-0.5, 1.2, 0.2},
     "event again#1",
     2},
    {"event wheel_failed#1",
     "wheel front_right: left closed loop: bus over current",
     "event turns_back#1",
     {-0.5, 1.2, 0.2},
     {0.5, 0.8, 0.6},
     "event once_more#1",
     3},
};

TEST(ArmFaults, AWheelThatIsSilentOrFailsStopsTheBaseAndSaysSo) {
  const Record& log = record("arm_faults");
  for (const WheelFault& fault : kWheelFaults) {
    SCOPED_TRACE(fault.joint);
    const Time happened = log.event(fault.happened);
    const Time started = log.event(fault.started);
    EXPECT_NEAR(speed_at(log, happened), 0.4, 0.05);
    // A wheel is silent after a tenth of a second.
    EXPECT_THAT(log.moving(happened + 150ms, started), IsEmpty());
    EXPECT_LT(speed_at(log, happened + 1500ms), 0.01);
    tell_way_to_rest(log, happened, started);
    const Status& error = log.first_status("NAV_ERROR", happened);
    EXPECT_LT(error.time - happened, 300ms);
    EXPECT_THAT(error.why, HasSubstr(fault.joint));
    EXPECT_GT(log.answered("start_nav_success", fault.start), started);
  }
}

TEST(ArmFaults, TheArmGoesOnFollowingMeanwhile) {
  const Record& log = record("arm_faults");
  for (const WheelFault& fault : kWheelFaults) {
    SCOPED_TRACE(fault.joint);
    const Time follows = log.event(fault.follows);
    const Time happened = log.event(fault.happened);
    expect_at(log, follows, fault.from);
    // It was on its way.
    EXPECT_GT(std::abs(arm_at(log, kBaseYaw, happened) - fault.to.base_yaw), 0.1);
    expect_at(log, follows + 3s, fault.to);
    expect_stiff(log, happened, follows + 4s);
    // What it follows on the wire is what was asked, and not a place that it holds.
    const auto told = arm_set_points(log, kShoulder, follows + 3s, follows + 3900ms);
    for (const ArmSetPoint& one : told) {
      EXPECT_NEAR(one.told.position_rad, fault.to.shoulder, 2 * damiao::kLeast_rad);
      EXPECT_NEAR(one.told.stiffness, 100, damiao::kLeast_Nmprad);
    }
    EXPECT_GT(told.size(), 100U);
  }
}

// Nobody would stop either if droverd died, too.
TEST(ArmFaults, WithoutTheGuardTheBaseStopsAndTheArmIsHeld) {
  const Record& log = record("arm_faults");
  const Time killed = log.event("event guard_killed#1");
  const Time started = log.event("event at_last#1");
  EXPECT_NEAR(speed_at(log, killed), 0.4, 0.05);
  EXPECT_GT(std::abs(arm_at(log, kBaseYaw, killed) + 0.5), 0.1) << "the arm does not move";
  EXPECT_THAT(log.moving(killed + 100ms, started), IsEmpty());
  EXPECT_LT(speed_at(log, killed + 1500ms), 0.01);
  EXPECT_THAT(log.first_status("NAV_ERROR", killed).why, HasSubstr("guard does not answer"));
  // It brakes by its limit of acceleration, 5 rad/s2, and stays there though its stream goes on.
  expect_stiff(log, killed, started);
  for (std::size_t joint = 0; joint < damiao::kMotors; ++joint) {
    EXPECT_LT(strayed(log, joint, killed, started), 0.2) << joint;
    EXPECT_LT(strayed(log, joint, killed + 500ms, started), 0.02) << joint;
  }
}

TEST(ArmFaults, AMotorOfTheArmThatIsSilentDoesNotStopTheBase) {
  const Record& log = record("arm_faults");
  const Time silent = log.event("event elbow_silent#1");
  const auto& success = log.first_status("NAV_SUCCESS", silent);
  expect_nav_stays(log, "NAV_RUN", silent, success.time - 1ms);
  for (const Duration later : {500ms, 1000ms, 3000ms})
    EXPECT_NEAR(speed_at(log, silent + later), 0.4, 0.05);
  expect_good_drive(log, 4);
}

TEST(ArmFaults, TheOthersHoldThenAndTheSilentOneIsToldToDamp) {
  const Record& log = record("arm_faults");
  const Time silent = log.event("event elbow_silent#1");
  const Time heard = log.event("event elbow_heard#1");
  expect_at(log, silent, {0.5, 0.6, 0.4});
  EXPECT_LT(strayed(log, kBaseYaw, silent, heard), 0.01);
  // The elbow sinks, and its weight goes out on the shoulder's lever.
  EXPECT_LT(strayed(log, kShoulder, silent, heard), 0.03);
  const double sank = arm_at(log, kElbow, silent) - arm_at(log, kElbow, heard);
  figure("the silent elbow sank", sank, "rad");
  EXPECT_GT(sank, 0.2);
  EXPECT_LT(sank, 0.59 / 3 * 5);  // its weight, over what it damps with, for 5 s
  const auto told = arm_set_points(log, kElbow, silent + 150ms, heard);
  EXPECT_GT(told.size(), 400U);
  for (const ArmSetPoint& one : told) ASSERT_TRUE(one.told.only_damps()) << seconds(one.time);
  const auto arm = asked_status(log).at("groups").at(0);
  EXPECT_THAT(arm.at("reason").get<std::string>(), HasSubstr("elbow: no answer for"));
}

TEST(ArmFaults, TheArmFollowsAgainWhenItIsHeard) {
  const Record& log = record("arm_faults");
  expect_at(log, log.event("event lifts_again#1") + 3500ms, {0, 0.8, 0.4});
}

TEST(ArmHung, TheGuardStopsTheBaseAndLetsTheArmSinkSlowly) {
  const Record& log = record("arm_hung");
  const Time hung = log.event("event hung#1");
  const Time goes_on = log.event("event goes_on#1");
  EXPECT_NEAR(speed_at(log, hung), 0.4, 0.05);
  EXPECT_THAT(log.moving(hung + 100ms, log.event("event again#1")), IsEmpty());
  EXPECT_THAT(check_arm_only_damped(log, hung + 100ms, goes_on), IsEmpty());
  tell_way_to_rest(log, hung, goes_on);
  const double sank = arm_at(log, kShoulder, hung) - arm_at(log, kShoulder, goes_on);
  figure("sank while it hung", sank, "rad");
  EXPECT_GT(sank, 0.05);
  EXPECT_LT(sank, 0.6);
}

TEST(ArmHung, IsHeldWhereItIsAndTheOldStreamIsNotFollowed) {
  const Record& log = record("arm_hung");
  const Time goes_on = log.event("event goes_on#1");
  const Time held = goes_on + 1s;
  const Time until = log.event("event raise_again#1");
  ASSERT_LT(held, log.event("event commands_end#1")) << "nobody commands any more";
  figure("sank in all",
         arm_at(log, kShoulder, log.event("event hung#1")) - arm_at(log, kShoulder, held), "rad");
  EXPECT_LT(arm_at(log, kShoulder, held), 1.0) << "it was asked for 1.2";
  for (std::size_t joint = 0; joint < damiao::kMotors; ++joint)
    EXPECT_LT(strayed(log, joint, held, until), 0.02) << joint;
  expect_stiff(log, held, until);
  double highest = 0;
  for (const ArmSetPoint& one : arm_set_points(log, kShoulder, goes_on, until))
    highest = std::max(highest, one.told.position_rad);
  EXPECT_LT(highest, arm_at(log, kShoulder, goes_on) + 0.01);
}

TEST(ArmHung, FollowsANewStreamAndTheBaseANewStart) {
  const Record& log = record("arm_hung");
  expect_at(log, log.event("event raise_again#1") + 3s, {0, 1.2, 0.4});
  EXPECT_NEAR(speed_at(log, log.event("event ended#1")), 0.4, 0.05);
}

TEST(ArmHung, ADaemonThatEndsHoldsTheArmUntilItIsGoneThenTheGuardLetsItSinkSlowly) {
  const Record& log = record("arm_hung");
  const Time ended = log.event("event ended#1");
  const Time gone = log.event("event exit_droverd#1");
  const Time restarted = log.event("event restarted#1");
  // At its end it leaves the arm to the guard.
  expect_stiff(log, ended - 1s, gone - 50ms);
  EXPECT_LT(strayed(log, kShoulder, ended, gone), 0.01);
  EXPECT_THAT(check_arm_only_damped(log, gone, restarted), IsEmpty());
  EXPECT_THAT(log.moving(gone, log.event("event once_more#1")), IsEmpty());
  tell_way_to_rest(log, ended, restarted);
  const double sank = arm_at(log, kShoulder, gone) - arm_at(log, kShoulder, restarted);
  figure("sank before the next began", sank, "rad");
  EXPECT_GT(sank, 0.05);
  EXPECT_LT(sank, 0.6);
}

TEST(ArmHung, TheNextDaemonHoldsItAndDrives) {
  const Record& log = record("arm_hung");
  const Time restarted = log.event("event restarted#1");
  for (std::size_t joint = 0; joint < damiao::kMotors; ++joint)
    EXPECT_LT(strayed(log, joint, restarted + 1s, log.event("the end")), 0.02) << joint;
  expect_stiff(log, restarted + 1s, log.event("the end"));
  expect_good_drive(log, 3);
}

/// Nobody takes its place for so long: the guard damps, and is asked for the bus as soon as the
/// next one sees that it sinks.
TEST(ArmRestart, SinksByLittleMoreThanWhileNobodyHoldsIt) {
  const Record& log = record("arm_restart");
  for (const auto& [ended, began, most_rad] :
       {std::tuple{"event ended#1", "event restarted#1", 0.1},
        std::tuple{"event ended_again#1", "event restarted_late#1", 0.35}}) {
    const double held = arm_at(log, kShoulder, log.event(ended));
    const Time start = log.event(began);
    const double alone = held - arm_at(log, kShoulder, start);
    const double in_all = held - arm_at(log, kShoulder, start + 3s);
    figure("sank before the next began", alone, "rad");
    figure("sank in all", in_all, "rad");
    EXPECT_LT(in_all, most_rad);
    EXPECT_LT(in_all - alone, 0.03);
    EXPECT_LT(strayed(log, kShoulder, start + 1s, start + 3s), 0.01);
    expect_stiff(log, kShoulder, start + 1s, start + 3s);
  }
}

/// Its motors obey and are not heard, or its bus is gone for a moment: it does not fall.
struct ArmUnheard : testing::Test {
  const Record& log = record("arm_unheard");

  Time step(const std::string& name) const { return log.event("event " + name + "#1"); }
  double fastest_radps(std::size_t joint, Time begin, Time end) const {
    double most = 0;
    const TruthLine* before = nullptr;
    for (const TruthLine& line : log.truth) {
      if (line.time < begin || line.time > end) continue;
      if (before != nullptr)
        most = std::max(most, std::abs(line.arm_rad.at(joint) - before->arm_rad.at(joint)) /
                                  to_s(line.time - before->time));
      before = &line;
    }
    return most;
  }
};

TEST_F(ArmUnheard, IsHeldOnWhenItsBusWasGoneForAMoment) {
  const Time off = step("off");
  ASSERT_GT(arm_at(log, kShoulder, off), 0.9) << "it is up";
  for (const std::size_t joint : {kShoulder, kElbow})
    EXPECT_LT(strayed(log, joint, off, off + 1s), 0.06) << joint;
}

// 3.6 Nm at most over 4.9 Nms/rad; what is limp falls at 7 rad/s, and the elbow at 12 rad/s.
TEST_F(ArmUnheard, SinksAndDoesNotFallThroughANewLinkAndANewDroverd) {
  const Time silent = step("silent");
  const Time heard = step("heard");
  for (const std::size_t joint : {kShoulder, kElbow}) {
    const double speed = fastest_radps(joint, silent, heard);
    figure(joint == kShoulder ? "shoulder, at most" : "elbow, at most", speed, "rad/s");
    EXPECT_LT(speed, 0.9) << joint;
  }
  // It was there to fall when it happened.
  EXPECT_GT(arm_at(log, kShoulder, step("off_again")), 0.9);
  EXPECT_GT(arm_at(log, kShoulder, step("restarted")), 0.3);
}

}  // namespace
}  // namespace drover::mission
