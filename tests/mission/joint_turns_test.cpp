// Joint commands that turn the base on the spot before its mechanics are proved: slow, and the
// tyres unwind at each change of direction. Nothing is wrong with such a robot.
#include <string>

#include "drover/angle.h"
#include "mission/robot.h"
#include "mission/support.h"

namespace drover::mission {
namespace {

using testing::HasSubstr;
using testing::Not;

// navigate.first_way_m: so fast at the rim, whatever is asked.
constexpr double kFirst_mps = 0.05;

TEST(JointTurns, OnTheFirstWayTurnTheRobotToBothSidesAndAreNoFault) {
  const Record& log = record("joint_turns");
  for (int turn = 1; turn <= 4; ++turn) {
    SCOPED_TRACE(turn);
    const Time begin = log.event("event turn_" + std::to_string(turn) + "#1");
    const Time end = begin + 3s + kStreamTimeout;
    const double turned_deg =
        to_deg(wrap_rad(log.truth_at(end).yaw_rad - log.truth_at(begin).yaw_rad));
    figure("turned", turned_deg, "degrees");
    EXPECT_GT(turn % 2 == 1 ? turned_deg : -turned_deg, 1.5);
    for (const auto& one : log.moving(begin, end))
      ASSERT_LE(std::abs(log.rim_mps(one)), 1.1 * kFirst_mps) << seconds(one.time);
  }
  for (const auto& status : log.statuses) {
    ASSERT_THAT(status.document.at("nav").dump(), Not(HasSubstr("does not follow")))
        << seconds(status.time);
  }
}

}  // namespace
}  // namespace drover::mission
