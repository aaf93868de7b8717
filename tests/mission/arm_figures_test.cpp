// What an arm makes of steps, pushes and the end of whoever held it: figures of the true motion.
#include <functional>

#include "mission/arm_motion.h"
#include "mission/arm_wire.h"

namespace drover::mission {
namespace {

using Series = std::vector<std::pair<Time, double>>;

/// What the true motion says from `begin` to `end`.
Series truth(const Record& log, Time begin, Time end,
             const std::function<double(const TruthLine&)>& value) {
  Series found;
  for (const TruthLine& line : log.truth)
    if (line.time >= begin && line.time <= end) found.emplace_back(line.time, value(line));
  return found;
}
Series places(const Record& log, std::size_t joint, Time begin, Time end) {
  return truth(log, begin, end, [joint](const auto& line) { return line.arm_rad.at(joint); });
}
Series torques(const Record& log, std::size_t joint, Time begin, Time end) {
  return truth(log, begin, end, [joint](const auto& line) { return line.arm_Nm.at(joint); });
}
/// Over two lines each.
Series speeds(const Record& log, std::size_t joint, Time begin, Time end) {
  const Series at = places(log, joint, begin, end);
  Series found;
  for (std::size_t i = 2; i < at.size(); ++i)
    found.emplace_back(at[i - 1].first,
                       (at[i].second - at[i - 2].second) / to_s(at[i].first - at[i - 2].first));
  return found;
}
Series told(const Record& log, std::size_t joint, Time begin, Time end,
            double damiao::SetPoint::*value) {
  Series found;
  for (const ArmSetPoint& one : arm_set_points(log, joint, begin, end))
    found.emplace_back(one.time, one.told.*value);
  return found;
}

/// A step that was asked for at `begin`.
struct Step {
  Duration settled{};  ///< then the rest is within a twentieth of it
  Duration half{};     ///< then half of it is made
  double overshoot = 0;
};
Step step_of(const Series& series, Time begin) {
  const double from = series.front().second;
  const double to = series.back().second;
  const double size = to - from;
  Step step;
  for (const auto& [time, value] : series) {
    const double share = (value - from) / size;
    if (std::abs(share - 1) > 0.05) step.settled = time - begin;
    if (step.half == Duration{} && share >= 0.5) step.half = time - begin;
    step.overshoot = std::max(step.overshoot, share - 1);
  }
  return step;
}

/// Tells of it, and of its lag behind what its motor was told.
Step tell_step(const std::string& what, const Series& made, const Series& set_point, Time begin) {
  const Step step = step_of(made, begin);
  figure((what + " settles in").c_str(), step.settled);
  figure((what + " lags behind its set point").c_str(), step.half - step_of(set_point, begin).half);
  figure((what + " goes beyond by").c_str(), 100 * step.overshoot, "%");
  return step;
}

// 0.5 rad/s at 5 rad/s2 take 0.1 s; the base's joint, loose in 80 Nm/rad and 3 Nms/rad, swings.
TEST(ArmSteps, AVelocityIsFollowed) {
  const Record& log = record("arm_steps");
  for (const char* name : {"event steps#1", "event back#1"}) {
    SCOPED_TRACE(name);
    const Time begin = log.event(name);
    const Time end = begin + 2400ms;
    const Series made = speeds(log, kBaseYaw, begin, end);
    const Step step =
        tell_step("a velocity", made,
                  told(log, kBaseYaw, begin, end, &damiao::SetPoint::velocity_radps), begin);
    EXPECT_LT(step.settled, 500ms);
    EXPECT_LT(step.overshoot, 0.35);
    EXPECT_NEAR(made.back().second, begin == log.event("event steps#1") ? 0.5 : 0, 0.01);
  }
}

// 0.5 rad at 1 rad/s and 5 rad/s2 take 0.7 s.
TEST(ArmSteps, APositionIsFollowed) {
  const Record& log = record("arm_steps");
  for (const char* name : {"event steps#1", "event back#1"}) {
    SCOPED_TRACE(name);
    const Time begin = log.event(name);
    const Time end = begin + 2400ms;
    const Series made = places(log, kShoulder, begin, end);
    const Series set_point = told(log, kShoulder, begin, end, &damiao::SetPoint::position_rad);
    const Step step = tell_step("a position", made, set_point, begin);
    EXPECT_LT(step.settled, 750ms);
    EXPECT_LT(step.overshoot, 0.05);
    // It sags by its weight over 150 Nm/rad.
    EXPECT_NEAR(made.back().second, begin == log.event("event steps#1") ? 0.7 : 0.2, 0.03);
    EXPECT_NEAR(set_point.back().second, begin == log.event("event steps#1") ? 0.7 : 0.2, 0.001);
  }
}

// 8 Nm come up in half a second, so 3 Nm in 0.19 s.
TEST(ArmSteps, AnEffortIsFollowed) {
  const Record& log = record("arm_steps");
  for (const char* name : {"event steps#1", "event back#1"}) {
    SCOPED_TRACE(name);
    const Time begin = log.event(name);
    const Time end = begin + 2400ms;
    const Series made = torques(log, kElbow, begin, end);
    const Step step = tell_step("an effort", made,
                                told(log, kElbow, begin, end, &damiao::SetPoint::torque_Nm), begin);
    EXPECT_GT(step.settled, 150ms) << "it came at once";
    EXPECT_LT(step.settled, 230ms);
    EXPECT_LT(step.overshoot, 0.05);
    EXPECT_NEAR(made.back().second, begin == log.event("event steps#1") ? -3 : 0, 0.02);
    for (const ArmSetPoint& one : arm_set_points(log, kElbow, begin, end))
      EXPECT_EQ(one.told.stiffness, 0);
  }
}

// 5 N aside at 0.6 m against 80 Nm/rad.
TEST(ArmPush, TheBasesJointGivesAsItsStiffnessSays) {
  const Record& log = record("arm_push");
  const Time pushed = log.event("event aside#1");
  const double gave = arm_at(log, kBaseYaw, pushed + 1900ms) - arm_at(log, kBaseYaw, pushed - 10ms);
  figure("base_yaw gave", gave, "rad");
  EXPECT_NEAR(gave, 5 * 0.6 / 80, 0.1 * 5 * 0.6 / 80);
  EXPECT_LT(strayed(log, kShoulder, pushed - 10ms, pushed + 3s), 0.001);
}

/// Of the gears of a DM4340 in field_arm.xml: what rubs, and what grows with the speed.
constexpr double kRubs_Nm = 0.15;
constexpr double kGears_Nmsprad = 0.02;
constexpr double kCommanded_Nmsprad = 4;

/// A joint without stiffness turns as fast as what pushes it divided by its damping, when it has
/// come to that.
void expect_damped(const Record& log, std::size_t joint, Time pushed, double lever_Nm) {
  const Series all = speeds(log, joint, pushed + 250ms, pushed + 300ms);
  double sum = 0;
  for (const auto& one : all) sum += std::abs(one.second);
  const double turned_radps = sum / static_cast<double>(all.size());
  const double damping = (lever_Nm - kRubs_Nm) / turned_radps - kGears_Nmsprad;
  figure(joint == kBaseYaw ? "base_yaw's damping" : "the shoulder's damping", damping, "Nms/rad");
  EXPECT_NEAR(damping, kCommanded_Nmsprad, 0.1 * kCommanded_Nmsprad);
  const auto set_points = arm_set_points(log, joint, pushed, pushed + 300ms);
  ASSERT_FALSE(set_points.empty());
  EXPECT_EQ(set_points.front().told.stiffness, 0);
  EXPECT_NEAR(set_points.front().told.damping, kCommanded_Nmsprad, 0.002);
}

TEST(ArmPush, BothJointsGiveAsTheirDampingSays) {
  const Record& log = record("arm_push");
  const Time turned = log.event("event turned#1");
  const Time in_it = turned + 275ms;
  expect_damped(log, kBaseYaw, turned, 5 * 0.6 * std::cos(arm_at(log, kBaseYaw, in_it)));
  const Time lowered = log.event("event lowered#1");
  const double shoulder = arm_at(log, kShoulder, lowered + 275ms);
  const double elbow = arm_at(log, kElbow, lowered + 275ms);
  expect_damped(log, kShoulder, lowered,
                4 * (0.3 * std::cos(shoulder) + 0.3 * std::cos(shoulder + elbow)));
}

TEST(ArmPush, IsAtRestWhenThePushIsOver) {
  const Record& log = record("arm_push");
  EXPECT_LT(strayed(log, kBaseYaw, log.event("event turned#1") + 700ms, log.event("the end")),
            0.001);
  EXPECT_LT(strayed(log, kShoulder, log.event("event lowered#1") + 700ms, log.event("the end")),
            0.005);
}

/// From where it was held, level with 57 degrees, with an elbow of 23.
double sank_rad(const Record& log, Time begin, Duration after) {
  return arm_at(log, kShoulder, begin - 10ms) - arm_at(log, kShoulder, begin + after);
}
void tell_sinking(const Record& log, const char* how, Time begin) {
  EXPECT_NEAR(arm_at(log, kShoulder, begin - 10ms), 0.987, 0.005) << "another height";
  EXPECT_NEAR(arm_at(log, kElbow, begin - 10ms), 0.398, 0.005);
  for (const auto& [after, word] :
       {std::pair{200ms, "0.2 s"}, std::pair{500ms, "0.5 s"}, std::pair{1000ms, "1.0 s"}})
    figure((std::string(how) + ": sank in " + word).c_str(), sank_rad(log, begin, after), "rad");
}

// 1.9 Nm over 4.9 Nms/rad are 0.4 rad/s, which grow with the lever.
TEST(ArmSinks, SlowlyWhileTheGuardDampsIt) {
  const Record& log = record("arm_sinks");
  const Time killed = log.event("event killed#1");
  tell_sinking(log, "damped", killed);
  EXPECT_NEAR(sank_rad(log, killed, 200ms), 0.07, 0.03);
  EXPECT_NEAR(sank_rad(log, killed, 1s), 0.45, 0.05);
  EXPECT_THAT(check_arm_only_damped(log, killed + 20ms, log.event("event restarted#1")),
              testing::IsEmpty());
}

TEST(ArmSinks, AtOnceWhenItsMotorsLetGo) {
  const Record& log = record("arm_sinks");
  const Time both = log.event("event both#1");
  tell_sinking(log, "limp", both);
  EXPECT_LT(sank_rad(log, both, 90ms), 0.005);  // their time-out is 100 ms
  EXPECT_GT(sank_rad(log, both, 500ms), 0.6);
  EXPECT_NEAR(arm_at(log, kShoulder, both + 1s), -0.6, 0.03);
}

// What accepts no_watchdog gets.
TEST(ArmHolds, WithoutATimeOutItsLastCommandStands) {
  const Record& log = record("arm_holds");
  const Time both = log.event("event both#1");
  tell_sinking(log, "held", both);
  EXPECT_EQ(arm_set_points(log, kShoulder, both + 50ms).size(), 0U) << "somebody speaks to it";
  figure("held: sank in 9.9 s", sank_rad(log, both, 9900ms), "rad");
  for (std::size_t joint = 0; joint < damiao::kMotors; ++joint)
    EXPECT_LT(strayed(log, joint, both - 10ms, both + 9900ms), 0.002) << joint;
}

}  // namespace
}  // namespace drover::mission
