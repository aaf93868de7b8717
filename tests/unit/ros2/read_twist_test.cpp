// A message on /cmd_vel as what the base can do, and who may write it.
#include "ros2/read_twist.h"

#include <gmock/gmock.h>

#include <cmath>

#include "ros2/twist_writers.h"

namespace drover::ros2 {
namespace {

using namespace std::chrono_literals;
using testing::HasSubstr;

using Message = geometry_msgs_msg_dds__Twist_;

TEST(ATwist, IsAheadAndToTheLeft) {
  const Message message{{0.5, -0.125, 0}, {0, -0.0, 0.25}};
  const auto twist = read_twist(message);
  ASSERT_TRUE(twist.ok());
  EXPECT_EQ(twist->vx_mps, 0.5);
  EXPECT_EQ(twist->wz_radps, 0.25);
  EXPECT_EQ(twist->vy_mps, -0.125) << "the gateway knows which base can";
}

TEST(ATwist, IsRefusedByTheNameOfWhatABaseCannot) {
  const auto refused = [](Message message) { return read_twist(message).error(); };
  EXPECT_EQ(refused({{0.5, 0, -1}, {0, 0, 0}}), "linear.z is -1: this base cannot rise");
  EXPECT_THAT(refused({{0.5, 0, 0}, {1e-9, 0, 0}}), HasSubstr("angular.x"));
  EXPECT_THAT(refused({{0.5, 0, 0}, {0, 2, 0}}), HasSubstr("angular.y is 2"));
}

TEST(ATwist, IsRefusedWhereAnyPartIsNoNumber) {
  for (int part = 0; part < 6; ++part)
    for (const double bad : {double{NAN}, double{INFINITY}, -double{INFINITY}}) {
      std::array<double, 6> all{};
      all[static_cast<std::size_t>(part)] = bad;
      const auto twist = read_twist({{all[0], all[1], all[2]}, {all[3], all[4], all[5]}});
      ASSERT_FALSE(twist.ok()) << part;
      constexpr std::array kNames{"linear.x",  "linear.y",  "linear.z",
                                  "angular.x", "angular.y", "angular.z"};
      EXPECT_EQ(twist.error(), std::string(kNames[static_cast<std::size_t>(part)]) +
                                   (std::isnan(bad) ? " is NaN" : " is infinite"));
    }
}

TEST(TwistWritersOfOneTopic, AreRivalsUntilOneWasSilentForASecond) {
  TwistWriters writers;
  Time now{100s};
  for (int i = 0; i < 10; ++i) EXPECT_EQ(writers.rival_of(1, now += 50ms), 0U);
  EXPECT_EQ(writers.rival_of(2, now += 50ms), 1U);
  EXPECT_EQ(writers.rival_of(1, now += 50ms), 2U);
  EXPECT_EQ(writers.rival_of(1, now += 950ms), 2U);
  EXPECT_EQ(writers.rival_of(1, now += 1ms), 0U);
}

TEST(TwistWritersOfOneTopic, AreRivalsHoweverManyTheyAre) {
  TwistWriters writers;
  Time now{100s};
  EXPECT_EQ(writers.rival_of(1, now), 0U);
  for (std::uint64_t writer = 2; writer < 100; ++writer)
    EXPECT_NE(writers.rival_of(writer, now += 1ms), 0U);
  EXPECT_NE(writers.rival_of(1, now += 1ms), 0U);
}

}  // namespace
}  // namespace drover::ros2
