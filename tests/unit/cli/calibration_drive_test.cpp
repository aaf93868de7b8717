// The whole drive of a calibration, by a key that a person holds: the engine drives it in a field
// with planted errors, and they are found. And what it does when something is not as it should be.
#include "cli/calibration_drive.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <set>

#include "bench/field_world.h"
#include "cli/drive_values.h"
#include "publish/hand_outlet.h"
#include "support/seeds.h"

namespace drover::cli {
namespace {

using calibrate::Quantity;
using testing::HasSubstr;
using namespace std::chrono_literals;

/// A terminal that repeats its key 30 times a second, and a person who lets it go now and then.
class Person {
 public:
  explicit Person(const engine::EngineConfig& config) : drive(config) {}

  std::optional<Twist> look(const Snapshot& seen, Time now) {
    if (begun_ == kNever) begun_ = now + 1s;
    if (now < next_look_) return std::nullopt;
    next_look_ = now + 10ms;
    const bool stalls = drive.recipe().at() >= stalls_from_piece &&
                        std::fmod(to_s(now - begun_), stalls_each_s) < stalls_s;
    if (stalls) return std::nullopt;
    if (drive.line().find("let the key go first") != std::string::npos) lets_go_until_ = now + 1s;
    const bool key = holds(to_s(now - begun_)) && now >= next_key_ && now > lets_go_until_;
    if (key) next_key_ = now + 33ms;
    // As the socket carries it.
    const auto document = json::parse(publish::drive_values_json(seen));
    const auto twist = drive.look(now, key ? now - key_age : kNever, snapshot_of(document->root));
    if (twist) fastest_asked_mps = std::max(fastest_asked_mps, std::abs(twist->vx_mps));
    if (lines.empty() || drive.recipe().at() != piece_) lines.push_back(drive.line());
    piece_ = drive.recipe().at();
    return twist;
  }
  bool holds(double at_s) const {
    return at_s >= 0 && !(at_s > pauses_at_s && at_s < goes_on_at_s);
  }

  CalibrationDrive drive;
  double stalls_s = 0;  ///< for so long nothing is asked or looked at
  double stalls_each_s = 1;
  std::size_t stalls_from_piece = 0;
  Duration key_age{};
  double pauses_at_s = INFINITY;
  double goes_on_at_s = INFINITY;
  double fastest_asked_mps = 0;
  std::vector<std::string> lines;

 private:
  Time begun_ = kNever;
  Time next_look_ = kNever;
  Time next_key_ = kNever;
  Time lets_go_until_ = kNever;  ///< as he is told
  std::size_t piece_ = 0;
};

struct Box {
  double ahead_m = 0, behind_m = 0, left_m = 0, right_m = 0;
  void add(const Pose& pose) {
    ahead_m = std::max(ahead_m, pose.x_m);
    behind_m = std::max(behind_m, -pose.x_m);
    left_m = std::max(left_m, pose.y_m);
    right_m = std::max(right_m, -pose.y_m);
  }
};

class ACalibrationDrive : public ::testing::Test {
 protected:
  static engine::EngineConfig config() {
    auto config = bench::field_config();
    config.base.yaw_slip_factor = 1.3;  // it is 1.2
    return config;
  }
  /// Within `limit_s`.
  void drive(Person& person, bench::FieldWorld& world, double limit_s = 600) {
    world.drive_by_hand(limit_s, {[&](const Snapshot& seen, Time now) {
                                    box.add(world.true_pose());
                                    if (!fast())
                                      fastest_slow_mps_ = std::max(
                                          fastest_slow_mps_, std::abs(world.true_pose().vx_mps));
                                    took_s = to_s(now) - 10;
                                    piece_ = person.drive.recipe().at();
                                    const auto said = person.look(seen, now);
                                    if (person.drive.line().find("paused") != std::string::npos)
                                      paused_owners.insert(seen.nav.owner);
                                    return said;
                                  },
                                  [&](bool ok, std::string_view text) {
                                    person.drive.answered(ok, std::string(text));
                                    if (!ok) refusals.emplace_back(text);
                                  },
                                  [&] { return person.drive.ended(); }});
  }
  bool fast() const { return piece_ > 4; }

