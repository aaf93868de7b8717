// Which parts of a track are driven backwards.
#include "store/gears.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "drover/angle.h"
#include "support/tracks.h"

namespace drover::store {
namespace {

constexpr double kUntold = std::numeric_limits<double>::quiet_NaN();

/// A track with, of each point, how the robot looked there.
struct Recorded {
  Path path;
  std::vector<double> looks_rad;

  void go(double x_m, double y_m, double yaw_rad) {
    path.points.push_back({x_m, y_m});
    looks_rad.push_back(yaw_rad);
  }
  /// '-' ahead, 'b' backwards, one for each segment; empty: nowhere backwards.
  std::string gears(TrackDrive drive) {
    set_gears(path, looks_rad, drive);
    std::string text;
    for (const std::uint8_t back : path.backwards) text += back != 0 ? 'b' : '-';
    return text;
  }
};

/// Ahead to the east, back to the west beside it, and ahead again.
Recorded there_back_and_there() {
  Recorded it;
  for (int i = 0; i <= 4; ++i) it.go(i, 0, 0);
  for (int i = 3; i >= 1; --i) it.go(i, 0.1 * (4 - i), 0);
  for (int i = 2; i <= 5; ++i) it.go(i, 0.3 + 0.3 * (i - 1), 0.3);
  return it;
}

TEST(Gears, AreNoneWhereTheRobotLooksAhead) {
  EXPECT_EQ(there_back_and_there().gears(TrackDrive::ahead), "");
}

TEST(Gears, AreAsRecorded) {
  EXPECT_EQ(there_back_and_there().gears(TrackDrive::recorded), "----bbb----");
}

TEST(Gears, AreNoneOfATrackThatWasRecordedAhead) {
  Recorded it;
  for (int i = 0; i <= 4; ++i) it.go(i, 0, 0.2);
  for (int i = 4; i >= 0; --i) it.go(i, 1, kPi);
  EXPECT_EQ(it.gears(TrackDrive::recorded), "");
}

TEST(Gears, AreThoseOfAllOfATrackThatWasBackedAlong) {
  Recorded it;
  for (int i = 0; i <= 4; ++i) it.go(-i, 0, 0.1);
  EXPECT_EQ(it.gears(TrackDrive::recorded), "bbbb");
}

TEST(Gears, AreNotTakenFromPointsThatDoNotTell) {
  Recorded it = there_back_and_there();
  for (double& yaw_rad : it.looks_rad) yaw_rad = kUntold;
  EXPECT_EQ(it.gears(TrackDrive::recorded), "");
}

TEST(Gears, AreThoseOfMostOfAPart) {
  Recorded it = there_back_and_there();
  it.looks_rad[5] = kUntold;
  EXPECT_EQ(it.gears(TrackDrive::recorded), "----bbb----");
  it.looks_rad[6] = kPi;  // of three points one does not tell, and one tells the other way
  EXPECT_EQ(it.gears(TrackDrive::recorded), "");
}

TEST(Gears, OfEitherWayChangeAtEachCuspWhateverThePointsTell) {
  Recorded it = there_back_and_there();
  for (double& yaw_rad : it.looks_rad) yaw_rad = kUntold;
  EXPECT_EQ(it.gears(TrackDrive::either), "----bbb----");
  EXPECT_TRUE(it.path.either);
  Recorded straight;
  for (int i = 0; i <= 3; ++i) straight.go(i, 0, 0);
  EXPECT_EQ(straight.gears(TrackDrive::either), "---") << "it may be flipped at its start";
}

TEST(Gears, DoNotChangeForAShortStepBack) {
  Recorded it;
  it.path = test::record(test::Pen().line(3).turn(kPi).line(0.2).turn(kPi).line(3).points(), 0.05);
  it.looks_rad.assign(it.path.points.size(), 0.0);
  EXPECT_EQ(it.gears(TrackDrive::recorded), "");
}

TEST(Gears, ChangeWhereATrackOfAnOperatorsRecorderDoes) {
  for (const double spacing_m : {0.1, 0.5}) {
    Recorded it;
    it.path = test::record(test::three_point_turn(), spacing_m);
    it.looks_rad.assign(it.path.points.size(), kUntold);
    const std::string gears = it.gears(TrackDrive::either);
    std::string changes;
    for (std::size_t i = 1; i < gears.size(); ++i)
      if (gears[i] != gears[i - 1]) changes += gears[i];
    EXPECT_EQ(changes, "b-") << gears;
  }
}

TEST(Gears, OfTooFewPointsAreNone) {
  Recorded it;
  EXPECT_EQ(it.gears(TrackDrive::either), "");
  it.go(0, 0, 0);
  EXPECT_EQ(it.gears(TrackDrive::recorded), "");
  for (int i = 0; i < 5; ++i) it.go(0, 0, 0);
  EXPECT_EQ(it.gears(TrackDrive::recorded), "") << "all at one place";
}

}  // namespace
}  // namespace drover::store
