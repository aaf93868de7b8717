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

}  // namespace
}  // namespace drover::text
