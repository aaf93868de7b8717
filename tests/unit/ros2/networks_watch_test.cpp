// When the networks have changed for good.
#include "ros2/networks_watch.h"

#include <gtest/gtest.h>

namespace drover::ros2 {
namespace {

const NetworksWatch::Networks kHome{{"wlan0", "10.0.0.2"}};
const NetworksWatch::Networks kOther{{"wlan0", "10.0.0.2"}, {"usb0", "10.1.0.2"}};

TEST(NetworksWatch, SaysThatTheyHaveChangedWhenTheyAreTheSameTwice) {
  NetworksWatch watch;
  watch.use(kHome);
  EXPECT_FALSE(watch.changed(kHome));
  EXPECT_FALSE(watch.changed(kOther));
  EXPECT_TRUE(watch.changed(kOther));
  watch.use(kOther);
  EXPECT_FALSE(watch.changed(kOther));
}

TEST(NetworksWatch, IsNotMovedByOnesThatComeAndGo) {
  NetworksWatch watch;
  watch.use(kHome);
  for (int i = 0; i < 5; ++i) {
    EXPECT_FALSE(watch.changed(kOther)) << "the last ones were the old ones again";
    EXPECT_FALSE(watch.changed(kHome));
  }
}

}  // namespace
}  // namespace drover::ros2
