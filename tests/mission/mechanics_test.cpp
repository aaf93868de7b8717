// Robots that are built otherwise than configured: found on the first centimetres.
#include "mission/support.h"

namespace drover::mission {
namespace {

struct WrongMechanics {
  const char* mission;
  const char* reason;
};
/// How a test shows which one it is.
void PrintTo(const WrongMechanics& wrong, std::ostream* out) {
  *out << wrong.mission;
}
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

TEST_P(Mechanics, AreFoundWithinTwentyCentimetres) {
  const Record& log = record(GetParam().mission);
  const Time start = log.answered("start_nav_success");
  const auto moving = log.moving(start - 1s, Time::max());
  ASSERT_FALSE(moving.empty()) << "it never moved";
  const double way = way_m(log, start - 1s, moving.back().time);
  std::printf("  %.3f m, %.1f s\n", way, to_s(moving.back().time - moving.front().time));
  EXPECT_LT(way, 0.2);
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
                                         WrongMechanics{"wheel_reversed", "wheel reversed"}),
                         [](const auto& one) { return std::string(one.param.mission); });

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
