#include "mission/object_line.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace drover::mission {
namespace {

using namespace std::chrono_literals;

TEST(ObjectLines, AreReadStrictly) {
  for (const char* line :
       {"", "watching 36", "(1.0) watching 36", "(1.000000000) sing wall",
        "(1.000000000) put wall box 1 2 3 4", "(1.000000000) put wall box 1 2 3 4 5 6",
        "(1.000000000) put wall egg 1 2 3 4 5", "(1.000000000) put wall box 1 2 3 4 5 6 x",
        "(1.000000000) put wall prism 1 2 3 4 5 6 7", "(1.000000000) at wall 1",
        "(1.000000000) gone wall 1", "(1.000000000) touch wall 1 2 3"})
    EXPECT_THROW((void)parse_object_line(line), std::runtime_error) << line;
  const auto touch = parse_object_line("(1.500000000) touch wall 1 2 3 0.5 0 0.1 0.002");
  EXPECT_EQ(touch.time, Time{1500ms});
  EXPECT_EQ(touch.numbers[3], 0.5);
}

}  // namespace
}  // namespace drover::mission
