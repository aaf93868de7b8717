#include "engine/health/arm_wait.h"

#include <gtest/gtest.h>

namespace drover::engine {
namespace {

TEST(WaitingForDrives, BelievesNothingThatTheyReportedBeforeTheyWereAsked) {
  ArmWait wait;
  EXPECT_EQ(wait.look(true, false), Drives::asked) << "it still holds from the one before";
  EXPECT_EQ(wait.look(false, false), Drives::arming);
  EXPECT_EQ(wait.look(true, false), Drives::armed);
}
TEST(WaitingForDrives, EndsWhenTheyDoNotRunInTime) {
  ArmWait wait;
  (void)wait.look(false, false);
  EXPECT_EQ(wait.look(false, false), Drives::arming);
  EXPECT_EQ(wait.look(false, true), Drives::late);
}
TEST(WaitingForDrives, EndsWhenTheyRanAndDoNoMoreHoweverEarly) {
  ArmWait wait;
  (void)wait.look(false, false);
  (void)wait.look(true, false);
  EXPECT_EQ(wait.look(false, false), Drives::lost);
}
TEST(WaitingForDrives, BeginsAnewForTheNextOne) {
  ArmWait wait;
  (void)wait.look(true, false);
  (void)wait.look(true, false);
  wait.begin();
  EXPECT_EQ(wait.look(false, false), Drives::asked);
  EXPECT_EQ(wait.look(false, false), Drives::arming);
}

}  // namespace
}  // namespace drover::engine
