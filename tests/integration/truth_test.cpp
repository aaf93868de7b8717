// What the gateway says is so: also when a part of it stands still, and when a track contradicts
// itself.
#include <gmock/gmock.h>

#include <cmath>

#include "integration/robot_rig.h"
#include "json/located_json.h"
#include "sim/scenario/held_thread.h"

namespace drover::test {
namespace {

using testing::ContainsRegex;
using testing::HasSubstr;
using testing::Not;

class Truth : public RobotRig {};

TEST_F(Truth, EveryViewSaysThatNobodyLooksWhenTheControlThreadStandsStill) {
  ASSERT_NO_FATAL_FAILURE(start_all());
  ASSERT_NO_FATAL_FAILURE(drive(8));
  EXPECT_EQ(status_text("robot", "valid"), "true");
  sim::HeldThread control(daemon().pid(), "control");
  if (!control.held()) GTEST_SKIP() << "this system lets nobody hold a thread";
  EXPECT_TRUE(wait_until([this] { return status_text("robot", "valid") == "false"; }));
  EXPECT_EQ(status_text("nav", "status"), "NAV_ERROR");
  EXPECT_EQ(status_text("nav", "locate"), "LOCATE_FALSE");
  for (const char* sensor : {"imu", "robot"}) EXPECT_EQ(status_text("sensor", sensor), "false");
  EXPECT_EQ(status_number("rtk", "status"), 0);
  EXPECT_THAT(client().last("base_status"), HasSubstr("the control thread has stood still for"));
  const auto shown = drover({"status"}).text;
  EXPECT_THAT(shown, HasSubstr("the control thread has stood still for"));
  EXPECT_THAT(shown, Not(HasSubstr("fresh")));
  EXPECT_TRUE(wait_until([this] { return at_rest(); })) << "the guard stopped it";
  control.let_go();
  EXPECT_TRUE(wait_until([this] { return status_text("robot", "valid") == "true"; }));
}

TEST_F(Truth, ATrackOfAnotherOriginThanItsOwnIsRefusedWithPointAndDistance) {
  ASSERT_NO_FATAL_FAILURE(start_all());
  const auto recorded = track_ahead("old", 4);
  ASSERT_NO_FATAL_FAILURE(drive(1));
  ASSERT_TRUE(wait_for_status("NAV_SUCCESS"));
  ASSERT_TRUE(wait_until([this] { return at_rest(); }));
  auto before = client().heard().size();
  control(R"({"cmd_type": "task_control", "cmd": "init_rtk_data"})");
  ASSERT_TRUE(wait_for_feedback("init_rtk_data_success", before));

  before = client().heard().size();
  control(recorded);
  ASSERT_TRUE(wait_for_feedback("save_trajectory_success", before)) << "all is kept as it came";
  before = client().heard().size();
  start_task("old", 9);
  ASSERT_TRUE(wait_for_feedback("start_task_failse", before));
  EXPECT_THAT(client().last("feedback"), ContainsRegex("point 1: x, y are (0\\.9|1\\.0|1\\.1)"));
  EXPECT_TRUE(at_rest());
  // Recorded anew it is driven; anew is from what the robot says after its origin was moved.
  ASSERT_TRUE(wait_until([this] { return std::abs(status_number("pose", "x")) < 0.5; }));
  ASSERT_NO_FATAL_FAILURE(drive(1));
  EXPECT_TRUE(wait_for_status("NAV_SUCCESS"));
}

}  // namespace
}  // namespace drover::test
