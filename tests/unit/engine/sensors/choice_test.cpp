// Which of several the robot goes by.
#include "engine/sensors/choice.h"

#include <gtest/gtest.h>

namespace drover::engine {
namespace {

using namespace std::chrono_literals;

class AChoice : public ::testing::Test {
 protected:
  AChoice() {
    SensorList all;
    (void)all.push_back({"front", Role::steers});
    (void)all.push_back({"shown", Role::told});
    (void)all.push_back({"rear", Role::spare});
    choice.emplace(all);
    for (auto& each : all_well) each.well = true;
    now_well = all_well;
    run(1s);
  }
  void run(Duration lasts) {
    for (const Time end = now + lasts; now < end; now += 5ms)
      changes += choice->update(now, now_well, stands) ? 1 : 0;
  }

  std::optional<Choice> choice;
  SensorConditions all_well;
  SensorConditions now_well;
  bool stands = false;
  int changes = 0;
  Time now{100s};
};

TEST_F(AChoice, StaysWithWhatSteersWhileThatIsWell) {
  run(20s);
  EXPECT_EQ(choice->in_use(), 0U);
  EXPECT_EQ(changes, 0);
}

TEST_F(AChoice, TakesTheSpareAtOnceAndNeverWhatIsOnlyTold) {
  now_well[0].well = false;
  run(5ms);
  EXPECT_EQ(choice->in_use(), 2U);
  now_well[2].well = false;
  run(10s);
  EXPECT_EQ(choice->in_use(), 2U) << "nobody is well: it stays";
  EXPECT_EQ(changes, 1);
}

TEST_F(AChoice, LeavesASpareThatDoesNotFitUntilTheRobotStands) {
  now_well[0].well = false;
  now_well[2].fits = false;
  run(10s);
  EXPECT_EQ(choice->in_use(), 0U);
  stands = true;
  run(5ms);
  EXPECT_EQ(choice->in_use(), 2U);
}

TEST_F(AChoice, GoesBackOnlyAtRestAndToWhatHasBeenWellForLong) {
  now_well[0].well = false;
  run(1s);
  now_well = all_well;
  run(30s);
  EXPECT_EQ(choice->in_use(), 2U) << "not while it moves";
  now_well[0].well = false;
  run(5ms);
  now_well = all_well;
  stands = true;
  run(9s);
  EXPECT_EQ(choice->in_use(), 2U) << "it was away a moment ago";
  run(2s);
  EXPECT_EQ(choice->in_use(), 0U);
}

TEST_F(AChoice, GoesBackWhileMovingWhenTheSpareFails) {
  now_well[0].well = false;
  run(3s);
  now_well[0].well = true;
  now_well[2].well = false;
  run(5ms);
  EXPECT_EQ(choice->in_use(), 0U);
}

TEST_F(AChoice, DoesNotSwapTwoThatFailInTurn) {
  for (int i = 0; i < 40; ++i) {
    now_well[0].well = i % 2 == 0;
    now_well[2].well = i % 2 != 0;
    run(100ms);
  }
  EXPECT_LE(changes, 2);
}

TEST(AFreshChoice, WaitsForWhatSteersToBoot) {
  SensorList all;
  (void)all.push_back({"front", Role::steers});
  (void)all.push_back({"rear", Role::spare});
  Choice choice(all);
  SensorConditions conditions;
  conditions[1].well = true;
  Time now{100s};
  for (const Time end = now + 4s; now < end; now += 5ms) choice.update(now, conditions, true);
  EXPECT_EQ(choice.in_use(), 0U);
  for (const Time end = now + 2s; now < end; now += 5ms) choice.update(now, conditions, true);
  EXPECT_EQ(choice.in_use(), 1U);
}

TEST(AnAgreement, NeedsASecondOfContradictionAndThreeOfPeace) {
  Agreement agreement;
  Time now{100s};
  const auto hear = [&](bool apart, Duration lasts) {
    for (const Time end = now + lasts; now < end; now += 100ms) agreement.update(now, apart);
  };
  hear(true, 800ms);
  hear(false, 100ms);
  hear(true, 800ms);
  EXPECT_TRUE(agreement.agree()) << "outliers";
  hear(true, 500ms);
  EXPECT_FALSE(agreement.agree());
  hear(false, 2s);
  EXPECT_FALSE(agreement.agree());
  hear(false, 2s);
  EXPECT_TRUE(agreement.agree());
}

}  // namespace
}  // namespace drover::engine
