// How those are named who write.
#include "ros2/writer_names.h"

#include <gmock/gmock.h>

namespace drover::ros2 {
namespace {

/// `ros2 topic pub --once` twice is two programs.
TEST(WriterNames, OfTwoThatAreGoneDiffer) {
  constexpr dds_entity_t kNoReader = 0;
  EXPECT_THAT(writer_name(kNoReader, 5), testing::HasSubstr("gone"));
  EXPECT_EQ(writer_name(kNoReader, 5), writer_name(kNoReader, 5));
  EXPECT_NE(writer_name(kNoReader, 5), writer_name(kNoReader, 6));
}

}  // namespace
}  // namespace drover::ros2
