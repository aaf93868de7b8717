#include "scene/look/look.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "scene/plane/sweep.h"
#include "tests/unit/scene/plane/shapes.h"

namespace drover::scene {
namespace {

using testing::HasSubstr;

constexpr double kFree = std::numeric_limits<double>::infinity();

/// A robot of 1.0 by 0.7 m at the map's origin that looks along x.
class ALook : public testing::Test {
 protected:
  ALook() {
    settings.footprint = {{0.5, 0.35}, {-0.5, 0.35}, {-0.5, -0.35}, {0.5, -0.35}};
    settings.margin_m = 0.1;
    around.problem.clear();
    from.t = Time{std::chrono::seconds(5)};
  }
  void put(const char* name, double x_m, double y_m, double side_m = 0.2) {
    around.field.put(name, area_of(box(side_m, side_m, 1), pose(x_m, y_m, 0.5), kRobot));
  }
  void drive_along(const std::vector<Point2>& track) {
    line = track;
    from.line = line;
    from.path = 3;
  }
  Clearance look_now() const { return look(around, settings, from); }
  static std::string text(const Reason& reason) { return std::string(reason.view()); }

  Surroundings around;
  LookSettings settings;
  Standpoint from;
  std::vector<Point2> line;
};

TEST_F(ALook, SaysWhatItIsFor) {
  around.number = 9;
  from.twist = {0.4, 0.1};
  drive_along({{0, 0}, {4, 0}});
  const Clearance found = look_now();
  EXPECT_EQ(found.t, from.t);
  EXPECT_EQ(found.scene, 9U);
  EXPECT_EQ(found.path, 3U);
  EXPECT_EQ(found.twist.vx_mps, 0.4);
  EXPECT_EQ(found.twist.wz_radps, 0.1);
}

TEST_F(ALook, WithNothingAroundSeesAsFarAsItWasAskedTo) {
  drive_along({{0, 0}, {4, 0}});
  const Clearance found = look_now();
  EXPECT_EQ(found.along_m, kFree);
  EXPECT_DOUBLE_EQ(found.ahead_m, settings.ahead_m);
  EXPECT_DOUBLE_EQ(found.back_m, settings.ahead_m);
  EXPECT_EQ(found.left_rad, kFree);
  EXPECT_EQ(text(found.first), "");
  EXPECT_EQ(text(found.unknown), "");
}

TEST_F(ALook, TakesFootprintMarginAndTwiceThePositionsSigmaOffTheWay) {
  put("box1", 2, 0);
  from.position_sigma_m = 0.05;
  const Clearance found = look_now();
  EXPECT_NEAR(found.ahead_m, 1.9 - 0.5 - 0.1 - 0.1, kResolution_m + 1e-9);
  EXPECT_DOUBLE_EQ(found.back_m, settings.ahead_m);
  EXPECT_THAT(text(found.first), HasSubstr("box1 is in the way, 1."));
  EXPECT_THAT(text(found.first), HasSubstr("ahead"));
}

TEST_F(ALook, LooksToTheSidesForARobotThatGoesThere) {
  put("box1", 0, 1.5);
  EXPECT_EQ(look_now().aside_left_m, 0) << "of another one nobody needs it";
  settings.aside = true;
  from.position_sigma_m = 0.05;
  from.twist = {0, 0, 0.3};
  const Clearance found = look_now();
  EXPECT_NEAR(found.aside_left_m, 1.4 - 0.35 - 0.1 - 0.1, kResolution_m + 1e-9);
  EXPECT_NEAR(found.bare.aside_left_m, 1.4 - 0.35 - 0.1, kResolution_m + 1e-9);
  EXPECT_DOUBLE_EQ(found.aside_right_m, settings.ahead_m);
  EXPECT_THAT(text(found.first), HasSubstr("box1 is in the way, 0.8"));
  EXPECT_THAT(text(found.first), HasSubstr("to the left"));
  from.twist = {0, 0, -0.3};
  EXPECT_EQ(text(look_now().first), "");
}

TEST_F(ALook, ToTheSideKeepsTheHeading) {
  settings.aside = true;
  from.pose.yaw_rad = kPi / 2;  // its left is west
  put("west", -1.5, 0);
  EXPECT_NEAR(look_now().aside_left_m, 1.4 - 0.35 - 0.1, kResolution_m + 1e-9);
  put("beside", -1.5, 0.68);  // its front is 0.5 m north, with 0.1 m of margin
  put("west", 5, 5);
  EXPECT_LT(look_now().aside_left_m, 1.4 - 0.35);
  put("beside", -1.5, 0.75);
  EXPECT_DOUBLE_EQ(look_now().aside_left_m, settings.ahead_m);
  from.yaw_sigma_rad = 0.03;
  EXPECT_LT(look_now().aside_left_m, 1.4 - 0.35) << "a heading that is off leads into it";
}

TEST_F(ALook, ToTheSidesWithNothingAroundSeesAsFarAsItWasAskedTo) {
  settings.aside = true;
  EXPECT_DOUBLE_EQ(look_now().aside_left_m, settings.ahead_m);
  EXPECT_DOUBLE_EQ(look_now().bare.aside_right_m, settings.ahead_m);
  put("box1", 2, 0);
  from.pose.yaw_rad = from.yaw_sigma_rad = NAN;
  const Clearance any = look_now();
  EXPECT_GT(any.aside_left_m, 0);
  EXPECT_EQ(any.aside_left_m, any.ahead_m) << "it may look any way";
}

TEST_F(ALook, TakesTwiceTheHeadingsSigmaTimesItsReachOffTheWay) {
  put("box1", 2, 0);
  const double reach_m = std::hypot(0.5, 0.35);
  from.yaw_sigma_rad = 0.05;
  drive_along({{0, 0}, {4, 0}});
  const double free_m = 1.9 - 0.5 - 0.1 - 0.1 * reach_m;
  EXPECT_NEAR(look_now().along_m, free_m, kResolution_m + 1e-9);
  EXPECT_NEAR(look_now().ahead_m, free_m, kResolution_m + 1e-9) << "the map holds it there";
  from.path = 0;
  EXPECT_NEAR(look_now().ahead_m, free_m / 1.1, kResolution_m + 1e-9)
      << "on no track it comes off its curve by a tenth of the way";
  from.path = 3;
  from.yaw_sigma_rad = 1;  // a turned corner is thrown no farther than to the other side
  put("box1", 5, 0);
  EXPECT_NEAR(look_now().along_m, 4.9 - 0.5 - 0.1 - 2 * reach_m, kResolution_m + 1e-9);
}

TEST_F(ALook, TurnsInAWiderSpaceWhenItsHeadingIsLessWellKnown) {
  put("wall", 0, 0.8, 0.3);  // its side is at 0.65 m, 6 cm less than the corners reach
  const double free_rad = look_now().left_rad;
  from.yaw_sigma_rad = 0.03;
  EXPECT_LT(look_now().left_rad, free_rad - 0.05);
  EXPECT_GT(look_now().left_rad, 0);
}

/// 3 cm beside the margin, far ahead: a heading that is off by 2 degrees leads into it.
TEST_F(ALook, SeesWhatACurveLeadsIntoWhenItsHeadingIsOff) {
  put("beside", 2.5, 0.35 + 0.1 + 0.03 + 0.1);
  EXPECT_DOUBLE_EQ(look_now().ahead_m, settings.ahead_m);
  from.yaw_sigma_rad = to_rad(1);
  const Clearance found = look_now();
  EXPECT_LT(found.ahead_m, 2.0);
  EXPECT_GT(found.ahead_m, 0.1);
  EXPECT_DOUBLE_EQ(found.back_m, settings.ahead_m);
  // A task is kept on its line by the map: only its body is turned.
  from.yaw_sigma_rad = to_rad(0.6);
  drive_along({{0, 0}, {4, 0}});
  EXPECT_EQ(look_now().along_m, kFree);
  from.yaw_sigma_rad = to_rad(2);
  EXPECT_LT(look_now().along_m, 2.5);
}

TEST_F(ALook, KeepsFartherFromItsFenceWhenItsHeadingIsLessWellKnown) {
  around.keep_in.push_back(area_of_rings({{{-3, -3}, {3, -3}, {3, 3}, {-3, 3}}}));
  around.keep_in_names.emplace_back("yard");
  from.yaw_sigma_rad = 0.05;
  drive_along({{0, 0}, {4, 0}});
  EXPECT_NEAR(look_now().along_m, 3 - 0.5 - 0.1 - 0.1 * std::hypot(0.5, 0.35),
              kResolution_m + 1e-9);
}

TEST_F(ALook, NamesWhatIsBehindARobotThatReverses) {
  put("ahead", 2, 0);
  put("behind", -1.5, 0);
  from.twist = {-0.3, 0};
  const Clearance found = look_now();
  EXPECT_NEAR(found.back_m, 1.4 - 0.5 - 0.1, kResolution_m + 1e-9);
  EXPECT_THAT(text(found.first), HasSubstr("behind"));
}

TEST_F(ALook, LooksAlongTheCurveThatIsDriven) {
  put("aside", 1.6, 1.4);
  EXPECT_DOUBLE_EQ(look_now().ahead_m, settings.ahead_m);
  from.twist = {0.5, 0.35};
  EXPECT_LT(look_now().ahead_m, 2.0);
  from.twist = {-0.5, 0.35};  // the same curve, back
  EXPECT_DOUBLE_EQ(look_now().back_m, settings.ahead_m);
}

TEST_F(ALook, FindsTheAngleThatIsFreeBesideAWall) {
  put("wall", 0, 0.6, 0.29);  // its side is at 0.455 m, 5 mm beyond side and margin
  const Clearance found = look_now();
  EXPECT_LT(found.left_rad, 0.5);
  EXPECT_LT(found.right_rad, 0.5);
  EXPECT_DOUBLE_EQ(found.ahead_m, settings.ahead_m) << "the wall is beside it";
}

TEST_F(ALook, EndsAtTheGoalOfTheTrackAndNotAtTheWallBehindIt) {
  put("wall", 4 + 0.5 + 0.1 + 0.5, 0, 0.6);
  drive_along({{0, 0}, {4, 0}});
  EXPECT_EQ(look_now().along_m, kFree);
  put("near", 3, 0.4);
  const Clearance found = look_now();
  EXPECT_LT(found.along_m, 2.5);
  EXPECT_THAT(text(found.first), HasSubstr("near is in the way, 2."));
  EXPECT_THAT(text(found.first), HasSubstr("along the track"));
}

TEST_F(ALook, CountsWhatItWasNotAskedToLookAtAsNotFree) {
  settings.along_m = 2;
  std::vector<Point2> track;
  for (int i = 0; i <= 40; ++i) track.push_back({0.25 * i, 0});
  drive_along(track);
  EXPECT_LT(look_now().along_m, 2.01);
  drive_along({{0, 0}, {500, 0}});  // in one piece
  EXPECT_NEAR(look_now().along_m, 2, 1e-6);
}

TEST_F(ALook, StopsAtTheFenceThatKeepsItIn) {
  around.keep_in.push_back(area_of_rings({{{-3, -3}, {3, -3}, {3, 3}, {-3, 3}}}));
  around.keep_in_names.emplace_back("north field");
  const Clearance found = look_now();
  EXPECT_NEAR(found.ahead_m, 3 - 0.5 - 0.1, kResolution_m + 1e-9);
  EXPECT_THAT(text(found.first), HasSubstr("the fence of north field"));
  put("box1", 2, 0);
  EXPECT_THAT(text(look_now().first), HasSubstr("box1"));
}

TEST_F(ALook, MovesNowhereFromWhereSomethingIsAlready) {
  put("box1", 0.3, 0);
  drive_along({{0, 0}, {4, 0}});
  const Clearance found = look_now();
  EXPECT_EQ(found.along_m, 0);
  EXPECT_EQ(found.ahead_m, 0);
  EXPECT_EQ(found.back_m, 0);
  EXPECT_EQ(found.left_rad, 0);
  EXPECT_EQ(found.right_rad, 0);
  EXPECT_EQ(text(found.first), "box1 is where the robot is, or within its margin");
}

TEST_F(ALook, SaysNothingWithoutAPosition) {
  put("box1", 50, 0);
  for (const double sigma_m : {double{NAN}, kFree, -1.0}) {
    from.position_sigma_m = sigma_m;
    const Clearance found = look_now();
    EXPECT_THAT(text(found.unknown), HasSubstr("is not known"));
    EXPECT_EQ(found.ahead_m + found.back_m + found.left_rad + found.right_rad, 0);
  }
  from.position_sigma_m = 0;
  from.pose.x_m = NAN;
  EXPECT_FALSE(look_now().unknown.empty());
  from.pose.x_m = 0;
  from.twist.vx_mps = NAN;
  EXPECT_FALSE(look_now().unknown.empty());
}

TEST_F(ALook, NeedsNeitherPositionNorHeadingWhereNothingIsPlaced) {
  from.position_sigma_m = from.yaw_sigma_rad = NAN;
  from.pose = {NAN, NAN, NAN};
  Clearance found = look_now();
  EXPECT_EQ(text(found.unknown), "");
  EXPECT_DOUBLE_EQ(found.ahead_m, settings.ahead_m);
  EXPECT_DOUBLE_EQ(found.back_m, settings.ahead_m);
  EXPECT_EQ(found.left_rad, kFree);
  EXPECT_EQ(found.right_rad, kFree);
  drive_along({{0, 0}, {4, 0}});
  EXPECT_EQ(look_now().along_m, kFree);
  drive_along({{0, 0}, {40, 0}});
  EXPECT_DOUBLE_EQ(look_now().along_m, settings.along_m);
  from.twist.vx_mps = NAN;
  EXPECT_FALSE(look_now().unknown.empty());
  from.twist.vx_mps = 0;
  around.constrained = true;
  EXPECT_FALSE(look_now().unknown.empty()) << "a constraint is of a place";
  around.constrained = false;
  around.keep_out.put("pond", Area{});
  EXPECT_FALSE(look_now().unknown.empty());
  around.keep_out.clear();
  around.keep_in.emplace_back();
  EXPECT_FALSE(look_now().unknown.empty());
}

/// With one antenna nobody knows it before the robot has driven: the yaw is a number all the same.
TEST_F(ALook, SaysHowFarADiscMayGoWithoutAHeading) {
  const double reach_m = std::hypot(0.5, 0.35) + 0.1 + 2 * 0.05;
  from.position_sigma_m = 0.05;
  for (const double yaw_sigma_rad : {double{NAN}, kFree, -1.0}) {
    from.yaw_sigma_rad = yaw_sigma_rad;
    around.field.clear();
    put("far", 50, 0);
    Clearance found = look_now();
    EXPECT_EQ(text(found.unknown), "");
    EXPECT_DOUBLE_EQ(found.ahead_m, settings.ahead_m);
    EXPECT_EQ(found.left_rad, kFree);
    EXPECT_EQ(text(found.first), "");

    put("behind", -2, 0);
    found = look_now();
    EXPECT_NEAR(found.ahead_m, 1.9 - reach_m, kResolution_m + 1e-9);
    EXPECT_LE(found.ahead_m, 1.9 - reach_m);
    EXPECT_EQ(found.back_m, found.ahead_m);
    EXPECT_EQ(found.right_rad, kFree);
    EXPECT_THAT(text(found.first), HasSubstr("behind is in the way, 1.0"));

    put("near", 0, 0.8);
    found = look_now();
    EXPECT_EQ(found.ahead_m, 0);
    EXPECT_EQ(found.left_rad, 0);
    EXPECT_EQ(found.right_rad, 0);
    EXPECT_EQ(text(found.first), "near is where the robot is, or within its margin");
  }
}

TEST_F(ALook, KeepsADiscInsideItsFence) {
  around.keep_in.push_back(area_of_rings({{{-3, -2}, {3, -2}, {3, 3}, {-3, 3}}}));
  around.keep_in_names.emplace_back("yard");
  from.yaw_sigma_rad = NAN;
  const Clearance found = look_now();
  EXPECT_NEAR(found.ahead_m, 2 - std::hypot(0.5, 0.35) - 0.1, kResolution_m + 1e-9);
  EXPECT_THAT(text(found.first), HasSubstr("the fence of yard"));
}

TEST_F(ALook, SaysNothingOfATrackWithoutAHeading) {
  put("box1", 50, 0);
  drive_along({{0, 0}, {4, 0}});
  from.yaw_sigma_rad = NAN;
  const Clearance found = look_now();
  EXPECT_THAT(text(found.unknown), HasSubstr("which way"));
  EXPECT_EQ(found.ahead_m, 0);
}

TEST_F(ALook, KeepsObjectsAndZonesOfOneNameApart) {
  put("north", 2.5, 0);
  around.keep_out.put("north", area_of(box(0.2, 0.2, 1), pose(2, 0, 0.5), kRobot));
  EXPECT_THAT(text(look_now().first), HasSubstr("keep-out north is in the way, 1.3"));
  around.keep_out.clear();
  EXPECT_THAT(text(look_now().first), HasSubstr("north is in the way, 1.8"));
}

TEST_F(ALook, LooksFromWhereTheRobotIsOnALineThatBeginsBehindIt) {
  put("box1", 6, 0);
  drive_along({{-8, 0}, {-4, 0}, {8, 0}});
  from.line_from_m = 8;
  EXPECT_NEAR(look_now().along_m, 5.9 - 0.5 - 0.1, kResolution_m + 1e-9);
  drive_along({{-0.9, 0}, {8, 0}});
  from.line_from_m = 0;
  EXPECT_NEAR(look_now().along_m, 5.9 - 0.5 - 0.1, kResolution_m + 1e-9) << "found by itself";
}

TEST_F(ALook, SaysNothingOfASceneThatIsNotKnown) {
  EXPECT_THAT(text(look(Surroundings{}, settings, from).unknown), HasSubstr("not read yet"));
  around.problem = "the zones cannot be read";
  EXPECT_EQ(text(look_now().unknown), "the zones cannot be read");
}

TEST_F(ALook, SaysNothingOfATrackOfWhichNothingIsGiven) {
  put("box1", 50, 0);
  drive_along({});
  const Clearance found = look_now();
  EXPECT_EQ(found.along_m, 0);
  EXPECT_THAT(text(found.unknown), HasSubstr("track"));
}

/// What is ahead does not hinder a turn on the spot, and what hinders it is not ahead.
TEST_F(ALook, NamesWhatHindersTheTurnThatIsAskedFor) {
  put("ahead", 1.5, 0);
  put("beside", 0.2, 0.65);
  from.twist = {0, 0.5};
  Clearance found = look_now();
  EXPECT_LT(found.left_rad, to_rad(30));
  std::string degrees = std::to_string(std::lround(to_deg(found.left_rad)));
  EXPECT_EQ(text(found.turn),
            "beside is in the way of the turn to the left, after " + degrees + " deg");
  EXPECT_EQ(text(found.first), text(found.turn));
  from.twist = {0, -0.5};
  found = look_now();
  degrees = std::to_string(std::lround(to_deg(found.right_rad)));
  EXPECT_EQ(text(found.first),
            "beside is in the way of the turn to the right, after " + degrees + " deg");
  around.field.remove("beside");
  found = look_now();
  EXPECT_EQ(found.right_rad, kFree);
  EXPECT_EQ(text(found.first), "");
  from.twist = {0.5, 0};
  found = look_now();
  EXPECT_EQ(text(found.turn), "");
  EXPECT_THAT(text(found.first), HasSubstr("ahead is in the way"));
}

TEST_F(ALook, NamesWhatHindersTheTurnAtACornerOfItsTrack) {
  put("wall", 0.2, 0.65);
  drive_along({{-3, 0}, {0, 0}, {0, -4}});
  from.line_from_m = 3;
  from.twist = {0, -0.5};
  const Clearance found = look_now();
  EXPECT_LT(found.along_m, 0.05);
  EXPECT_THAT(text(found.first), HasSubstr("wall is in the way of the turn to the right, after "));
}

TEST_F(ALook, SaysOfATurnThatItStandsInSomething) {
  put("box1", -0.2, -0.2);
  from.twist = {0, 0.5};
  EXPECT_EQ(text(look_now().turn), "box1 is where the robot is, or within its margin");
}

/// The rear left corner comes there after more than the corner of the track turns.
TEST_F(ALook, LooksNoFartherAroundThanTheTrackTurns) {
  put("beyond", 0.69 * std::cos(to_rad(45)), 0.69 * std::sin(to_rad(45)), 0.02);
  from.twist = {0, -0.5};
  EXPECT_NEAR(look_now().right_rad, to_rad(93), to_rad(3));
  EXPECT_THAT(text(look_now().first), HasSubstr("beyond"));
  drive_along({{-3, 0}, {0, 0}, {0.695, -3.94}});  // by 80 degrees
  from.line_from_m = 3;
  const Clearance found = look_now();
  EXPECT_EQ(found.right_rad, kFree);
  EXPECT_EQ(found.along_m, kFree);
  EXPECT_EQ(text(found.turn), "");
  EXPECT_EQ(text(found.first), "");
  EXPECT_LT(found.left_rad, to_rad(30)) << "who turns otherwise than the track may go on";
}

TEST_F(ALook, SaysWhatTheMarginAloneLeavesWhereNothingIsOrNoHeading) {
  drive_along({{0, 0}, {40, 0}});
  Clearance found = look_now();
  EXPECT_EQ(found.bare.along_m, found.along_m);
  EXPECT_EQ(found.bare.ahead_m, found.ahead_m);
  EXPECT_EQ(found.bare.back_m, found.back_m);
  EXPECT_EQ(found.bare.left_rad, kFree);
  EXPECT_EQ(found.bare.right_rad, kFree);
  from.path = 0;
  from.yaw_sigma_rad = NAN;
  put("behind", -2, 0);
  const Clearance sure = look_now();
  from.position_sigma_m = 0.6;
  found = look_now();
  EXPECT_EQ(found.ahead_m, 0);
  EXPECT_EQ(found.left_rad, 0);
  EXPECT_EQ(sure.bare.ahead_m, sure.ahead_m);
  EXPECT_NEAR(found.bare.ahead_m, sure.ahead_m, kResolution_m);
  EXPECT_NEAR(found.bare.back_m, sure.ahead_m, kResolution_m);
  EXPECT_EQ(found.bare.left_rad, kFree);
  EXPECT_EQ(found.bare.right_rad, kFree);
}

/// The position is not known any more as well as it was: nothing came nearer.
TEST_F(ALook, SaysWhatTheMarginAloneLeavesOfAWay) {
  put("box1", 1.2, 0);
  put("beside", 0, 0.8);
  drive_along({{0, 0}, {4, 0}});
  from.position_sigma_m = 0;
  const Clearance sure = look_now();
  EXPECT_NEAR(sure.ahead_m, 0.5, 0.02);
  EXPECT_EQ(sure.bare.ahead_m, sure.ahead_m);
  from.position_sigma_m = 0.2;
  const Clearance unsure = look_now();
  EXPECT_EQ(unsure.ahead_m, 0);
  EXPECT_EQ(unsure.along_m, 0);
  EXPECT_NEAR(unsure.bare.ahead_m, sure.ahead_m, kResolution_m);
  EXPECT_NEAR(unsure.bare.along_m, sure.along_m, kResolution_m);
  EXPECT_NEAR(unsure.bare.back_m, sure.back_m, kResolution_m);
  EXPECT_NEAR(unsure.bare.left_rad, sure.left_rad, 2 * kResolution_m);
  EXPECT_NEAR(unsure.bare.right_rad, sure.right_rad, 2 * kResolution_m);
}

}  // namespace
}  // namespace drover::scene
