// What a scenario's end is judged by.
#include "sim/scenario/task_result.h"

#include <gtest/gtest.h>

namespace drover::sim {
namespace {

constexpr Time at_s(int s) {
  return Time(std::chrono::seconds(s));
}

TEST(ATaskResult, IsHowTheTaskEnded) {
  TaskResult result;
  EXPECT_EQ(result.status, "");
  result.happened("start_nav", "NAV_RUN", at_s(1));
  result.happened("nav_error", "NAV_ERROR", at_s(2));
  EXPECT_EQ(result.status, "NAV_ERROR");
  EXPECT_EQ(result.begin, at_s(1));
  EXPECT_EQ(result.end, at_s(2));
}

TEST(ATaskResult, IsNotThatOfAnEarlierTaskWhenALaterOneDidNotEnd) {
  TaskResult result;
  result.happened("start_nav", "NAV_RUN", at_s(1));
  result.happened("nav_success", "NAV_SUCCESS", at_s(2));
  result.happened("start_nav", "NAV_RUN", at_s(3));
  EXPECT_EQ(result.status, "");
  EXPECT_EQ(result.end, kNever);
  EXPECT_EQ(result.begin, at_s(1)) << "the whole drive is measured";
}

TEST(ATaskResult, StaysWhenALaterOneIsRefusedOrTheGatewayStartsAnew) {
  TaskResult result;
  result.happened("start_nav", "NAV_RUN", at_s(1));
  result.happened("nav_success", "NAV_SUCCESS", at_s(2));
  for (const char* event : {"start_task_failed", "exit_droverd", "ready"})
    result.happened(event, "NAV_FREE", at_s(3));
  EXPECT_EQ(result.status, "NAV_SUCCESS");
}

}  // namespace
}  // namespace drover::sim
