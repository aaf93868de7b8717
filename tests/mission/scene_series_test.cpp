// The judge of many scenes is judged on drives made by hand: one that is well, and one for each
// thing that it has to find.
#include "mission/scene_series.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "support/temp_folder.h"

namespace drover::mission {
namespace {

using namespace std::chrono_literals;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

// A drive along x at 0.5 m/s from 1 s on; a box appears at `appears` with its face at 6 m and is
// taken away at 30 s.
struct DriveAlongX {
  Time appears{2s};
  double stands_at_x_m = 5.3;  ///< its middle
  Time stop_commanded{0s};     ///< 0: as it stands
  bool named = true;
  std::string meanwhile;  ///< a line of objects.log
  std::string pole_gone;  ///< when a pole 0.1 m before it is taken away, like "29.5"; empty: none

  SeriesReport report() const {
    const test::TempFolder folder;
    Record record;
    record.folder = folder.path();
    record.mps_per_turnps = 1;
    std::ofstream objects(record.folder / "objects.log");
    objects << "(0.500000000) watching 36\n";
    const auto ns = appears.time_since_epoch().count();
    char stamp[40];
    std::snprintf(stamp, sizeof stamp, "(%lld.%09lld) ", static_cast<long long>(ns / 1'000'000'000),
                  static_cast<long long>(ns % 1'000'000'000));
    objects << stamp << "put box box 6.5 0 0.5 0 1 1 1\n" << meanwhile;
    if (!pole_gone.empty())
      objects << stamp << "put pole cylinder " << stands_at_x_m + 0.45 + 0.11
              << " 0.4 0.5 0 0.01 1\n"
              << "(" << pole_gone << "00000000) gone pole\n";
    objects << "(30.000000000) gone box\n";
    objects.close();
    for (int i = 0; i <= 20; ++i) record.track.push_back({0.5 * i, 0});
    record.mqtt.push_back({Time{1s}, "mqtt_control", false, R"({"cmd": "start_task", "id": 21})"});
    record.feedback.push_back({Time{1s}, "start_task_success", ""});
    double x_m = 0;
    for (Time t{0s}; t < Time{31s}; t += 5ms) {
      const bool moves = t > Time{1s} && x_m < stands_at_x_m;
      if (moves) x_m += 0.5 * 0.005;
      TruthLine line;
      line.time = t;
      line.x_m = x_m;
      line.vx_mps = moves ? 0.5 : 0;
      record.truth.push_back(line);
      const bool commanded = stop_commanded == Time{0s} ? moves : moves && t < stop_commanded;
      record.sent.push_back({t, {1, commanded ? 0.5F : 0.0F, 0}});
      if (t.time_since_epoch() % 100ms != Duration{}) continue;
      Status status;
      status.time = t;
      status.obstacle = !moves && t > Time{2s};
      status.why = status.obstacle && named ? "box is in the way, 0.05 m along the track" : "";
      record.statuses.push_back(status);
    }
    return judge_series(record);
  }
};

TEST(ASeries, IsWellWhenTheRobotStandsBeforeWhatCame) {
  const auto report = DriveAlongX{}.report();
  EXPECT_THAT(report.problems, IsEmpty());
  ASSERT_EQ(report.appeared.size(), 1U);
  EXPECT_EQ(report.appeared[0].where, Appeared::Where::far);
  EXPECT_NEAR(report.appeared[0].way_m, 6 - 0.45 - 0.5, 0.02);
  EXPECT_NEAR(report.appeared[0].stood_m, 0.25, 0.02);
  EXPECT_NEAR(report.least_gap_m, 0.25, 0.01);
  EXPECT_EQ(report.drives, 1U);
  EXPECT_EQ(report.accepted, 1U);
}

TEST(ASeriesProof, CountsWhatHappenedInEachRun) {
  SeriesProof proof;
  proof.add(DriveAlongX{}.report());
  DriveAlongX drive;
  drive.appears = Time{11'800ms};
  drive.stands_at_x_m = 5.52;
  drive.stop_commanded = Time{11'880ms};
  proof.add(drive.report());
  EXPECT_EQ(proof.drives, 2U);
  EXPECT_EQ(proof.far, 1U);
  EXPECT_EQ(proof.stood, 1U);
  EXPECT_EQ(proof.near, 1U);
  EXPECT_THAT(proof.lacks(), IsEmpty()) << "who repeats one run plays no series";
}

/// A robot that never stands, or before which nothing ever comes, would pass otherwise.
TEST(ASeriesProof, LacksWhatNeverHappened) {
  EXPECT_THAT((SeriesProof{100, 80, 30, 5}.lacks()), IsEmpty());
  EXPECT_THAT((SeriesProof{100, 80, 30, 0}.lacks()), ElementsAre(HasSubstr("too near")));
  EXPECT_THAT((SeriesProof{100, 80, 13, 1}.lacks()), ElementsAre(HasSubstr("13 of 80")));
  EXPECT_THAT((SeriesProof{100, 0, 0, 0}.lacks()), testing::SizeIs(2));
}

TEST(ASeries, FindsAContact) {
  DriveAlongX drive;
  drive.stands_at_x_m = 5.6;
  EXPECT_THAT(drive.report().problems, ElementsAre(HasSubstr("box: CONTACT")));
}

TEST(ASeries, FindsAContactWithWhatWalkedIntoTheWay) {
  DriveAlongX drive;
  drive.meanwhile = "(9.000000000) at box 6.0 0\n";  // its face at 5.5 m
  EXPECT_THAT(drive.report().problems, ElementsAre(HasSubstr("box: CONTACT")));
}

TEST(ASeries, FindsWhatOnlyTheMechanicsFelt) {
  DriveAlongX drive;
  drive.meanwhile = "(9.000000000) touch box 4 0 0 0.5 0 0 0.001\n";
  EXPECT_THAT(drive.report().problems, ElementsAre(HasSubstr("the mechanics")));
}

TEST(ASeries, FindsARobotThatStandsTooFarAwayAndOneThatDoesNotSayWhy) {
  DriveAlongX drive;
  drive.stands_at_x_m = 4.5;
  EXPECT_THAT(drive.report().problems, ElementsAre(HasSubstr("too far")));
  drive = {};
  drive.named = false;
  EXPECT_THAT(drive.report().problems, ElementsAre(HasSubstr("not named")));
}

TEST(ASeries, LetsTheRobotWaitForASecondAfterSomethingElseThatHeldIt) {
  DriveAlongX drive;
  drive.stands_at_x_m = 4.5;
  drive.pole_gone = "29.5";
  EXPECT_THAT(drive.report().problems, IsEmpty());
  drive.pole_gone = "28.0";
  EXPECT_THAT(drive.report().problems, ElementsAre(HasSubstr("too far")));
}

TEST(ASeries, WantsZeroWithin100MillisecondsBeforeWhatCameTooNear) {
  DriveAlongX drive;
  drive.appears = Time{11'800ms};  // at 5.4 m: 0.15 m before it
  drive.stands_at_x_m = 5.52;      // it moves on for 0.24 s
  drive.stop_commanded = Time{11'880ms};
  auto report = drive.report();
  ASSERT_EQ(report.appeared.size(), 1U);
  EXPECT_EQ(report.appeared[0].where, Appeared::Where::near);
  EXPECT_THAT(report.problems, IsEmpty());
  drive.stop_commanded = Time{12'200ms};  // a ramp would be at 0.28 m/s by then
  EXPECT_THAT(drive.report().problems, ElementsAre(HasSubstr("driven on")));
  drive.stands_at_x_m = 5.7;  // it is run into while it brakes
  drive.stop_commanded = Time{11'880ms};
  report = drive.report();
  EXPECT_THAT(report.problems, IsEmpty());
  EXPECT_EQ(report.excused_contacts, 1U);
}

}  // namespace
}  // namespace drover::mission
