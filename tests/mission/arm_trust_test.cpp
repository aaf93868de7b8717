// A motor of the arm that cannot be believed: it turns against what it is told, or its encoder
// stands still. It is what moves that is judged, and what that motor is told.
#include "mission/arm_motion.h"
#include "mission/arm_wire.h"

namespace drover::mission {
namespace {

using testing::HasSubstr;

struct ArmTrust : testing::Test {
  const Record& log = record("arm_trust");

  Time step(const std::string& name) const { return log.event("event " + name + "#1"); }
  /// What the motor of a joint gives, at the most.
  double hardest_Nm(std::size_t joint, Time begin, Time end) const {
    double most_Nm = 0;
    for (const TruthLine& line : log.truth)
      if (line.time >= begin && line.time <= end)
        most_Nm = std::max(most_Nm, std::abs(line.arm_Nm.at(joint)));
    return most_Nm;
  }
  /// Over five lines of the true motion, which are cut off.
  double fastest_radps(std::size_t joint, Time begin, Time end) const {
    double fastest = 0;
    for (std::size_t i = 5; i < log.truth.size(); ++i) {
      const TruthLine& line = log.truth[i];
      const TruthLine& before = log.truth[i - 5];
      if (before.time < begin || line.time > end) continue;
      const double way_rad = line.arm_rad.at(joint) - before.arm_rad.at(joint);
      fastest = std::max(fastest, std::abs(way_rad) / to_s(line.time - before.time));
    }
    return fastest;
  }
  /// When it is told for the first time to let go, by its id and FF seven times, FD.
  Time let_go(std::size_t joint, Time begin) const {
    for (const CanLine& line : log.can)
      if (line.time > begin && line.bus == "can1" && line.frame.id == joint + 1 &&
          line.frame.data[0] == 0xFF && line.frame.data[7] == 0xFD)
        return line.time;
    return Time::max();
  }
};

TEST_F(ArmTrust, AMotorThatTurnsTheWrongWayIsLetGo) {
  const Time begun = step("turns");
  const Time mended = step("mended");
  EXPECT_LT(strayed(log, kBaseYaw, log.truth.front().time, begun), 0.01) << "nobody commanded it";
  const Time gone = let_go(kBaseYaw, begun);
  ASSERT_LT(gone, mended);
  // A stream is followed when it is 0.3 s old.
  figure("let go after its stream began", gone - begun);
  const double fled_rad = strayed(log, kBaseYaw, begun, mended);
  figure("fled", fled_rad, "rad");
  figure("as fast as", fastest_radps(kBaseYaw, begun, mended), "rad/s");
  figure("with", hardest_Nm(kBaseYaw, begun, mended), "Nm");
  EXPECT_GT(fled_rad, 0.03) << "it was believed";
  EXPECT_LT(fastest_radps(kBaseYaw, begun, mended), 5);
  EXPECT_LT(hardest_Nm(kBaseYaw, begun, mended), 14);
  EXPECT_LT(hardest_Nm(kBaseYaw, gone + 10ms, mended), 0.01) << "it is limp";
}

TEST_F(ArmTrust, TheOthersHoldThenAndItIsToldInWords) {
  const Time begun = step("turns");
  const Time mended = step("mended");
  EXPECT_LT(strayed(log, kShoulder, begun, mended), 0.03);
  EXPECT_LT(strayed(log, kElbow, begun, mended), 0.02);
  expect_stiff(log, kShoulder, begun, mended);
  expect_stiff(log, kElbow, begun, mended);
  const auto arm = asked_status(log).at("groups").at(0);
  EXPECT_THAT(arm.at("reason").get<std::string>(), HasSubstr("base_yaw: it turns by"));
  EXPECT_THAT(arm.at("reason").get<std::string>(), HasSubstr("its drive turns the wrong way"));
}

TEST_F(ArmTrust, IsFollowedAgainWhenItIsMended) {
  const Time bends = step("bends") - 50ms;
  EXPECT_NEAR(arm_at(log, kBaseYaw, bends), 0.5, 0.02);
  EXPECT_NEAR(arm_at(log, kShoulder, bends), 1.0, 0.04);
  EXPECT_NEAR(arm_at(log, kElbow, bends), 0.2, 0.02);
}

TEST_F(ArmTrust, NoTorqueIsMadeOfAnEncoderThatStands) {
  const Time stuck = step("stuck");
  const Time turns = step("turns_again");
  EXPECT_GT(arm_at(log, kElbow, stuck) - arm_at(log, kElbow, stuck - 100ms), 0.03)
      << "it does not move";
  Time last = stuck;
  for (const TruthLine& line : log.truth)
    if (line.time > stuck && line.time < turns && std::abs(line.arm_Nm.at(kElbow)) > 0.05)
      last = line.time;
  figure("its last torque after it stood still", last - stuck);
  figure("its torque", hardest_Nm(kElbow, stuck, turns), "Nm");
  figure("as fast as", fastest_radps(kElbow, stuck, stuck + 100ms), "rad/s");
  figure("falling", fastest_radps(kElbow, stuck, turns), "rad/s");
  EXPECT_LT(last - stuck, 60ms);
  EXPECT_LT(hardest_Nm(kElbow, stuck, turns), 4);
  EXPECT_LT(fastest_radps(kElbow, stuck, stuck + 100ms), 4);
  const auto told = arm_set_points(log, kElbow, stuck + 60ms, turns);
  EXPECT_GT(told.size(), 300U);
  for (const ArmSetPoint& one : told) ASSERT_TRUE(one.told.only_damps()) << seconds(one.time);
}

TEST_F(ArmTrust, TheOthersHoldThatToo) {
  const Time stuck = step("stuck");
  const Time turns = step("turns_again");
  expect_stiff(log, kBaseYaw, stuck, turns);
  expect_stiff(log, kShoulder, stuck, turns);
  // What turns is braked by its limit of acceleration.
  EXPECT_LT(strayed(log, kBaseYaw, stuck + 250ms, turns), 0.25);
  EXPECT_LT(strayed(log, kBaseYaw, stuck + 1s, turns), 0.02);
  EXPECT_LT(strayed(log, kShoulder, stuck, turns), 0.06) << "the elbow falls, and swings";
  const auto arm = asked_status(log, 2).at("groups").at(0);
  EXPECT_THAT(arm.at("reason").get<std::string>(), HasSubstr("elbow: it turned by"));
  EXPECT_THAT(arm.at("reason").get<std::string>(), HasSubstr("its encoder stands still"));
}

TEST_F(ArmTrust, FollowsAnewWhenItTurnsAgain) {
  const Time lifted = step("lifts") + 3500ms;
  EXPECT_NEAR(arm_at(log, kBaseYaw, lifted), 0, 0.02);
  EXPECT_NEAR(arm_at(log, kShoulder, lifted), 0.8, 0.04);
  EXPECT_NEAR(arm_at(log, kElbow, lifted), 0.4, 0.02);
}

TEST_F(ArmTrust, DoesNotStopTheBase) {
  expect_nav_stays(log, "NAV_RUN", log.answered("start_nav_success"),
                   log.first_status("NAV_SUCCESS").time - 1ms);
  for (const char* name : {"turns", "stuck"})
    EXPECT_NEAR(speed_at(log, step(name) + 1s), 0.4, 0.05) << name;
  expect_good_drive(log);
}

}  // namespace
}  // namespace drover::mission
