// A new start from wherever on its track the robot stands: it goes on from there, to the end.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "unit/engine/navigate/tracker_rig.h"

namespace drover::engine {
namespace {

std::uint32_t last(const Path& path) {
  return static_cast<std::uint32_t>(path.points.size() - 1);
}

/// A bow that crosses its own first leg square, and goes on.
Points bow() {
  Pen pen;
  pen.line(8).arc(2, 1.5 * kPi).line(6);
  return pen.points();
}

/// Stops everywhere along `drawn`, `each_m` apart, and starts anew. `looks_back`: the way is driven
/// backwards there. What is driven then is what was left.
void resume_everywhere(const std::string& name, const Points& drawn, const Path& path,
                       double each_m, const std::vector<std::uint8_t>& looks_back = {}) {
  constexpr double kPoint_m = 0.01;
  constexpr double kEnd_m = 1;
  double most_m = 0;
  int starts = 0;
  const auto step = static_cast<std::size_t>(each_m / kPoint_m);
  const auto end = drawn.size() - static_cast<std::size_t>(kEnd_m / kPoint_m);
  for (std::size_t at = step; at < end; at += step) {
    const bool back = !looks_back.empty() && looks_back[at] != 0;
    DriveSetup setup;
    setup.x_m = drawn[at].x_m;
    setup.y_m = drawn[at].y_m;
    setup.yaw_rad = wrap_rad(
        std::atan2(drawn[at + 5].y_m - drawn[at - 5].y_m, drawn[at + 5].x_m - drawn[at - 5].x_m) +
        (back ? kPi : 0));
    setup.plant.seed = static_cast<unsigned>(at);
    const Drive way = drive(path, last(path), setup);
    ++starts;
    SCOPED_TRACE(name + ", started at " + std::to_string(static_cast<double>(at) * kPoint_m) +
                 " m");
    EXPECT_TRUE(way.arrived);
    EXPECT_LT(way.max_m, 0.05);
    EXPECT_LT(way.final_m, 0.05);
    most_m = std::max(most_m, way.max_m);
    // driven_m goes down where it drives backwards.
    if (looks_back.empty()) {
      const double left_m = static_cast<double>(drawn.size() - 1 - at) * kPoint_m;
      EXPECT_NEAR(way.driven_m, left_m, 0.05 * left_m + 0.2);
    }
  }
  std::printf("%-16s %2d starts, at most %.1f cm beside\n", name.c_str(), starts, 100 * most_m);
}

TEST(TrackerResume, GoesOnOverACrossingOfItsOwnTrack) {
  resume_everywhere("bow", bow(), record(bow()), 0.9);
}
TEST(TrackerResume, GoesOnAlongRows) {
  resume_everywhere("rows", rows(), record(rows()), 2.7);
}
TEST(TrackerResume, GoesOnRoundALoop) {
  resume_everywhere("loop", test::loop(), record(test::loop()), 2.3);
}
TEST(TrackerResume, GoesOnInEachGearOfAThreePointTurn) {
  const Points drawn = test::three_point_turn();
  const Path path = test::with_gears(record(drawn));
  // The second piece, between the cusps, is the one that is driven backwards.
  Path fine;
  fine.points = drawn;
  resume_everywhere("three-point turn", drawn, path, 1.0, test::with_gears(fine).backwards);
}

}  // namespace
}  // namespace drover::engine
