// A receiver that is found again elsewhere while the computer is busy: cycles are left out, and
// what was measured meanwhile comes in a burst, that of the wheels last.
#include <random>

#include "engine_fixture.h"

namespace drover::engine {
namespace {

using namespace std::chrono_literals;

struct Burst {
  bool backwards = false;                   ///< newest first
  FixQuality meanwhile = FixQuality::none;  ///< before it is found
  bool imu = false;
};

/// The longest pause between two cycles, and how old the newest word of the wheels is after it.
class AReceiverFoundAgainOnABusyComputer
    : public testing::TestWithParam<std::tuple<double, Duration>> {
 protected:
  /// When, after the published pose was at the other place, a start that is pressed in each cycle
  /// was taken; nothing: in none of the nine seconds after it.
  std::optional<double> taken_after_s(const Burst& burst, std::uint64_t seed) {
    const auto [gap_s, wheels_late] = GetParam();
    EngineRig rig;
    rig.imu = burst.imu;
    const Path path = straight_path(20);
    rig.settle();
    rig.quality = burst.meanwhile;
    rig.run_s(5);
    rig.quality = FixQuality::rtk_fixed;
    rig.jump_m = 3;
    rig.burst_backwards = burst.backwards;
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> share(0.8, 1.05);
    std::uniform_int_distribution<int> cycles(1, 50);
    while (rig.snapshot().pose.x_m < 1 && rig.now < Time{} + 60s) {
      rig.cycle_skipped = true;
      rig.run_s(gap_s * share(random));
      rig.cycle_skipped = false;
      rig.wheels_late = wheels_late;
      for (int i = cycles(random); i > 0 && rig.snapshot().pose.x_m < 1; --i) {
        rig.tick();
        rig.wheels_late = {};
      }
    }
    EXPECT_GE(rig.snapshot().pose.x_m, 1) << "it was not found again";
    for (int i = 0; i < 9 * 200; ++i) {
      rig.start(path, 40, 0.5);
      if (rig.snapshot().nav.status == NavStatus::run) return i / 200.0;
      rig.tick();
      if (rig.snapshot().nav.status == NavStatus::run) return i / 200.0;
    }
    return std::nullopt;
  }
};

TEST_P(AReceiverFoundAgainOnABusyComputer, StartsNothingBeforeAPersonWasTold) {
  for (const bool backwards : {false, true})
    for (const auto meanwhile : {FixQuality::none, FixQuality::rtk_float})
      for (const bool imu : {false, true})
        for (std::uint64_t seed = 1; seed <= 3; ++seed)
          EXPECT_EQ(taken_after_s({backwards, meanwhile, imu}, seed), std::nullopt)
              << "backwards " << backwards << ", float " << (meanwhile != FixQuality::none)
              << ", imu " << imu << ", seed " << seed;
}

INSTANTIATE_TEST_SUITE_P(Pauses, AReceiverFoundAgainOnABusyComputer,
                         testing::Combine(testing::Values(0.0, 0.2, 0.5),
                                          testing::Values(Duration{}, Duration{110ms},
                                                          Duration{250ms})));

}  // namespace
}  // namespace drover::engine
