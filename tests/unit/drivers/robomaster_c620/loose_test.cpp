// A motor whose wheel is loose on the shaft, told by its effort beside the others'.
#include "drivers/robomaster_c620/loose.h"

#include <gtest/gtest.h>

#include <cmath>

namespace drover::robomaster {
namespace {

constexpr double kFriction_Nm = 0.1;
constexpr double kShaft_Nm = 0.045;  // of a motor alone
constexpr Duration kCycle = std::chrono::milliseconds(5);

class ALooseWatch : public ::testing::Test {
 protected:
  /// One motor has this effort the way it turns, the others theirs.
  void run_s(double seconds, double one_Nm, double others_Nm, double radps = 5) {
    const double way = std::copysign(1.0, radps);
    std::array<Load, kMotors> loads;
    loads.fill({radps, way * others_Nm});
    loads[1] = {radps, way * one_Nm};
    for (int i = 0; i < static_cast<int>(seconds * 200 + 0.5); ++i) watch.step(loads, kCycle);
  }
  int loose() const {
    int all = 0;
    for (std::size_t i = 0; i < kMotors; ++i) all += watch.is_loose(i) ? 1 << i : 0;
    return all;
  }
  LooseWatch watch{kFriction_Nm};
};

TEST_F(ALooseWatch, TellsTheOneWhoseEffortIsItsFrictionsAlone) {
  run_s(3, kShaft_Nm, 0.35);
  EXPECT_EQ(loose(), 0) << "not so soon";
  run_s(1.5, kShaft_Nm, 0.75);
  EXPECT_EQ(loose(), 0);
  run_s(1.5, 1.8 * kShaft_Nm, 0.75, -5);
  EXPECT_EQ(loose(), 2);
  watch.begin_anew();
  EXPECT_EQ(loose(), 0);
}

/// A wheel may carry as little for long, where nothing changes.
TEST_F(ALooseWatch, AccusesNoneWhileAllCarryTheSameOnAndOn) {
  run_s(60, kShaft_Nm, 0.4);
  EXPECT_EQ(loose(), 0);
}

TEST_F(ALooseWatch, AccusesNoneWhereNoneCarriesMuch) {
  for (int i = 0; i < 20; ++i) run_s(1, kShaft_Nm, i % 2 == 0 ? 0.05 : 0.24);
  EXPECT_EQ(loose(), 0);
}

/// It is braked, or takes part, whenever that is asked of it.
TEST_F(ALooseWatch, AccusesNoneThatTakesPartNowAndThen) {
  for (int i = 0; i < 20; ++i) {
    run_s(1.5, kShaft_Nm, 0.8);
    run_s(0.25, i % 2 == 0 ? -0.3 : 0.3, 0.35);
    run_s(0.4, i % 2 == 0 ? -0.3 : 0.3, 0.35);
  }
  EXPECT_EQ(loose(), 0);
}

TEST_F(ALooseWatch, AccusesNoneThatStands) {
  for (int i = 0; i < 20; ++i) run_s(1, kShaft_Nm, i % 2 == 0 ? 0.4 : 0.9, 0.1);
  EXPECT_EQ(loose(), 0);
}

/// It has no current at all, and is somebody else's to tell.
TEST_F(ALooseWatch, AccusesNoneThatTellsNoCurrent) {
  for (int i = 0; i < 20; ++i) run_s(1, 0, i % 2 == 0 ? 0.4 : 0.9);
  EXPECT_EQ(loose(), 0);
}

}  // namespace
}  // namespace drover::robomaster
