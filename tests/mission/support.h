// Words that the tests of several missions share.
#pragma once

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <ostream>
#include <stdexcept>
#include <string>
#include <utility>

#include "mission/conduct.h"

namespace drover::mission {

using namespace std::chrono_literals;

/// How a test shows a set point that should not be there.
inline void PrintTo(const Sent& sent, std::ostream* out) {
  *out << seconds(sent.time) << " node " << int{sent.wheel.node} << " "
       << sent.wheel.velocity_turnps << " turn/s";
}

/// What a check measured, as tests/mission/series reads it.
inline void figure(const char* what, double value, const char* unit) {
  std::printf("  %s: %.4f %s\n", what, value, unit);
}
inline void figure(const char* what, Duration value) {
  figure(what, to_s(value), "s");
}

/// All that stands in a file of the mission's logs.
inline std::string said(const Record& log, const char* file) {
  std::ifstream stream(log.folder / file);
  if (!stream) throw std::runtime_error((log.folder / file).string() + " is missing");
  return {std::istreambuf_iterator<char>(stream), {}};
}

/// How the robot rolled between two instants.
struct Roll {
  double way_m = 0;
  double fastest_mps = 0;
  Time rest = kNever;  ///< from then on it stood
};

inline Roll roll(const Record& log, Time begin, Time end) {
  Roll found;
  const auto from = log.truth_at(begin);
  found.rest = begin;
  for (const auto& line : log.truth) {
    if (line.time < begin || line.time > end) continue;
    found.way_m = std::max(found.way_m, std::hypot(line.x_m - from.x_m, line.y_m - from.y_m));
    found.fastest_mps = std::max(found.fastest_mps, std::abs(line.vx_mps));
    if (std::abs(line.vx_mps) > 0.01) found.rest = line.time;
  }
  return found;
}

/// How far it rolled ahead after `begin`, and back from its farthest point, along its way.
inline std::pair<double, double> ahead_and_back_m(const Record& log, Time begin, Time end) {
  const auto from = log.truth_at(begin);
  double ahead_m = 0;
  double back_m = 0;
  for (const auto& line : log.truth) {
    if (line.time < begin || line.time > end) continue;
    const double along_m = (line.x_m - from.x_m) * std::cos(from.yaw_rad) +
                           (line.y_m - from.y_m) * std::sin(from.yaw_rad);
    const double way_m = std::copysign(std::hypot(along_m, line.z_m - from.z_m), along_m);
    ahead_m = std::max(ahead_m, way_m);
    back_m = std::max(back_m, ahead_m - way_m);
  }
  return {ahead_m, back_m};
}

/// Tells way and time to rest after what happened at `begin`, as far as `end`.
inline void tell_way_to_rest(const Record& log, Time begin, Time end) {
  const Roll found = roll(log, begin, end);
  figure("way to rest", found.way_m, "m");
  figure("time to rest", found.rest - begin);
}

/// The feedback of a task that starts as it should.
inline const std::vector<std::string> kStarted{"save_trajectory_success", "start_task_success",
                                               "start_nav_success"};

/// NAV_SUCCESS within 10 cm of the goal, and less than 5 cm beside the track.
inline void expect_good_drive(const Record& record, std::size_t task = 1) {
  const Time begin = record.answered("start_nav_success", task);
  const auto& success = record.first_status("NAV_SUCCESS", begin);
  const auto figures = drive_figures(record, begin, success.time);
  std::printf("  %.1f m in %s: cross-track RMS %.3f m, max %.3f m; %.3f m from the goal\n",
              figures.distance_m, seconds(success.time - begin).c_str(), figures.rms_m,
              figures.max_m, figures.goal_m);
  EXPECT_LT(figures.rms_m, 0.05);
  EXPECT_LT(figures.goal_m, 0.10);
  EXPECT_GT(figures.distance_m, 5.0);
  EXPECT_EQ(record.statuses.back().nav, "NAV_SUCCESS");
}

/// From `begin` on every status says `nav`, and there are some.
inline void expect_nav_stays(const Record& record, const std::string& nav, Time begin,
                             Time end = Time::max()) {
  std::size_t looked = 0;
  for (const auto& status : record.statuses) {
    if (status.time < begin || status.time > end) continue;
    ++looked;
    EXPECT_EQ(status.nav, nav) << "at " << seconds(status.time);
  }
  EXPECT_GT(looked, 0U) << "no status from " << seconds(begin) << " to " << seconds(end);
}

/// A base of kind twist drives its task to the end.
inline void expect_drive_on_a_chassis(const char* name) {
  const Record& log = record(name);
  EXPECT_EQ(log.feedback_words(), kStarted);
  expect_nav_stays(log, "NAV_RUN", log.answered("start_nav_success"),
                   log.first_status("NAV_SUCCESS").time - 1ms);
  expect_good_drive(log);
  const auto pose =
      pose_figures(log, log.answered("start_nav_success"), log.first_status("NAV_SUCCESS").time);
  figure("pose error at most", pose.max_m, "m");
  EXPECT_LE(pose.max_m, 0.30);
}

/// From a contact to the wheels.
inline constexpr Duration kEstop = 20ms;

/// The next accepted start after `time`, as its answer came; the end of time when there is none.
inline Time next_start(const Record& log, Time time) {
  for (const auto& one : log.feedback)
    if (one.time > time && one.cmd == "start_task_success") return one.time;
  return Time::max();
}

/// Between `begin` and the next start nothing moves; the operator's own message comes a little
/// before its answer.
inline void expect_rest_until_started(const Record& log, Time begin) {
  const Time start = next_start(log, begin);
  EXPECT_THAT(log.moving(begin, start == Time::max() ? start : start - kEstop), testing::IsEmpty());
}

inline bool moved_until(const Record& log, Time time) {
  return !log.moving(time - 100ms, time).empty();
}

/// droverd was killed on the ramp, and the guard held the robot there until the next one came.
inline void expect_held_on_the_ramp(const Record& log) {
  const Time killed = log.event("signal 9 to droverd");
  ASSERT_GT(log.truth_at(killed).z_m - log.truth.front().z_m, 0.1) << "it is not on the ramp";
  // It still rolls ahead when the kill comes.
  const auto [ahead_m, back_m] = ahead_and_back_m(log, killed, log.event("start droverd", 2));
  figure("rolled on", ahead_m, "m");
  figure("rolled back", back_m, "m");
  EXPECT_LE(back_m, 0.05);
  EXPECT_LE(ahead_m, 0.30);
}

/// The second start was accepted after `gone` ended, and it reached the goal.
inline void expect_new_start_succeeds(const Record& log, Time gone) {
  auto twice = kStarted;
  twice.insert(twice.end(), {"start_task_success", "start_nav_success"});
  EXPECT_EQ(log.feedback_words(), twice);
  EXPECT_GT(next_start(log, log.answered("start_nav_success")), gone);
  EXPECT_EQ(log.statuses.back().nav, "NAV_SUCCESS");
  const Time start = next_start(log, gone);
  const auto& success = log.first_status("NAV_SUCCESS", start);
  EXPECT_LT(drive_figures(log, start, success.time).goal_m, 0.10);
}

}  // namespace drover::mission
