// Bytes of one message as two libraries write it.
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "integration/ros2_fastdds_user.h"

namespace drover::test {

/// Little endian CDR both. Cyclone DDS fills up to four bytes with 0 and says how many these are in
/// the last byte of the encapsulation's header, as XTypes has it; Fast-CDR does neither.
inline void expect_same_cdr(const fast::Bytes& cyclone, const fast::Bytes& by_fast) {
  using testing::ElementsAre;
  ASSERT_GE(by_fast.size(), 4U);
  ASSERT_GE(cyclone.size(), 4U);
  const std::size_t fill = (4 - by_fast.size() % 4) % 4;
  EXPECT_THAT(fast::Bytes(by_fast.begin(), by_fast.begin() + 4), ElementsAre(0, 1, 0, 0));
  EXPECT_THAT(fast::Bytes(cyclone.begin(), cyclone.begin() + 4), ElementsAre(0, 1, 0, fill));
  fast::Bytes filled(by_fast.begin() + 4, by_fast.end());
  filled.resize(filled.size() + fill);
  EXPECT_EQ(fast::Bytes(cyclone.begin() + 4, cyclone.end()), filled);
}

}  // namespace drover::test
