// Which of several networks the domain uses.
#include "ros2/networks.h"

#include <gtest/gtest.h>

namespace drover::ros2 {
namespace {

const Network kTunnel{"tun0", "10.8.0.2", false};
const Network kWire{"eth0", "10.0.0.2"};
const Network kAir{"wlan0", "10.1.0.2"};
const Network kAirElsewhere{"wlan0", "10.2.0.2"};

TEST(ChosenNetwork, IsTheFirstThatTakesMulticast) {
  EXPECT_EQ(chosen({}, "", {}), std::nullopt);
  EXPECT_EQ(chosen({kTunnel, kWire, kAir}, "", {}), kWire);
  EXPECT_EQ(chosen({kTunnel}, "", {}), kTunnel) << "better than none";
}

TEST(ChosenNetwork, StaysWhileItIsThereWhateverComesAndGoes) {
  EXPECT_EQ(chosen({kWire, kAir}, "", kAir), kAir);
  EXPECT_EQ(chosen({kTunnel, kAir}, "", kAir), kAir);
  EXPECT_EQ(chosen({kWire, kAirElsewhere}, "", kAir), kWire) << "its address is another one";
}

TEST(ChosenNetwork, IsNoOtherThanTheOneThatIsWanted) {
  EXPECT_EQ(chosen({kWire, kAir}, "wlan0", {}), kAir);
  EXPECT_EQ(chosen({kWire, kAir}, "wlan0", kWire), kAir);
  EXPECT_EQ(chosen({kWire}, "wlan0", kWire), std::nullopt);
  EXPECT_EQ(chosen({kAirElsewhere, kAir}, "wlan0", kAir), kAir) << "the one in use of two of it";
}

TEST(Networks, AreTold) {
  EXPECT_EQ(joined({}), "no network");
  EXPECT_EQ(joined({kWire, kAir}), "eth0 10.0.0.2, wlan0 10.1.0.2");
}

}  // namespace
}  // namespace drover::ros2
