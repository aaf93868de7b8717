#include "drover/spsc_ring.h"

#include <gtest/gtest.h>

namespace drover {

TEST(SpscRing, RefusesWhenFullAndKeepsWhatIsInside) {
  SpscRing<int, 2> ring;
  EXPECT_TRUE(ring.push(1));
  EXPECT_TRUE(ring.push(2));
  EXPECT_FALSE(ring.push(3));
  int value = 0;
  ASSERT_TRUE(ring.pop(value));
  EXPECT_EQ(value, 1);
  ASSERT_TRUE(ring.pop(value));
  EXPECT_EQ(value, 2);
  EXPECT_FALSE(ring.pop(value));
}

}  // namespace drover
