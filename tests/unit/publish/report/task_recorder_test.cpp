// What a task's report says of what was driven.
#include "publish/report/task_recorder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "publish/report/report_text.h"
#include "tests/unit/cli/parsed.h"

namespace drover::publish {
namespace {

constexpr Time kAccepted{std::chrono::seconds(100)};
constexpr double kTick_s = 0.1;

/// A robot that drives along the x axis as the test says.
class TaskRecorderTest : public testing::Test {
 protected:
  TaskRecorderTest() {
    seen_.time = kAccepted;
    seen_.nav.status = NavStatus::run;
    seen_.gnss.health = SourceState::fresh;
    seen_.gnss.position.quality = FixQuality::rtk_fixed;
    seen_.nav.error_bound_m = 0.03;
  }
  void drive(double speed_mps, double seconds, double cross_track_m = 0) {
    seen_.nav.cross_track_m = cross_track_m;
    for (int i = 0; i < static_cast<int>(std::lround(seconds / kTick_s)); ++i) {
      seen_.time += from_s(kTick_s);
      seen_.pose.vx_mps = speed_mps;
      seen_.pose.x_m += speed_mps * kTick_s;
      seen_.pose.y_m = cross_track_m;
      recorder_.take(seen_);
    }
  }
  void pause(double seconds, const char* why) {
    seen_.nav.paused = true;
    seen_.why.clear();
    (void)seen_.why.push_back(Reason(why));
    drive(0, seconds, seen_.nav.cross_track_m);
    seen_.nav.paused = false;
    seen_.why.clear();
  }
  TaskReport end(TaskEnded::How how = TaskEnded::How::success, const char* reason = "") {
    return recorder_.end(seen_.time, true, how, reason);
  }

