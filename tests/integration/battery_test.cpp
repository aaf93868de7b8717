// The battery from its pseudo-terminal to the operator's screen, and what becomes of it when its
// line or its device does everything wrong.
#include <gmock/gmock.h>

#include "integration/robot_rig.h"

namespace drover::test {
namespace {

using testing::HasSubstr;

class ABattery : public RobotRig {
 protected:
  bool wait_for_valid(bool valid) {
    return wait_until([&] { return status_text("bms", "valid") == (valid ? "true" : "false"); });
  }
  void start_with_battery() {
    ASSERT_NO_FATAL_FAILURE(start_all());
    ASSERT_TRUE(wait_for_valid(true));
  }
};

TEST_F(ABattery, IsShownToTheOperatorAndToTheEngineer) {
  ASSERT_NO_FATAL_FAILURE(start_with_battery());
  EXPECT_NEAR(status_number("bms", "soc"), 84, 1);
  EXPECT_NEAR(status_number("robot", "power"), 84, 1);
  EXPECT_NEAR(status_number("bms", "voltage"), 26.4, 1);
  EXPECT_LT(status_number("bms", "current"), 0);
  EXPECT_EQ(status_number("bms", "error"), 0);
  EXPECT_EQ(status_number("bms", "status"), 2);
  EXPECT_THAT(drover({"status"}).text, HasSubstr("battery   8"));
}

TEST_F(ABattery, IsUnknownButKeepsItsLastWordWhateverItsLineDoes) {
  ASSERT_NO_FATAL_FAILURE(start_with_battery());
  // What is wrong in the answers never reaches a value: the state of charge stays.
  for (const char* fault : {"silent", "wrong_crc", "other_unit", "drip", "slow"}) {
    ASSERT_EQ(sim({"battery", fault}), "ok\n");
    ASSERT_TRUE(wait_for_valid(false)) << fault;
    EXPECT_EQ(status_number("bms", "error"), 1);
    EXPECT_NEAR(status_number("bms", "soc"), 84, 1) << fault;
    ASSERT_EQ(sim({"battery", "well"}), "ok\n");
    ASSERT_TRUE(wait_for_valid(true)) << fault;
  }
  EXPECT_TRUE(wait_until([&] { return status_text("nav", "locate") == "LOCATE_TRUE"; }))
      << "the control loop went on";
}

TEST_F(ABattery, ComesBackWhenItsAdapterIsPluggedInAgain) {
  ASSERT_NO_FATAL_FAILURE(start_with_battery());
  ASSERT_EQ(sim({"battery", "unplug"}), "ok\n");
  ASSERT_TRUE(wait_for_valid(false));
  EXPECT_THAT(drover({"status"}).text, HasSubstr("battery unknown: no line to it"));
  ASSERT_EQ(sim({"battery", "plug"}), "ok\n");
  EXPECT_TRUE(wait_for_valid(true));
}

TEST_F(ABattery, ThatChargesLetsNothingStartAndEndsATask) {
  ASSERT_NO_FATAL_FAILURE(start_with_battery());
  ASSERT_NO_FATAL_FAILURE(drive(10));
  ASSERT_EQ(sim({"battery", "charger", "plug"}), "ok\n");
  ASSERT_TRUE(wait_for_status("NAV_ERROR"));
  ASSERT_TRUE(wait_until([&] { return at_rest(); }));
  const auto before = client().heard().size();
  start_task("row", 21);
  ASSERT_TRUE(wait_for_feedback("start_task_failse", before));
  EXPECT_THAT(client().last("feedback"), HasSubstr("charging: unplug the charger first"));
}

}  // namespace
}  // namespace drover::test
