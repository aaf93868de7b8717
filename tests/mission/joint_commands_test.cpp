// Streams of joint commands: what moves while one lives, and what does not because of a bad one.
#include <algorithm>
#include <cmath>

#include "mission/robot.h"
#include "mission/support.h"

namespace drover::mission {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

constexpr double kAsked_radps = 2;
// From that at limits.deceleration_mps2, rounded up.
constexpr Duration kRamp = 413ms;
static_assert(kAsked_radps * kWheelRadius_m / kBrakes_mps2 <= 0.413);
// From a message to the frame: one cycle of 5 ms each for the broker, the gateway and the gate.
constexpr Duration kWay = 15ms;
constexpr double kAsked_turnps = kAsked_radps * kGear / (2 * M_PI);  // before the gear

struct JointCommands : testing::Test {
  const Record& log = record("joint_commands");

  Time step(const std::string& name) const { return log.event("event " + name + "#1"); }
  std::string journal() const { return said(log, "droverd.log"); }
  /// The last message of the stream that lives at `time`.
  Time last_of_stream(Time time) const {
    for (const auto& stream : streams(log.joint_commands))
      if (stream.begin <= time && stream.last >= time - kStreamTimeout) return stream.last;
    ADD_FAILURE() << "no stream lives at " << seconds(time);
    return time;
  }
  std::vector<Sent> sent(Time begin, Time end) const {
    std::vector<Sent> found;
    std::copy_if(log.sent.begin(), log.sent.end(), std::back_inserter(found),
                 [=](const Sent& one) { return one.time >= begin && one.time <= end; });
    return found;
  }
  void expect_steady(Time begin, Time end) const {
    const auto points = sent(begin, end);
    EXPECT_GT(points.size(), 50U);
    for (const auto& one : points)
      ASSERT_NEAR(std::abs(one.wheel.velocity_turnps), kAsked_turnps, 1e-3)
          << "at " << seconds(one.time);
  }
  /// It holds until the time-out, comes down at once then, and stays at rest until `end`.
  void expect_ramp_after(Time last, Time end) const {
    expect_steady(last - 500ms, last + kStreamTimeout - 5ms);
    const Time down = last + kStreamTimeout + kWay;
    for (const auto& one : sent(down, down + 20ms))
      ASSERT_LT(std::abs(one.wheel.velocity_turnps), kAsked_turnps) << seconds(one.time);
    const auto moved = log.moving(last, end);
    ASSERT_FALSE(moved.empty());
    std::printf("  last motion %s after the last message\n",
                seconds(moved.back().time - last).c_str());
    EXPECT_LE(moved.back().time, last + kStreamTimeout + kRamp + kWay);
    EXPECT_NEAR(log.truth_at(last + 1s).vx_mps, 0, 0.02);
  }
  std::size_t unsound(Time begin, Time end) const {
    return static_cast<std::size_t>(std::count_if(
        log.joint_commands.begin(), log.joint_commands.end(),
        [=](const auto& one) { return one.time >= begin && one.time <= end && !one.sound(); }));
  }
};

TEST_F(JointCommands, MoveTheBaseWhileTheyComeAndOnlyThen) {
  const Time begin = step("drive");
  EXPECT_THAT(log.moving(kNever, begin), IsEmpty());
  EXPECT_FALSE(log.moving(begin, begin + kWay).empty()) << "it does not follow";
  const Time last = last_of_stream(begin);
  EXPECT_GT(last, begin + 2900ms);
  expect_steady(begin + 1s, last);
  EXPECT_NEAR(log.truth_at(last).vx_mps, kAsked_radps * kWheelRadius_m, 0.03);
  EXPECT_GT(log.truth_at(last).x_m - log.truth_at(begin).x_m, 0.8);
  expect_ramp_after(last, step("begin_unknown"));
}

TEST_F(JointCommands, KeepTheirOwnerUntilTheyEnd) {
  std::size_t looked = 0;
  const Time begin = step("drive");
  const Time last = last_of_stream(begin);
  for (const auto& status : log.statuses) {
    if (status.time < begin + 100ms || status.time > last) continue;
    ++looked;
    EXPECT_EQ(status.document.at("nav").at("owner"), "joint_command") << seconds(status.time);
  }
  EXPECT_GT(looked, 25U);
  const auto& refusal =
      *std::find_if(log.feedback.begin(), log.feedback.end(),
                    [](const auto& one) { return one.cmd == "start_task_failse"; });
  EXPECT_GT(refusal.time, begin);
  EXPECT_LT(refusal.time, last);
  EXPECT_THAT(refusal.reason, HasSubstr("joint commands move the robot"));
  EXPECT_THAT(journal(),
              HasSubstr("joint commands ended: the stream of joint commands fell silent"));
}

TEST_F(JointCommands, WithAnUnknownJointMoveNothing) {
  const Time begin = step("begin_unknown");
  const Time end = step("begin_nan");
  EXPECT_GE(unsound(begin, end), 50U);
  EXPECT_THAT(log.moving(begin, end), IsEmpty());
  EXPECT_NEAR(log.truth_at(begin).x_m, log.truth_at(end).x_m, 0.005);
  EXPECT_THAT(journal(), HasSubstr("joint command refused: joint 'wing': there is no such joint"));
}

TEST_F(JointCommands, ThatTurnToNanEndAsIfTheyWereSilent) {
  const Time bad = step("nan");
  EXPECT_GE(unsound(bad, bad + 1s), 50U);
  expect_ramp_after(last_of_stream(bad), step("begin_array"));
  EXPECT_THAT(journal(), HasSubstr("joint command refused: joint 'rear_right': velocity is NaN"));
}

TEST_F(JointCommands, OfAimrt1xInJsonMoveTheBaseAsTheOthersDo) {
  const Time begin = step("drive_array");
  EXPECT_FALSE(log.moving(begin, begin + kWay).empty()) << "it does not follow";
  const Time last = last_of_stream(begin);
  EXPECT_GT(last, begin + 1900ms);
  expect_steady(begin + 1s, last);
  EXPECT_NEAR(log.truth_at(last).vx_mps, kAsked_radps * kWheelRadius_m, 0.03);
  expect_ramp_after(last, step("task"));
  for (const auto& line : log.mqtt)
    if (line.time > begin && line.time < last) {
      ASSERT_NE(line.topic, kJointCommandTopic);
    }
}

TEST_F(JointCommands, AreAnsweredUnderBothNamesOfTheStates) {
  std::vector<std::string> document;
  std::vector<std::string> array;
  for (const auto& line : log.mqtt) {
    if (line.topic.ends_with(".JointState")) document.push_back(line.payload);
    if (line.topic.ends_with(".JointStateArray")) array.push_back(line.payload);
  }
  ASSERT_GT(array.size(), 1000U);
  ASSERT_LE(document.size() - array.size(), 1U) << "the last one, when the gateway ends";
  for (std::size_t i = 0; i < array.size(); ++i)
    ASSERT_EQ(document[i], array[i]) << "the message " << i + 1;
}

TEST_F(JointCommands, BesideATaskChangeNothing) {
  const Time begin = step("begin_beside");
  const Time end = log.event("event commands_end#11");
  ASSERT_GT(end - begin, 2s);
  for (const auto& status : log.statuses)
    if (status.time >= begin && status.time <= end) {
      EXPECT_EQ(status.document.at("nav").at("owner"), "task") << seconds(status.time);
    }
  double usual_turnps[kLastNode + 1] = {};
  for (const auto& one : sent(begin - 100ms, begin))
    usual_turnps[one.wheel.node] = one.wheel.velocity_turnps;
  for (const auto& one : sent(begin, end + 1s)) {
    const double usual = usual_turnps[one.wheel.node];
    ASSERT_GT(std::abs(usual), kAsked_turnps);
    ASSERT_NEAR(one.wheel.velocity_turnps, usual, 0.1 * std::abs(usual)) << seconds(one.time);
  }
  expect_good_drive(log);
  EXPECT_THAT(journal(), HasSubstr("joint command refused: a task owns the drives"));
}

TEST(CancelUnderZeros, RampsDownOnceAndStays) {
  const Record& log = record("cancel_under_zeros");
  const Time stopped = log.event("event stopped#1");
  const double v_mps = log.truth_at(stopped).vx_mps;
  EXPECT_GT(v_mps, 0.7);
  // At 0.8 m/s^2, with what cycle and drives need.
  const Time still = stopped + from_s(v_mps / 0.8) + 250ms;
  figure("last motion after the cancel", log.moving(stopped, Time::max()).back().time - stopped);
  EXPECT_THAT(log.moving(still, Time::max()), testing::IsEmpty());
  const double after_mps = log.truth_at(stopped + 400ms).vx_mps;
  figure("0.4 s after the cancel", after_mps, "m/s");
  EXPECT_GT(after_mps, v_mps - 0.8 * 0.4 - 0.05) << "it is jerked to rest";
  for (const auto& line : log.truth) {
    if (line.time < still + 300ms) continue;
    ASSERT_LT(std::abs(line.vx_mps), 0.02) << seconds(line.time);
  }
}

}  // namespace
}  // namespace drover::mission
