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

}  // namespace
}  // namespace drover::mission