  Path path_{1, "row 7", {{0, 0}, {10, 0}}};
  Snapshot seen_;
  TaskRecorder recorder_{{&path_, "row 7", 2, 0.5}, kAccepted, std::chrono::hours(400'000)};
};

TEST_F(TaskRecorderTest, AddsTheWayThatTheRobotDroveWhicheverWayItFaces) {
  drive(0.5, 10);
  drive(-0.5, 2);
  const auto report = end();
  EXPECT_NEAR(report.way_m, 6, 0.06);
  EXPECT_NEAR(report.time_s, 12, 1e-6);
  EXPECT_NEAR(report.mean_mps, 0.5, 0.01);
  EXPECT_EQ(report.fastest_mps, 0.5);
}

TEST_F(TaskRecorderTest, WeighsWhatIsBesideTheTrackByWayAndNotByTime) {
  drive(0.5, 18, 0.01);
  drive(0.5, 2, 0.05);
  drive(0, 600, 0.05);  // who waits there is no worse for it
  const auto report = end();
  EXPECT_NEAR(report.rms_m, std::sqrt(0.9 * 0.01 * 0.01 + 0.1 * 0.05 * 0.05), 5e-4);
  EXPECT_NEAR(report.p95_m, 0.05, 1.1e-3);
  EXPECT_EQ(report.worst_m, 0.05);
}

TEST_F(TaskRecorderTest, TellsOfTheShareOfWayThatIsNearer) {
  drive(0.5, 96, 0.010);
  drive(0.5, 4, -0.200);
  const auto report = end();
  EXPECT_NEAR(report.p95_m, 0.010, 1.1e-3) << "four hundredths of the way are beyond";
  EXPECT_EQ(report.worst_m, 0.2) << "on either side";
}

TEST_F(TaskRecorderTest, JudgesNothingBeforeTheRobotIsOnItsTrack) {
  drive(0.5, 4, 1.0);
  drive(0.5, 4, 0.01);
  const auto report = end();
  EXPECT_NEAR(report.joined_m, 2, 0.1);
  EXPECT_EQ(report.worst_m, 0.01);
}

TEST_F(TaskRecorderTest, KnowsNothingBesideATrackThatWasNeverReached) {
  drive(0.5, 4, 1.0);
  const auto report = end(TaskEnded::How::failed, "the robot left the corridor");
  EXPECT_FALSE(std::isfinite(report.rms_m));
  EXPECT_FALSE(std::isfinite(report.worst_m));
}

TEST_F(TaskRecorderTest, SharesTheWayAmongFixQualities) {
  drive(0.5, 8);
  seen_.gnss.position.quality = FixQuality::rtk_float;
  drive(0.5, 1);
  seen_.gnss.health = SourceState::stale;
  drive(0.5, 1);
  drive(0, 60);
  const auto report = end();
  EXPECT_NEAR(report.way_by_quality_m[4] / report.way_m, 0.8, 0.01);
  EXPECT_NEAR(report.way_by_quality_m[5] / report.way_m, 0.1, 0.01);
  EXPECT_NEAR(report.way_by_quality_m[kNotHeard] / report.way_m, 0.1, 0.01);
}

TEST_F(TaskRecorderTest, TellsTheWorstBoundOfMotionApart) {
  drive(0.5, 2);
  seen_.nav.error_bound_m = 0.08;
  drive(0.5, 2);
  seen_.nav.error_bound_m = 0.4;
  pause(5, "localisation lost");
  const auto report = end();
  EXPECT_EQ(report.worst_bound_moving_m, 0.08);
  EXPECT_EQ(report.worst_bound_m, 0.4);
}

TEST_F(TaskRecorderTest, TellsWhereHowLongAndWhyItPaused) {
  drive(0.5, 10, 0.01);
  pause(3, "person is in the way, 0.04 m along the track");
  drive(0.5, 10, 0.01);
  pause(2, "no RTK fix");
  const auto report = end();
  ASSERT_EQ(report.pauses.size(), 2U);
  const auto& first = report.pauses.front();
  EXPECT_EQ(first.reason, "person is in the way, 0.04 m along the track");
  EXPECT_NEAR(first.after_s, 10.1, 1e-6);
  EXPECT_NEAR(first.lasted_s, 3, 1e-6);
  EXPECT_NEAR(first.way_m, 5, 0.06);
  EXPECT_NEAR(first.x_m, 5, 0.06);
  EXPECT_NEAR(report.paused_s, 3 + 1.9, 1e-6) << "seen a tick after its begin, ended with the task";
  EXPECT_EQ(report.pauses.back().reason, "no RTK fix");
}

TEST_F(TaskRecorderTest, AddsUpItsPausesAlsoTheOneInWhichTheTaskEnded) {
  drive(0.5, 1);
  pause(3, "an obstacle");
  drive(0.5, 1);
  pause(2, "an obstacle");
  const auto report =
      recorder_.end(seen_.time + from_s(0.35), true, TaskEnded::How::cancelled, "cancelled");
  ASSERT_EQ(report.pauses.size(), 2U);
  EXPECT_NEAR(report.pauses[1].lasted_s, 1.9 + 0.35, 1e-6);
  EXPECT_NEAR(report.paused_s, report.pauses[0].lasted_s + report.pauses[1].lasted_s, 1e-6);
}

TEST_F(TaskRecorderTest, KeepsTheLastPlaceHoweverNear) {
  drive(0.5, 10);
  drive(0.05, 0.3);
  const auto report = end();
  ASSERT_GT(report.samples.size(), 2U);
  EXPECT_EQ(report.samples.back().x_m, seen_.pose.x_m);
  EXPECT_EQ(report.samples.back().way_m, report.way_m);
  EXPECT_LT(report.samples.end()[-2].way_m, report.way_m);
}

TEST_F(TaskRecorderTest, KeepsThePlaceOfARobotThatStandsOnce) {
  drive(0, 5);
  EXPECT_EQ(end().samples.size(), 1U);
}

TEST_F(TaskRecorderTest, KeepsSoManyPausesAndCountsTheOthers) {
  for (std::size_t i = 0; i < TaskRecorder::kMostPauses + 5; ++i) {
    pause(0.5, "again");
    drive(0.5, 0.5);
  }
  const auto report = end();
  EXPECT_EQ(report.pauses.size(), TaskRecorder::kMostPauses);
  EXPECT_EQ(report.pauses_left_out, 5U);
  EXPECT_NEAR(report.paused_s, 0.5 * (TaskRecorder::kMostPauses + 5), 1e-6);
}

TEST_F(TaskRecorderTest, KeepsAPlaceEachTenthOfAMetre) {
  drive(0.5, 20, 0.01);
  const auto report = end();
  ASSERT_GT(report.samples.size(), 80U);
  ASSERT_LT(report.samples.size(), 110U);
  for (std::size_t i = 1; i + 1 < report.samples.size(); ++i)
    EXPECT_GE(report.samples[i].way_m - report.samples[i - 1].way_m,
              TaskRecorder::kSpacing_m - 1e-6);
  EXPECT_NEAR(report.samples.back().x_m, report.samples.back().way_m, 0.06);
}

TEST_F(TaskRecorderTest, DropsEverySecondPlaceOfALongWayAndNothingOfTheFigures) {
  drive(2, 3000, 0.02);
  const auto report = end();
  EXPECT_NEAR(report.way_m, 6000, 1);
  EXPECT_LT(report.samples.size(), TaskRecorder::kMostSamples);
  EXPECT_GT(report.samples.size(), TaskRecorder::kMostSamples / 4);
  const double first_m = report.samples[1].way_m - report.samples[0].way_m;
  const double last_m = report.samples.end()[-2].way_m - report.samples.end()[-3].way_m;
  EXPECT_NEAR(first_m, last_m, 0.25) << "as dense at its end as at its begin";
  EXPECT_NEAR(report.rms_m, 0.02, 1e-6);
}

TEST_F(TaskRecorderTest, PassesOverWhatIsNotOfTheTask) {
  seen_.nav.status = NavStatus::success;
  drive(0.5, 10, 1.0);
  EXPECT_EQ(end().way_m, 0);
}

TEST_F(TaskRecorderTest, SaysItAllAsJson) {
  drive(0.5, 10, 0.01);
  pause(3, "a \"box\" <1>");
  const auto texts = report_texts(end(TaskEnded::How::failed, "an obstacle blocked the way"));
  EXPECT_EQ(texts.summary.find('\n'), std::string::npos);
  EXPECT_EQ(texts.line.find('\n'), std::string::npos);
  const auto summary = cli::parsed(texts.summary);
  EXPECT_EQ(*summary.find("track")->text(), "row 7");
  EXPECT_EQ(summary.find("target_id")->integer(), 2);
  EXPECT_EQ(*summary.find("result")->text(), "failed");
  EXPECT_EQ(*summary.find("reason")->text(), "an obstacle blocked the way");
  EXPECT_NEAR(*summary.find("cross_track")->find("rms_m")->number(), 0.01, 1e-4);
  EXPECT_EQ(*summary.find("pauses")->list()->front().find("reason")->text(), "a \"box\" <1>");
  const auto line = cli::parsed(texts.line);
  EXPECT_EQ(line.find("track")->list()->size(), 2U);
  const auto& columns = *line.find("columns")->list();
  for (const auto& place : *line.find("driven")->list())
    ASSERT_EQ(place.list()->size(), columns.size());
}

TEST_F(TaskRecorderTest, LeavesOutOfItsJsonWhatItDoesNotKnow) {
  const auto summary = cli::parsed(report_texts(end()).summary);
  EXPECT_TRUE(summary.find("cross_track")->find("rms_m")->is_null());
  EXPECT_TRUE(summary.find("speed")->find("mean_mps")->is_null());
  EXPECT_TRUE(summary.find("error_bound")->find("max_m")->is_null());
}

}  // namespace
}  // namespace drover::publish