  Box box;
  double fastest_slow_mps_ = 0;
  double took_s = 0;
  std::vector<std::string> refusals;
  std::set<Owner> paused_owners;

 private:
  std::size_t piece_ = 0;
};

TEST_F(ACalibrationDrive, FindsWhatIsPlantedAndStaysInItsArea) {
  bench::FieldPlan plan;
  plan.tyres = 1.03;
  plan.lever_x_m = 0.1;
  plan.lever_y_m = -0.1;
  plan.late_s = 0.1;
  plan.heading_off_deg = 2;
  for (std::uint64_t seed = 1; seed <= test::seeds(3); ++seed) {
    SCOPED_TRACE(seed);
    box = {};
    Person person(config());
    bench::FieldWorld world(config(), plan, seed);
    drive(person, world);
    ASSERT_TRUE(person.drive.ended()) << person.drive.line();
    ASSERT_EQ(person.drive.problem(), "");
    EXPECT_THAT(refusals, testing::IsEmpty());
    EXPECT_LE(fastest_slow_mps_, 0.11);
    const auto area = person.drive.recipe().area();
    EXPECT_LT(box.ahead_m, area.ahead_m);
    EXPECT_LT(box.behind_m, area.behind_m);
    EXPECT_LT(box.left_m, area.left_m);
    EXPECT_LT(box.right_m, area.right_m);
    const auto result = calibrate::calibrate(person.drive.drive(), configured_of(config()));
    ASSERT_EQ(result.refused, "");
    std::printf("seed %d: %.0f s, area %.0f + %.0f by %.0f + %.0f m\n", static_cast<int>(seed),
                took_s, box.ahead_m, box.behind_m, box.left_m, box.right_m);
    for (const auto& [what, truth] :
         {std::pair{Quantity::wheel_radius_m, 0.165 * 1.03},
          std::pair{Quantity::yaw_slip_factor, 1.2}, std::pair{Quantity::antenna_x_m, 0.2},
          std::pair{Quantity::antenna_y_m, -0.1}, std::pair{Quantity::heading_offset_deg, 2.0},
          std::pair{Quantity::position_late_s, 0.1}, std::pair{Quantity::heading_late_s, 0.1},
          std::pair{Quantity::gyro_scale, 1 / 1.002}, std::pair{Quantity::gyro_bias_radps, 0.005},
          std::pair{Quantity::drive_lag_s, 0.12}}) {
      const auto& found = result.of(what);
      EXPECT_EQ(found.refused, "") << static_cast<int>(what);
      EXPECT_NEAR(found.value, truth, found.interval) << static_cast<int>(what);
      std::printf("  %2d planted %8.4f found %8.4f +- %.4f\n", static_cast<int>(what), truth,
                  found.value, found.interval);
    }
  }
}
TEST_F(ACalibrationDrive, PausesWhileTheKeyIsUpAndGoesOn) {
  Person person(config());
  person.pauses_at_s = 90;
  person.goes_on_at_s = 100;
  bench::FieldWorld world(config(), {}, 1);
  drive(person, world, 95);
  EXPECT_THAT(person.drive.line(), HasSubstr("paused: hold the space key"));
  EXPECT_LT(std::abs(world.true_pose().vx_mps), 0.001);
  EXPECT_THAT(paused_owners, testing::ElementsAre(Owner::manual)) << "nobody else takes it";
  const double done = person.drive.recipe().done();
  drive(person, world, 10);
  EXPECT_GT(person.drive.recipe().done(), done + 1);
  drive(person, world, 600);
  EXPECT_TRUE(person.drive.ended());
  EXPECT_EQ(person.drive.problem(), "");
}
TEST_F(ACalibrationDrive, StaysInItsAreaWhenEverythingStallsAgainAndAgain) {
  for (const auto& [stalls_s, each_s] : {std::pair{0.28, 1.0}, {0.5, 2.0}, {1.5, 5.0}}) {
    if (test::kSanitized && stalls_s != 0.5) continue;
    SCOPED_TRACE(stalls_s);
    box = {};
    Person person(config());
    person.stalls_s = stalls_s;
    person.stalls_each_s = each_s;
    person.stalls_from_piece = 5;  // the fast ones
    bench::FieldWorld world(config(), {}, 1);
    drive(person, world, 2000);
    ASSERT_TRUE(person.drive.ended()) << person.drive.line();
    const auto area = person.drive.recipe().area();
    EXPECT_LT(box.ahead_m, area.ahead_m);
    EXPECT_LT(box.behind_m, area.behind_m);
    EXPECT_LT(box.left_m, area.left_m);
    EXPECT_LT(box.right_m, area.right_m);
    std::printf("stalls of %.2f s: area %.1f + %.1f by %.1f + %.1f m\n", stalls_s, box.ahead_m,
                box.behind_m, box.left_m, box.right_m);
  }
}
TEST_F(ACalibrationDrive, AKeyThatGrewOldOnItsWayDrivesNothing) {
  Person person(config());
  person.key_age = 150ms;
  bench::FieldWorld world(config(), {}, 1);
  drive(person, world, 30);
  EXPECT_EQ(box.ahead_m, 0);
  EXPECT_THAT(person.drive.line(), HasSubstr("answers too slowly"));
}
TEST_F(ACalibrationDrive, DrivesNothingWithoutAFix) {
  Person person(config());
  bench::FieldPlan plan;
  plan.float_s = {0, 1000};
  bench::FieldWorld world(config(), plan, 1);
  drive(person, world, 60);
  EXPECT_EQ(box.ahead_m, 0);
  EXPECT_THAT(person.drive.line(), HasSubstr("no RTK fix"));
}
TEST_F(ACalibrationDrive, IsStoppedOnTheFirstWayWhereTheSidesAreSwapped) {
  auto wrong = config();
  std::swap(wrong.base.left, wrong.base.right);
  Person person(wrong);
  bench::FieldWorld world(wrong, {}, 1);
  drive(person, world, 60);
  EXPECT_LT(box.ahead_m, 0.4);
  EXPECT_THAT(person.drive.line(), HasSubstr("sides swapped"));
}
TEST(CalibrationIntro, SaysWhichAreaAndWhatItDoes) {
  const CalibrationDrive drive(bench::field_config());
  const auto text = drive.intro();
  for (const char* words :
       {"ahead of the robot", "to its left", "e-stop in your hand", "space key", "RTK fix",
        "you answer for", "2.4 to 3.4 m across", "0.6 s after you let go", "0.7 m until it stands"})
    EXPECT_THAT(text, HasSubstr(words));
}
TEST(CalibrationIntro, SaysTheNumbersOfThisRobot) {
  auto config = bench::field_config();
  config.limits.max_speed_mps = 0.3;
  config.limits.deceleration_mps2 = 0.1;
  const auto text = CalibrationDrive(config).intro();
  for (const char* words : {"at up to 0.3 m/s", "About 4 minutes", "0.6 m until it stands"})
    EXPECT_THAT(text, HasSubstr(words));
}
TEST(CalibrationIntro, IsWhatTheReadmeShows) {
  std::ifstream file(DROVER_SOURCE_DIR "/src/cli/README.md");
  const std::string readme((std::istreambuf_iterator<char>(file)), {});
  EXPECT_NE(readme.find(CalibrationDrive(bench::field_config()).intro()), std::string::npos)
      << CalibrationDrive(bench::field_config()).intro();
}

TEST(CalibrationDrive, SaysThatItsCirclesAreTooTightForABaseThatSteers) {
  engine::BaseConfig base;
  EXPECT_EQ(not_calibrated(base), "");
  base.kind = engine::BaseKind::ackermann;
  base.max_steering_rad = 0.55;
  EXPECT_EQ(not_calibrated(base), "");
  base.wheelbase_m = 1.5;
  EXPECT_NE(not_calibrated(base).find("this base needs 2.75 m"), std::string::npos)
      << not_calibrated(base);
  base = {};
  base.kind = engine::BaseKind::mecanum;
  EXPECT_NE(not_calibrated(base).find("act as one: measure them"), std::string::npos);
}

}  // namespace
}  // namespace drover::cli
