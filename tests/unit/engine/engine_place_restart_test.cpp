// The place at rest over a restart of the program: a receiver that jumps meanwhile is noticed.
#include <array>
#include <cmath>
#include <cstdio>

#include "engine_fixture.h"

namespace drover::engine {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

class ARobotThatIsStartedAgain : public AnEngine {
 protected:
  ARobotThatIsStartedAgain() {
    rig.imu = true;
    rig.tells_speed = true;
  }
  void stop_after_a_drive() {
    drive();
    rig.command(CancelTask{});
    rig.run_s(5);
    ASSERT_TRUE(rig.out.remembered.place.known);
  }
  /// The program ends, and another one begins; `between` happens while none runs.
  template <class Between>
  void restart(const Between& between, const GeodeticPoint& origin = kRigOrigin) {
    const Remembered left = rig.out.remembered;
    between();
    rig.engine = std::make_unique<Engine>(rig.config);
    rig.engine->recall(left, rig.now);
    rig.tick();
    rig.command(SetOrigin{origin});
    rig.run_s(5);
  }
  void expect_refused(const std::string& reason) {
    rig.start(path, 40, 0.5);
    rig.tick();
    EXPECT_THAT(refusal(), HasSubstr(reason));
    expect_no_motion_for_s(0.5);
  }
  void expect_drives() {
    rig.start(path, 40, 0.5);
    rig.run_s(3);
    EXPECT_GT(rig.fastest_command_radps(), 1) << rig.why() << refusal();
  }
};

TEST_F(ARobotThatIsStartedAgain, DrivesFromWhereItStood) {
  stop_after_a_drive();
  restart([] {});
  expect_drives();
}

/// The receiver jumps while it drives, and does not come back.
TEST_F(ARobotThatIsStartedAgain, StillDoubtsAPositionThatWasDoubtedBefore) {
  drive();
  rig.jump_m += 0.6;  // beyond the corridor
  rig.run_s(65);
  ASSERT_THAT(rig.why(), HasSubstr("position disagrees with odometry"));
  ASSERT_TRUE(rig.out.remembered.place.doubted);
  for (int start = 1; start <= 2; ++start) {
    restart([] {});
    for (int press = 1; press <= 3; ++press) {
      expect_refused("drover position accept");
      rig.run_s(11);
    }
    EXPECT_TRUE(rig.out.remembered.place.doubted);
  }
  rig.command(AcceptPosition{});
  rig.run_s(2);
  EXPECT_FALSE(rig.out.remembered.place.doubted);
  expect_drives();
}

/// Wheels and gyro vote it out, and the next program has no gyro that remembers.
TEST_F(ARobotThatIsStartedAgain, StillDoubtsAHeadingThatWasDoubtedBefore) {
  drive();
  rig.heading_off_deg = 4.5;
  rig.run_s(4);
  ASSERT_THAT(rig.why(), HasSubstr("heading disagrees with odometry"));
  ASSERT_TRUE(rig.out.remembered.place.doubted);
  restart([] {});
  for (int press = 1; press <= 2; ++press) {
    expect_refused("drover position accept");
    rig.run_s(11);
  }
  rig.command(AcceptPosition{});
  rig.run_s(2);
  expect_drives();
}

/// Another program knows no more than the one before it.
TEST_F(ARobotThatIsStartedAgain, SaysOfADoubtedPlaceThatItMayBeWrong) {
  drive();
  rig.jump_m += 0.6;
  rig.run_s(65);
  ASSERT_TRUE(rig.out.remembered.place.doubted);
  ASSERT_GE(rig.engine->snapshot().nav.error_bound_m, 0.6);
  restart([] {});
  EXPECT_GE(rig.engine->snapshot().nav.error_bound_m, 0.6);
}

/// A fix that was found elsewhere, and is in the bound.
TEST_F(ARobotThatIsStartedAgain, SaysOfAFixThatWasFoundElsewhereThatItMayBeWrong) {
  drive();
  rig.quality = FixQuality::rtk_float;
  rig.run_s(2);
  rig.jump_m += 0.15;
  rig.quality = FixQuality::rtk_fixed;
  rig.run_s(10);
  rig.command(CancelTask{});
  rig.run_s(5);
  ASSERT_GE(rig.engine->snapshot().nav.error_bound_m, 0.15);
  restart([] {});
  EXPECT_GE(rig.engine->snapshot().nav.error_bound_m, 0.15);
}

class AJumpOverARestart : public ARobotThatIsStartedAgain,
                          public testing::WithParamInterface<double> {};

TEST_P(AJumpOverARestart, IsToldAndWaitsForASecondStart) {
  stop_after_a_drive();
  restart([&] { rig.jump_m += GetParam(); });
  std::array<char, 64> words{};
  std::snprintf(words.data(), words.size(), "jumped by %.1f m while droverd was not running",
                std::abs(GetParam()));
  expect_refused(words.data());
  rig.run_s(11);
  expect_drives();
}

INSTANTIATE_TEST_SUITE_P(OfTheReceiver, AJumpOverARestart, testing::Values(-0.5, 0.3, 0.5, 1.5));

TEST_F(ARobotThatIsStartedAgain, TellsThatItsHeadingFlipped) {
  stop_after_a_drive();
  restart([&] { rig.heading_off_deg = 180; });
  expect_refused("jumped by 180 degrees while droverd was not running");
}

TEST_F(ARobotThatIsStartedAgain, TellsAJumpThatNobodyHasLookedAtOverOneMoreRestart) {
  stop_after_a_drive();
  restart([&] { rig.jump_m += 0.5; });
  restart([] {});
  expect_refused("jumped by 0.5 m while droverd was not running");
}

TEST_F(ARobotThatIsStartedAgain, TellsAJumpFromBeforeTheRestart) {
  stop_after_a_drive();
  rig.jump_m += 0.5;
  rig.run_s(5);
  restart([] {});
  expect_refused("jumped by 0.5 m");
}

TEST_F(ARobotThatIsStartedAgain, ComparesNoPlacesOfDifferentOrigins) {
  stop_after_a_drive();
  GeodeticPoint beside = kRigOrigin;
  beside.longitude_deg += 1e-5;
  restart([] {}, beside);
  rig.start(path, 40, 0.5);
  rig.tick();
  EXPECT_THAT(refusal(), Not(HasSubstr("jumped")));
}

TEST_F(ARobotThatIsStartedAgain, ComparesNothingWhenItWasPushedBeforeItsPlaceIsKnown) {
  stop_after_a_drive();
  const Remembered left = rig.out.remembered;
  rig.engine = std::make_unique<Engine>(rig.config);
  rig.engine->recall(left, rig.now);
  rig.carried = WheelSpeeds{3, 3};
  rig.run_s(1);
  rig.carried.reset();
  rig.run_s(3);
  rig.set_origin();
  rig.run_s(15);
  rig.start(path, 40, 0.5);
  rig.tick();
  EXPECT_THAT(refusal(), Not(HasSubstr("jumped")));
}

TEST_F(ARobotThatIsStartedAgain, RemembersNoPlaceWhileItDrives) {
  drive();
  EXPECT_FALSE(rig.out.remembered.place.known);
}

TEST_F(ARobotThatIsStartedAgain, RemembersItsPlaceWithoutWritingItInEachCycle) {
  stop_after_a_drive();
  int changes = 0;
  Remembered last = rig.out.remembered;
  for (int i = 0; i < 2000; ++i) {
    rig.tick();
    changes += rig.out.remembered == last ? 0 : 1;
    last = rig.out.remembered;
  }
  EXPECT_LE(changes, 40);
}

}  // namespace
}  // namespace drover::engine
