// Missions that wait and go on by themselves: lost localisation, an obstacle.
#include <fstream>

#include "mission/support.h"

namespace drover::mission {
namespace {

// navigate.resume_after_s, and what lies between the cause and its message.
constexpr Duration kResume = 1s;
constexpr Duration kMessage = 120ms;
// A controlled stop from 0.5 m/s at 0.8 m/s^2 with its jerk, and the time to notice.
constexpr Duration kStop = 1200ms;

struct Pause {
  Time begin = kNever;  ///< first status that tells its cause
  Time end = kNever;    ///< first status that no longer does
};

template <typename Cause>
std::vector<Pause> pauses(const Record& log, Time begin, Time end, const Cause& cause) {
  std::vector<Pause> found;
  bool before = false;
  for (const auto& status : log.statuses) {
    if (status.time < begin || status.time > end) continue;
    const bool now = cause(status);
    if (now && !before) found.push_back({status.time, end});
    if (!now && before) found.back().end = status.time;
    before = now;
  }
  return found;
}

bool lost(const Status& status) {
  return status.locate != "LOCATE_TRUE";
}

void expect_rest_in(const Record& log, const Pause& pause) {
  // It may have ended just after the message before the one that tells so.
  EXPECT_THAT(log.moving(pause.begin + kStop, pause.end - kMessage), testing::IsEmpty());
}

void expect_waits_after(const Record& log, const Pause& pause) {
  EXPECT_THAT(log.moving(pause.end - kMessage, pause.end + kResume - kMessage), testing::IsEmpty());
  EXPECT_FALSE(log.moving(pause.end, pause.end + kResume + 500ms).empty())
      << "it did not go on by itself after " << seconds(pause.end);
}

std::vector<Pause> losses(const Record& log) {
  const Time begin = log.answered("start_nav_success");
  return pauses(log, begin, log.first_status("NAV_SUCCESS", begin).time, lost);
}

void expect_one_run_to_the_goal(const Record& log) {
  EXPECT_EQ(log.feedback_words(), kStarted);
  const Time begin = log.answered("start_nav_success");
  const Time end = log.first_status("NAV_SUCCESS", begin).time;
  expect_nav_stays(log, "NAV_RUN", begin, end - 1ms);
  EXPECT_EQ(log.statuses.back().nav, "NAV_SUCCESS");
  EXPECT_LT(drive_figures(log, begin, end).goal_m, 0.10);
}

TEST(GnssOutage, EndsWithSuccessWithoutAnotherStart) {
  expect_one_run_to_the_goal(record("gnss_outage"));
}

TEST(GnssOutage, PausesWhileItDoesNotKnowWhereItIs) {
  const Record& log = record("gnss_outage");
  const auto found = losses(log);
  ASSERT_FALSE(found.empty()) << "localisation was never lost";
  for (const auto& pause : found) {
    expect_rest_in(log, pause);
    expect_waits_after(log, pause);
  }
}

TEST(FixFloatFix, NeverMovesOnAPositionThatIsWorseThanItSays) {
  // Where it stands while it is lost proves nothing; where it drives, EveryMission looks.
  const Record& log = record("fix_float_fix");
  for (const auto& pause : losses(log)) expect_rest_in(log, pause);
}

TEST(FixFloatFix, SeesTheReceiverGoThroughFloat) {
  const Record& log = record("fix_float_fix");
  std::vector<int> seen;
  for (const auto& status : log.statuses) {
    const int rtk = status.document.at("rtk").at("status").get<int>();
    if (status.locate != "LOCATE_UNINIT" && (seen.empty() || seen.back() != rtk))
      seen.push_back(rtk);
  }
  EXPECT_EQ(seen, (std::vector<int>{4, 5, 4}));
}

TEST(FixFloatFix, EndsWithSuccessWithoutAnotherStart) {
  expect_one_run_to_the_goal(record("fix_float_fix"));
}

bool blocked(const Status& status) {
  return status.obstacle;
}

std::vector<Pause> obstacles(const Record& log) {
  const Time begin = log.answered("start_nav_success");
  return pauses(log, begin, log.first_status("NAV_SUCCESS", begin).time, blocked);
}

TEST(Obstacle, StopsTheRobotWithoutEndingTheTask) {
  const Record& log = record("obstacle");
  const auto found = obstacles(log);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_GT(found[0].end - found[0].begin, kStop) << "too short to prove anything";
  expect_rest_in(log, found[0]);
  expect_nav_stays(log, "NAV_RUN", found[0].begin, found[0].end);
  constexpr double kNear_m = 0.6;  // the robot's zones.near_m
  const auto entered = std::find_if(log.truth.begin(), log.truth.end(), [](const TruthLine& line) {
    return line.free_ahead_m < kNear_m;
  });
  ASSERT_NE(entered, log.truth.end());
  EXPECT_LE(found[0].begin - entered->time, kMessage + 20ms);
}

TEST(Obstacle, LetsItGoOnByItselfOneSecondAfterItLeft) {
  // obstacle stays true until the pause ends, a second after the contact opened.
  const Record& log = record("obstacle");
  const auto found = obstacles(log);
  ASSERT_EQ(found.size(), 1U);
  std::vector<EventLine> gone;
  for (const auto& event : log.events)
    if (event.text.starts_with("sim obstacle ") && event.text.ends_with(" remove"))
      gone.push_back(event);
  ASSERT_FALSE(gone.empty());
  const Time left = gone.back().time;
  EXPECT_THAT(log.moving(left, left + kResume), testing::IsEmpty());
  EXPECT_FALSE(log.moving(left + kResume, left + kResume + 500ms).empty());
  EXPECT_EQ(log.feedback_words(), kStarted);
  expect_good_drive(log);
}

TEST(Obstacle, IsNeverTouched) {
  const Record& log = record("obstacle");
  double nearest_m = INFINITY;
  for (const auto& line : log.truth) nearest_m = std::min(nearest_m, line.free_ahead_m);
  std::printf("  nearest: %.3f m ahead of the bumper\n", nearest_m);
  EXPECT_GT(nearest_m, 0.0);
  // Before a line was read for the first time it counts as touched.
  const Time begin = log.answered("start_task_success");
  for (const auto& status : log.statuses)
    if (status.time > begin) {
      EXPECT_EQ(status.document.at("robot").at("robot_status").get<int>() & 16, 0) << "bumper";
    }
}

/// What `drover report` says of the mission is what its logs show.
TEST(Obstacle, IsInTheReportOfItsTask) {
  const Record& log = record("obstacle");
  std::ifstream file(log.folder / "drover.log");
  const auto answer = nlohmann::json::parse(file, nullptr, false);
  ASSERT_TRUE(answer.is_object() && answer.at("ok").get<bool>()) << "what drover said: " << answer;
  const auto& report = answer.at("report");
  EXPECT_EQ(report.at("track"), "obstacle");
  EXPECT_EQ(report.at("result"), "success");
  const auto& status = log.first_status("NAV_SUCCESS");
  const Time begin = log.answered("start_nav_success");
  EXPECT_NEAR(report.at("time_s").get<double>(), to_s(status.time - begin), 0.5);
  const auto figures = drive_figures(log, begin, status.time);
  const double way_m = report.at("way_m").get<double>();
  EXPECT_NEAR(way_m, figures.distance_m, 0.02 * figures.distance_m);
  const auto& beside = report.at("cross_track");
  figure("cross-track by the report", beside.at("rms_m").get<double>(), "m");
  EXPECT_GT(beside.at("rms_m").get<double>(), 0);
  EXPECT_NEAR(beside.at("rms_m").get<double>(), figures.rms_m, 0.015)
      << "the report goes by the robot's own estimate";
  EXPECT_GE(beside.at("max_m").get<double>(), beside.at("p95_m").get<double>());
  ASSERT_EQ(report.at("pauses").size(), 1U);
  const auto& pause = report.at("pauses").front();
  const auto found = obstacles(log);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_NEAR(pause.at("lasted_s").get<double>(), to_s(found[0].end - found[0].begin), 0.3);
  EXPECT_THAT(pause.at("reason").get<std::string>(), testing::HasSubstr("zone"));
  double shares = 0;
  for (const auto& one : report.at("quality")) shares += one.at("share").get<double>();
  EXPECT_NEAR(shares, 1, 0.001);
  EXPECT_LT(report.at("error_bound").at("max_moving_m").get<double>(), 0.3);
  const auto& driven = answer.at("line").at("driven");
  EXPECT_GT(driven.size(), 0.5 * way_m / 0.1);
}

TEST(Obstacle, SlowsTheRobotInTheFarZone) {
  constexpr double kFar_m = 2.0;              // the robot's zones.far_m
  constexpr double kFarZoneSpeed_mps = 0.25;  // navigate.far_zone_speed_mps
  const Record& log = record("obstacle");
  Time entered = kNever;
  std::size_t looked = 0;
  for (const auto& line : log.truth) {
    if (line.free_ahead_m >= kFar_m) {
      entered = kNever;
      continue;
    }
    if (entered == kNever) entered = line.time;
    if (line.time - entered < kStop) continue;  // slowing down
    ++looked;
    EXPECT_LE(line.vx_mps, kFarZoneSpeed_mps + 0.02) << "at " << seconds(line.time);
  }
  EXPECT_GT(looked, 0U);
}

}  // namespace
}  // namespace drover::mission
