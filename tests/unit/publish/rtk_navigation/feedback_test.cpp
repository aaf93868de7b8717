#include "publish/rtk_navigation/feedback.h"

#include <gtest/gtest.h>

namespace drover::publish {
namespace {

TEST(Feedback, HasTheDocumentsShape) {
  EXPECT_EQ(feedback_text(success_cmd(Verb::delete_trajectory), {}, {}),
            "{\"cmd\":\"delete_trajectory_success\",\"cmd_type\":\"feedback\"}");
  EXPECT_EQ(feedback_text(failure_cmd(Verb::start_nav), "why", {}),
            "{\"cmd\":\"start_nav_failse\",\"cmd_type\":\"feedback\",\"reason\":\"why\"}");
}

}  // namespace
}  // namespace drover::publish
