// Missions in which inertial sensor, battery or receiver fail: what is told, and that it goes on.
#include <algorithm>
#include <cmath>

#include "mission/support.h"

namespace drover::mission {
namespace {

bool imu(const Status& status) {
  return status.document.at("sensor").at("imu").get<bool>();
}
bool battery(const Status& status) {
  const auto& bms = status.document.at("bms");
  const bool valid = bms.at("valid").get<bool>();
  EXPECT_EQ(valid, bms.at("error").get<int>() == 0) << "at " << seconds(status.time);
  return valid;
}

/// The first status from `begin` on for which `is` holds; the end of time when there is none.
template <typename Is>
Time first(const Record& log, Time begin, const Is& is) {
  for (const auto& status : log.statuses)
    if (status.time >= begin && is(status)) return status.time;
  return Time::max();
}
const Status& status_at(const Record& log, Time time) {
  const Status* last = &log.statuses.front();
  for (const auto& status : log.statuses)
    if (status.time <= time) last = &status;
  return *last;
}

void expect_success_without_another_start(const Record& log) {
  EXPECT_EQ(log.feedback_words(), kStarted);
  EXPECT_EQ(log.statuses.back().nav, "NAV_SUCCESS");
  const Time begin = log.answered("start_nav_success");
  const auto figures = drive_figures(log, begin, log.first_status("NAV_SUCCESS", begin).time);
  EXPECT_LT(figures.goal_m, 0.10);
  EXPECT_LT(figures.rms_m, 0.10);
}

/// Set points go to each wheel each control cycle, whatever another device does: the longest time
/// between two of them.
Duration longest_silence(const Record& log, Time begin, Time end) {
  Duration longest{};
  Time last = begin;
  for (const auto& one : log.sent) {
    if (one.wheel.node != kFirstNode || one.time < begin || one.time > end) continue;
    longest = std::max(longest, one.time - last);
    last = one.time;
  }
  return std::max(longest, end - last);
}

TEST(ImuFaults, AreToldAndDrivenThrough) {
  const Record& log = record("imu_faults");
  const Time pulled = log.event("sim imu unplug");
  const Time back = log.event("sim imu plug");
  ASSERT_TRUE(imu(status_at(log, pulled)));
  EXPECT_LT(first(log, pulled, [](const Status& s) { return !imu(s); }) - pulled, 500ms);
  const auto& gone = status_at(log, back - 1s);
  EXPECT_NE(gone.why.find("IMU"), std::string::npos) << gone.why;
  EXPECT_LT(first(log, back, imu) - back, 2s) << "it was not heard again";
  const Time frozen = log.event("sim imu frozen");
  EXPECT_LT(first(log, frozen, [](const Status& s) { return !imu(s); }) - frozen, 1500ms);
  expect_success_without_another_start(log);
}

TEST(BatteryFaults, MarkTheValuesAsUnknownAndTouchNothingElse) {
  const Record& log = record("battery_faults");
  ASSERT_TRUE(battery(status_at(log, log.event("sim battery silent"))));
  std::size_t n = 0;
  for (const char* fault : {"silent", "drip", "wrong_crc", "other_unit", "slow"}) {
    const Time begin = log.event(std::string("sim battery ") + fault);
    const Time well = log.event("sim battery well", ++n);
    ASSERT_LT(begin, well);
    ASSERT_TRUE(battery(status_at(log, begin))) << fault;
    const Time unknown = first(log, begin, [](const Status& s) { return !battery(s); });
    ASSERT_LT(unknown, well) << fault << " was never told";
    const Time good = first(log, well, battery);
    ASSERT_NE(good, Time::max()) << fault << " was never over";
    std::printf("  %s: unknown after %s, good again after %s\n", fault,
                seconds(unknown - begin).c_str(), seconds(good - well).c_str());
    // health.battery_stale_s, and the second between two questions
    EXPECT_LE(unknown - begin, 6s) << fault;
    // The driver waits for late answers, 4 s at most, before it asks again.
    EXPECT_LE(good - well, 4s) << fault;
    for (const auto& status : log.statuses) {
      if (status.time < unknown || status.time > well) continue;
      EXPECT_FALSE(battery(status)) << fault << ": believed at " << seconds(status.time);
      EXPECT_THAT(status.why, testing::HasSubstr("battery unknown")) << seconds(status.time);
    }
  }
  // Whatever comes of a line that lies, no value on it changes by more than driving does.
  double last_percent = NAN;
  for (const auto& status : log.statuses) {
    const double percent = status.document.at("bms").at("soc").get<double>();
    if (percent == 0 && std::isnan(last_percent)) continue;  // not heard yet
    if (!std::isnan(last_percent)) {
      EXPECT_NEAR(percent, last_percent, 1) << seconds(status.time);
    }
    last_percent = percent;
  }
  const Time begin = log.answered("start_nav_success");
  const Time end = log.first_status("NAV_SUCCESS", begin).time;
  EXPECT_LE(longest_silence(log, begin, end - 200ms), 10ms) << "the control tick waited";
  expect_success_without_another_start(log);
}

TEST(BatteryEmpty, EndsTheTaskInARampAndRefusesAStartWhileItCharges) {
  const Record& log = record("battery_empty");
  const Time empty = log.event("sim battery soc 2");
  const auto& error = log.first_status("NAV_ERROR", empty);
  EXPECT_LT(error.time - empty, 30s);
  EXPECT_NE(error.why.find("battery"), std::string::npos) << error.why;
  EXPECT_THAT(log.moving(error.time + 1500ms, Time::max()), testing::IsEmpty());
  ASSERT_EQ(log.feedback_words().back(), "start_task_failse");
  EXPECT_EQ(log.feedback.back().reason, "charging: unplug the charger first");
}

/// Its pack does not tell of a charger: the current does, which flows for a second then.
TEST(ChargerPlugged, ASecondAndAHalfBeforeAStartIsSeenByItsCurrent) {
  const Record& log = record("charger_plugged");
  const Time refused = log.event("event too_soon#1");
  EXPECT_LT(refused - log.event("sim battery charger plug"), 2s);
  auto words = std::vector<std::string>{"save_trajectory_success", "start_task_failse"};
  ASSERT_EQ(log.feedback_words(), words);
  EXPECT_EQ(log.feedback.back().reason, "charging: unplug the charger first");
  EXPECT_THAT(log.moving(), testing::IsEmpty());
}

TEST(BatteryLow, LetsTheTaskReachItsGoalAndNoOtherStart) {
  const Record& log = record("battery_low");
  const Time low = log.event("sim battery soc 15");
  const auto told = [](const Status& s) {
    return s.why.find("battery low: 15 %") != std::string::npos;
  };
  const Time known = first(log, low, told);
  // health.battery_hold_s
  EXPECT_GT(known - low, 19s);
  EXPECT_LT(known - low, 22s);
  const Time begin = log.answered("start_nav_success");
  const Time success = log.first_status("NAV_SUCCESS", begin).time;
  EXPECT_GT(success - known, 1s) << "it was told too late to show that the task goes on";
  expect_nav_stays(log, "NAV_RUN", begin, success - 1ms);
  expect_nav_stays(log, "NAV_SUCCESS", success);
  EXPECT_LT(drive_figures(log, begin, success).goal_m, 0.10);
  auto words = kStarted;
  words.push_back("start_task_failse");
  EXPECT_EQ(log.feedback_words(), words);
  EXPECT_EQ(log.feedback.back().reason, "battery low: 15 %");
  EXPECT_THAT(log.moving(success, Time::max()), testing::IsEmpty());
}

TEST(OutageOnCurve, StaysWithinAShareOfTheWay) {
  const Record& log = record("outage_on_curve");
  const Time begin = log.event("sim gnss none");
  const Time end = log.event("sim gnss fix");
  double worst_m = 0;
  double way_m = 0;
  Time last = kNever;
  for (const auto& status : log.statuses) {
    if (status.time < begin || status.time > end) continue;
    const TruthLine truth = log.truth_at(status.time);
    worst_m = std::max(worst_m, std::hypot(status.sim.x_m - truth.x_m, status.sim.y_m - truth.y_m));
    if (last != kNever) way_m += std::abs(truth.vx_mps) * to_s(status.time - last);
    last = status.time;
  }
  std::printf("  30 s without a position on a curve: %.1f m driven, at most %.3f m off (%.2f %%)\n",
              way_m, worst_m, 100 * worst_m / way_m);
  EXPECT_GT(way_m, 5);
  EXPECT_LT(worst_m, 0.30);
  EXPECT_TRUE(status_at(log, end - 5s).document.at("nav").contains("metres_left"));
  EXPECT_EQ(log.feedback_words(), kStarted);
  EXPECT_EQ(log.statuses.back().nav, "NAV_SUCCESS");
}

TEST(HeadingFind, ShowsTheHeadingOnAShortSlowWayThatAPersonAskedFor) {
  const Record& log = record("heading_find");
  const Time asked = log.event("start drover heading find");
  const Time ready = log.event("event ready#1");
  const Time start = log.answered("start_task_success");
  EXPECT_EQ(log.all("end of drover with status 0").size(), 1U);
  EXPECT_THAT(log.moving(kNever, asked), testing::IsEmpty());
  EXPECT_THAT(log.moving(asked, ready), testing::Not(testing::IsEmpty()));
  const auto& located = log.first_status("LOCATE_TRUE");
  for (const auto& status : log.statuses) {
    if (status.time >= start) break;
    EXPECT_EQ(status.locate, status.time < located.time ? "LOCATE_UNINIT" : "LOCATE_TRUE");
    EXPECT_EQ(status.nav, "NAV_FREE") << seconds(status.time);
  }
  // navigate.find_heading_speed_mps and its distance
  for (const auto& line : log.truth)
    if (line.time <= ready) {
      EXPECT_LT(line.vx_mps, 0.22);
    }
  const auto from = log.truth_at(asked);
  const auto to = log.truth_at(ready);
  const double way_m = std::hypot(to.x_m - from.x_m, to.y_m - from.y_m);
  const double yaw_rad = located.document.at("pose").at("yaw").get<double>();
  const double error_deg = std::remainder(yaw_rad - to.yaw_rad, 2 * M_PI) * 180 / M_PI;
  std::printf("  heading found after %.2f m, %.2f degrees off\n", way_m, error_deg);
  EXPECT_LT(way_m, 1.5);
  EXPECT_LT(std::abs(error_deg), 5) << "estimate.bound_yaw_deg";
  expect_success_without_another_start(log);
}

bool fixed(const Status& status) {
  return status.document.at("rtk").at("status").get<int>() == 4;
}

TEST(ReceiverRenamed, IsHeardAgainUnderEachNameByTheSameProcess) {
  const Record& log = record("receiver_renamed");
  const std::string told = said(log, "drover-sim.log");
  EXPECT_THAT(told, testing::HasSubstr("unplugged from /dev/ttyACM0\nunplugged from /dev/ttyACM1"));
  EXPECT_EQ(log.all("start droverd").size(), 1U);
  for (const std::size_t n : {1U, 2U}) {
    const Time pulled = log.event("sim gnss unplug", n);
    const Time back = log.event("sim gnss plug", n);
    const auto missing = [](const Status& s) { return !fixed(s); };
    EXPECT_LT(first(log, pulled, missing) - pulled, 600ms);
    const Duration heard = first(log, back, fixed) - back;
    std::printf("  heard %s after it was plugged in\n", seconds(heard).c_str());
    // The kernel takes 0.5 s to find it, and the pause before the next attempt is 0.5 s at most.
    EXPECT_LT(heard, 1500ms);
  }
  const Time begin = log.answered("start_nav_success");
  expect_nav_stays(log, "NAV_RUN", begin, log.first_status("NAV_SUCCESS", begin).time - 1ms);
  expect_success_without_another_start(log);
}

TEST(ReceiverReplugged, IsHeardAgainWithinASecond) {
  const Record& log = record("receiver_replugged");
  const Time pulled = log.event("sim gnss unplug");
  const Time back = log.event("sim gnss plug");
  EXPECT_LT(first(log, pulled, [](const Status& s) { return !fixed(s); }) - pulled, 600ms);
  EXPECT_LT(first(log, back, fixed) - back, 1500ms);
  expect_success_without_another_start(log);
}

}  // namespace
}  // namespace drover::mission
