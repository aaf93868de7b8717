#include "link/line_number.h"

#include <gtest/gtest.h>

namespace drover::link {
namespace {

TEST(LineNumber, IsOfDigitsOnly) {
  EXPECT_EQ(line_number("0"), 0U);
  EXPECT_EQ(line_number("17"), 17U);
  for (const char* name : {"", "estop", "7a", "-1", "+1", " 1", "1 ", "99999999999"})
    EXPECT_FALSE(line_number(name)) << name;
}

}  // namespace
}  // namespace drover::link
