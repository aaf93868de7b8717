// A chassis of AgileX that takes a twist, with an inertial sensor on its bus.
#include <algorithm>
#include <cstdint>

#include "mission/support.h"

namespace drover::mission {
namespace {

TEST(AgilexV2, IsDrivenToSuccessCloseToTheTrack) {
  expect_drive_on_a_chassis("agilex_v2");
}

/// 0x111: v in mm/s and w in mrad/s, both big-endian, then zeros; 0x421: CAN mode, or standby.
TEST(AgilexV2, HearsTwistsAndItsModeAndStandsBeforeAndAfterTheTask) {
  const Record& log = record("agilex_v2");
  const Time begin = log.answered("start_task_success");
  const Time end = log.first_status("NAV_SUCCESS").time + 200ms;
  std::size_t told = 0;
  for (const CanLine& line : log.can) {
    const auto& data = line.frame.data;
    if (line.frame.id == 0x421) {
      ASSERT_EQ(line.frame.len, 1);
      ASSERT_LE(data[0], 1);
    }
    if (line.frame.id != 0x111) continue;
    ++told;
    ASSERT_EQ(line.frame.len, 8);
    ASSERT_EQ(data[4] | data[5] | data[6] | data[7], 0);
    const bool moves = (data[0] | data[1] | data[2] | data[3]) != 0;
    EXPECT_TRUE(!moves || (line.time > begin - 100ms && line.time < end)) << seconds(line.time);
  }
  EXPECT_GT(told, 1000U);
}

/// What its chassis is told on CAN: v in mm/s and w in mrad/s.
struct Twist {
  Time time = kNever;
  int v_mmps = 0;
  int w_mradps = 0;
};
std::vector<Twist> twists(const Record& log) {
  std::vector<Twist> found;
  const auto number = [](const CanFrame& frame, std::size_t at) {
    return static_cast<std::int16_t>(frame.data[at] << 8U | frame.data[at + 1]);
  };
  for (const CanLine& line : log.can)
    if (line.frame.id == 0x111)
      found.push_back({line.time, number(line.frame, 0), number(line.frame, 2)});
  return found;
}

bool hears_imu(const Status& status) {
  return status.document.at("sensor").at("imu").get<bool>();
}

/// Accelerations, rates and attitude, a hundred times a second, beside the chassis' own frames.
TEST(AgilexV2, HearsItsInertialSensorOnTheBusOfItsChassis) {
  const Record& log = record("agilex_v2");
  const Time begin = log.answered("start_nav_success");
  const Time end = log.first_status("NAV_SUCCESS").time;
  for (const auto& status : log.statuses)
    if (status.time >= begin) {
      ASSERT_TRUE(hears_imu(status)) << seconds(status.time);
    }
  for (const std::uint32_t id : {0x0CFF3408U, 0x0CFF3708U, 0x0CFF4608U}) {
    const auto told = std::count_if(log.can.begin(), log.can.end(), [&](const CanLine& line) {
      return line.frame.extended && line.frame.id == id && line.time > begin && line.time <= end;
    });
    EXPECT_NEAR(static_cast<double>(told), 100 * to_s(end - begin), 2) << std::hex << id;
  }
}

/// Only its motors hold it: where nobody knows how steep the ground is, it may not go on.
TEST(AgilexV2ImuSilent, EndsInARampAndSaysThatNobodyKnowsHowSteepTheGroundIs) {
  const Record& log = record("agilex_v2_imu_silent");
  const Time silent = log.event("sim imu silent");
  const auto told = std::find_if(
      log.statuses.begin(), log.statuses.end(),
      [&](const Status& status) { return status.time > silent && !hears_imu(status); });
  ASSERT_NE(told, log.statuses.end());
  figure("told after the sensor fell silent", told->time - silent);
  EXPECT_LT(told->time - silent, 500ms);
  const auto& error = log.first_status("NAV_ERROR", silent);
  figure("from its silence to the end of the task", error.time - silent);
  EXPECT_GT(error.time - silent, 1s);
  EXPECT_LT(error.time - silent, 1400ms);
  EXPECT_THAT(error.why, testing::HasSubstr("nobody knows how steep the ground is"));
  EXPECT_THAT(log.feedback_words(), testing::Contains("start_task_failse"));
  const Time again = next_start(log, error.time);
  tell_way_to_rest(log, silent, again);
  EXPECT_LT(roll(log, silent, again).rest - silent, 2s);
  EXPECT_LT(roll(log, silent, again).way_m, 0.7);
  // 0.8 m/s2 from message to message: the ramp of a stop that is not an emergency's.
  constexpr int kStep_mmps = 5;
  Twist last;
  for (const Twist& twist : twists(log)) {
    if (twist.time > silent && twist.time < again - 100ms) {
      EXPECT_LE(std::abs(twist.v_mmps - last.v_mmps), kStep_mmps) << seconds(twist.time);
    }
    if (twist.time > silent + 2s && twist.time < again - 100ms) {
      EXPECT_EQ(twist.v_mmps | twist.w_mradps, 0) << seconds(twist.time);
    }
    last = twist;
  }
}

TEST(AgilexV2ImuSilent, RefusesAStartUntilTheSensorIsHeardAndReachesTheGoalThen) {
  const Record& log = record("agilex_v2_imu_silent");
  auto words = kStarted;
  words.insert(words.end(), {"start_task_failse", "start_task_success", "start_nav_success"});
  EXPECT_EQ(log.feedback_words(), words);
  const Time start = next_start(log, log.event("sim imu well"));
  const auto& success = log.first_status("NAV_SUCCESS", start);
  EXPECT_LT(drive_figures(log, start, success.time).goal_m, 0.10);
  EXPECT_EQ(log.statuses.back().nav, "NAV_SUCCESS");
}

/// A second without it is allowed.
TEST(AgilexV2ImuSilent, DrivesOnWhileTheCableIsLooseForAMoment) {
  const Record& log = record("agilex_v2_imu_silent");
  const Time loose = log.event("sim imu unplug");
  const Time tight = log.event("sim imu plug");
  const Time success = log.first_status("NAV_SUCCESS", tight).time;
  expect_nav_stays(log, "NAV_RUN", loose, success - 1ms);
  bool told = false;
  for (const auto& status : log.statuses) {
    told = told || (status.time > loose && status.time < tight && !hears_imu(status));
    if (status.time > tight + 500ms) {
      EXPECT_TRUE(hears_imu(status)) << seconds(status.time);
    }
  }
  EXPECT_TRUE(told);
}

TEST(AgilexV2ImuSilent, TellsWhatEveryMissionTells) {
  const Record& log = record("agilex_v2_imu_silent");
  EXPECT_LE(pose_figures(log, kNever, Time::max()).max_m, 0.30);
  EXPECT_THAT(check_form(log), testing::IsEmpty());
  EXPECT_THAT(check_rate(log), testing::IsEmpty());
  EXPECT_THAT(check_pose(log), testing::IsEmpty());
}

}  // namespace
}  // namespace drover::mission
