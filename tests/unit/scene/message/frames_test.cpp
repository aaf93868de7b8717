#include "scene/message/frames.h"

#include <gtest/gtest.h>

namespace drover::scene {
namespace {

TEST(Frames, OneAndMapAreTheGlobalFrame) {
  for (const char* name : {"1", "map", "/1", "/map"}) EXPECT_TRUE(is_global_frame(name)) << name;
  for (const char* name : {"", "0", "base_link", "Map", "01", "11"})
    EXPECT_FALSE(is_global_frame(name)) << name;
}

TEST(Frames, ZeroAndNothingAreNone) {
  for (const char* name : {"", "0", "/", "/0"}) EXPECT_TRUE(is_no_frame(name)) << name;
  for (const char* name : {"1", "map", "base_link", "00"}) EXPECT_FALSE(is_no_frame(name)) << name;
}

}  // namespace
}  // namespace drover::scene
