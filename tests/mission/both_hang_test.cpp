// droverd and drover-guard stand still together while the robot drives: nobody is there who could
// stop it, and its motors go on by the last current that they were told.
#include <string>

#include "mission/support.h"

namespace drover::mission {
namespace {

constexpr const char* kName = "both_hang";

/// What droverd wrote into its log.
std::string journal(const Record& log) {
  return said(log, "droverd.log");
}

TEST(BothHang, ForLessThanTheGuardsLimitAndItsCyclesIsToldAndNoMore) {
  const Record& log = record(kName);
  const Time back = log.event("signal 18 to droverd");
  const Time again = log.event("signal 19 to droverd", 2);
  ASSERT_TRUE(moved_until(log, log.event("signal 19 to droverd"))) << "it did not drive";
  EXPECT_TRUE(moved_until(log, again)) << "it stopped";
  expect_nav_stays(log, "NAV_RUN", back, again);
  EXPECT_NE(journal(log).find("ms while the robot moved, and nobody steered meanwhile"),
            std::string::npos);
}

TEST(BothHang, ForLongerStopsTheRobotAsSoonAsDroverdGoesOn) {
  const Record& log = record(kName);
  const Time back = log.event("signal 18 to droverd", 2);
  const Time started = next_start(log, back);
  const auto& error = log.first_status("NAV_ERROR", back);
  EXPECT_LE(error.time - back, 200ms);
  EXPECT_NE(error.why.find("droverd stood still for 0."), std::string::npos) << error.why;
  const Roll rolled = roll(log, back, started);
  tell_way_to_rest(log, back, started);
  EXPECT_LT(rolled.rest - back, 1500ms);
  EXPECT_LT(rolled.way_m, 0.5);
  expect_rest_until_started(log, back + 1500ms);
}

TEST(BothHang, IsFollowedByANewStartThatReachesTheGoal) {
  const Record& log = record(kName);
  expect_new_start_succeeds(log, log.event("signal 18 to droverd", 2));
}

}  // namespace
}  // namespace drover::mission
