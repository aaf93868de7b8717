#include "link/unix_address.h"

#include <gtest/gtest.h>

#include <string>

namespace drover::link {
namespace {

TEST(UnixAddress, EndsBehindItsPath) {
  const auto address = unix_address("/run/drover/drover.sock");
  ASSERT_TRUE(address);
  EXPECT_EQ(address->sun_family, AF_UNIX);
  EXPECT_STREQ(address->sun_path, "/run/drover/drover.sock");
}

TEST(UnixAddress, IsNoneOfAPathWhoseEndHasNoRoom) {
  const std::string longest(107, 'x');
  const auto address = unix_address(longest);
  ASSERT_TRUE(address);
  EXPECT_EQ(address->sun_path, longest);
  EXPECT_FALSE(unix_address(longest + "x"));
}

}  // namespace
}  // namespace drover::link
