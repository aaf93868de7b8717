#include "text/number.h"

#include <gtest/gtest.h>

namespace drover::text {
namespace {

TEST(NumberText, HasNoZerosBehind) {
  EXPECT_EQ(number_text(0.5), "0.5");
  EXPECT_EQ(number_text(200), "200");
  EXPECT_EQ(number_text(-1e6), "-1000000");
}

TEST(NumberText, RoundsToTenDigits) {
  EXPECT_EQ(number_text(0.1 + 0.2), "0.3");
}

TEST(Formed, WritesOneNumberByItsForm) {
  EXPECT_EQ(formed("%.2f m", 0.5), "0.50 m");
}

TEST(Counted, HasTheWordForOneAndForMany) {
  EXPECT_EQ(counted(0, "hole", "holes"), "0 holes");
  EXPECT_EQ(counted(1, "hole", "holes"), "1 hole");
  EXPECT_EQ(counted(2, "hole", "holes"), "2 holes");
}

}  // namespace
}  // namespace drover::text
