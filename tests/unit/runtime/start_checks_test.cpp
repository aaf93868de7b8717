#include "runtime/start_checks.h"

#include <gtest/gtest.h>

namespace drover::runtime {
namespace {

using namespace std::chrono_literals;

WaitingStart start(std::uint64_t number, Time since) {
  return {Command{{RequestId::Source::cli, number}, since, StartTask{}}, {number, 0}, {}, since};
}

TEST(StartChecks, GiveEachStartBackOnceWithTheStopsBeforeIt) {
  StartChecks checks;
  EXPECT_FALSE(checks.any());
  const auto first = checks.add(start(5, Time{1s}));
  const auto second = checks.add(start(6, Time{1s}));
  EXPECT_NE(first, second);
  const auto taken = checks.take(second);
  ASSERT_TRUE(taken.has_value());
  EXPECT_EQ(taken->command.id.number, 6U);
  EXPECT_EQ(taken->before.cancels, 6U);
  EXPECT_FALSE(checks.take(second).has_value());
  EXPECT_TRUE(checks.any());
}

TEST(StartChecks, GiveUpWhatWaitsTooLong) {
  StartChecks checks;
  const auto first = checks.add(start(5, Time{1s}));
  (void)checks.add(start(6, Time{2s}));
  EXPECT_FALSE(checks.take_late(Time{11s}));
  const auto late = checks.take_late(Time{11s} + 1ms);
  ASSERT_TRUE(late.has_value());
  EXPECT_EQ(late->command.id.number, 5U);
  EXPECT_FALSE(checks.take_late(Time{11s} + 1ms));
  EXPECT_FALSE(checks.take(first).has_value()) << "its answer comes too late";
}

TEST(StartChecks, SayWhatStandsOnTheTrackAsTheOperatorCountsPoints) {
  const scene::TrackOffence offence{8, 4.2, "box1 is in the way"};
  EXPECT_EQ(offence_text(offence, 1),
            "box1 is in the way, 4.20 m ahead on the track, after point 9");
  EXPECT_EQ(offence_text(offence, 0),
            "box1 is in the way, 4.20 m ahead on the track, after point 8");
}

TEST(StartChecks, SayWhatIsWhereTheRobotIsWithoutAPlace) {
  EXPECT_EQ(offence_text({3, 0, "the map has no origin yet"}, 1), "the map has no origin yet");
}

}  // namespace
}  // namespace drover::runtime
