// Robots that are built otherwise than configured: found on the first centimetres.
#include <string_view>

#include "drover/angle.h"
#include "mission/robot.h"
#include "mission/support.h"

namespace drover::mission {
namespace {

struct WrongMechanics {
  const char* mission;
  const char* reason;
  double most_m = 0.2;  ///< until it is found
};
/// How a test shows which one it is.
void PrintTo(const WrongMechanics& wrong, std::ostream* out) {
  *out << wrong.mission;
}
/// What only the receiver's places show, which are a centimetre off: slowly all the way.
constexpr double kByPlaces_m = 0.35;
class Mechanics : public testing::TestWithParam<WrongMechanics> {};

/// The true way of the base, turns on the spot left out.
double way_m(const Record& log, Time begin, Time end) {
  double way = 0;
  for (std::size_t i = 1; i < log.truth.size(); ++i) {
    const auto& line = log.truth[i];
    if (line.time < begin || line.time > end) continue;
    way += std::hypot(line.x_m - log.truth[i - 1].x_m, line.y_m - log.truth[i - 1].y_m);
  }
  return way;
}

TEST_P(Mechanics, AreFoundOnTheFirstCentimetres) {
  const Record& log = record(GetParam().mission);
  const Time start = log.answered("start_nav_success");
  const auto moving = log.moving(start - 1s, Time::max());
  ASSERT_FALSE(moving.empty()) << "it never moved";
  const double way = way_m(log, start - 1s, moving.back().time);
  std::printf("  %.3f m, %.1f s\n", way, to_s(moving.back().time - moving.front().time));
  EXPECT_LT(way, GetParam().most_m);
}

TEST_P(Mechanics, AreNamed) {
  const Record& log = record(GetParam().mission);
  const auto& error = log.first_status("NAV_ERROR");
  EXPECT_NE(error.why.find(GetParam().reason), std::string::npos) << error.why;
}

INSTANTIATE_TEST_SUITE_P(Each, Mechanics,
                         testing::Values(WrongMechanics{"gear_ratio_10", "gear ratio"},
                                         WrongMechanics{"gear_ratio_2", "gear ratio"},
                                         WrongMechanics{"sides_swapped", "sides swapped"},
                                         WrongMechanics{"sides_swapped_unseen", "sides swapped",
                                                        kByPlaces_m},
                                         WrongMechanics{"axle_crossed", "swapped on one axle"},
                                         WrongMechanics{"wheel_reversed", "wheel reversed"}),
                         [](const auto& one) { return std::string(one.param.mission); });

/// Also the search for the heading, straight on, is no proof.
TEST(SidesSwappedUnseen, AreFoundBeforeItDrivesFast) {
  const Record& log = record("sides_swapped_unseen");
  const Time start = log.answered("start_nav_success");
  double fastest_mps = 0;
  double turned_rad = 0;
  for (const TruthLine& line : log.truth) {
    if (line.time < start) continue;
    fastest_mps = std::max(fastest_mps, std::abs(line.vx_mps));
    turned_rad = std::max(turned_rad, std::abs(line.yaw_rad));
  }
  figure("fastest", fastest_mps, "m/s");
  figure("turned", to_deg(turned_rad), "degrees");
  EXPECT_LT(fastest_mps, 0.08);
  EXPECT_LT(to_deg(turned_rad), 20);
}

/// The wheels of one axle against those of the other: faster than on the first way they would
/// scrub, and be told as slip alone.
TEST(AxleCrossed, StopsBeforeItsWheelsWorkAgainstEachOtherFast) {
  const Record& log = record("axle_crossed");
  double fastest_mps = 0;
  for (const auto& one : log.moving(log.answered("start_nav_success") - 1s, Time::max()))
    fastest_mps = std::max(fastest_mps, std::abs(log.rim_mps(one)));
  figure("fastest rim", fastest_mps, "m/s");
  EXPECT_LT(fastest_mps, 0.2);
}

/// Its drives follow a small difference of the sides badly, and its tyres take up some of it.
TEST(StraightAndUturn, TurnsARobotThatSkidsToBothSidesOnItsFirstWay) {
  const Record& log = record("straight_and_uturn");
  const Time begin = log.answered("start_nav_success") - 1s;
  const auto from = log.truth_at(begin);
  double left_deg = 0;
  double right_deg = 0;  // from there
  double way = 0;
  for (const auto& line : log.truth) {
    if (line.time < begin) continue;
    way = std::hypot(line.x_m - from.x_m, line.y_m - from.y_m);
    if (line.vx_mps > 0.1) break;
    const double turned_deg = to_deg(wrap_rad(line.yaw_rad - from.yaw_rad));
    left_deg = std::max(left_deg, turned_deg);
    right_deg = std::max(right_deg, left_deg - turned_deg);
  }
  figure("first way", way, "m");
  figure("left", left_deg, "degrees");
  figure("right", right_deg, "degrees");
  EXPECT_GT(left_deg, 2.8);
  EXPECT_GT(right_deg, 2.8);
  EXPECT_LT(way, 0.7);
}

TEST(ImuUpsideDown, IsNamedAndNothingMoves) {
  const Record& log = record("imu_upside_down");
  ASSERT_FALSE(log.feedback.empty());
  EXPECT_EQ(log.feedback.back().cmd, "start_task_failse");
  EXPECT_NE(log.feedback.back().reason.find("gravity on the wrong axis"), std::string::npos)
      << log.feedback.back().reason;
  EXPECT_TRUE(log.moving().empty());
}

TEST(StartWhileRolling, IsRefusedAndNothingMoves) {
  const Record& log = record("start_while_rolling");
  const Time refused = log.event("event refused#1");
  EXPECT_GT(log.truth_at(refused).vx_mps, 0.1) << "it does not roll";
  EXPECT_EQ(log.feedback_words(),
            (std::vector<std::string>{"save_trajectory_success", "start_task_failse"}));
  EXPECT_NE(log.feedback.at(1).reason.find("without a command"), std::string::npos)
      << log.feedback.at(1).reason;
  EXPECT_TRUE(log.moving().empty());
}

}  // namespace
}  // namespace drover::mission
