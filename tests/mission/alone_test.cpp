// Both programs are killed on the ramp, and no relay takes the drives' power: what each does by
// itself, and that the next program has it again.
#include "mission/support.h"

namespace drover::mission {
namespace {

/// From the kill to the next program's start.
struct Alone {
  explicit Alone(const char* name)
      : log(record(name)),
        killed(log.event("signal 9 to droverd")),
        back(log.event("start droverd", 2)) {
    EXPECT_GT(log.truth_at(killed).z_m - log.truth.front().z_m, 0.1) << "it is not on the ramp";
    EXPECT_GT(log.truth_at(killed).vx_mps, 0.3) << "it does not drive";
    const auto [ahead, rolled_back] = ahead_and_back_m(log, killed, back);
    ahead_m = ahead;
    back_m = rolled_back;
    figure("went on", ahead_m, "m");
    figure("rolled back", back_m, "m");
    figure("alone for", back - killed);
  }
  double speed_mps(Duration after) const { return log.truth_at(killed + after).vx_mps; }

  const Record& log;
  Time killed;
  Time back;
  double ahead_m = 0;
  double back_m = 0;
};

/// From the next program's start on.
void expect_caught(const Alone& alone, Duration within) {
  const Time end = next_start(alone.log, alone.back);
  ASSERT_NE(end, Time::max());
  const Roll after = roll(alone.log, alone.back, end - kEstop);
  figure("fastest", after.fastest_mps, "m/s");
  figure("held after", after.rest - alone.back);
  EXPECT_LT(after.rest - alone.back, within);
}

/// 2000h, 0.2 s: until then it goes on, and then it lets go.
TEST(Zlac8015dAloneOnRamp, IsLetGoByItsOwnTimeOut) {
  const Alone alone("zlac8015d_alone_on_ramp");
  EXPECT_GT(alone.speed_mps(150ms), 0.4);
  EXPECT_LT(alone.speed_mps(alone.back - alone.killed), -0.1) << "it does not roll";
  EXPECT_GT(alone.back_m, 0.05);
}

TEST(Zlac8015dAloneOnRamp, IsCaughtByTheNextProgramWhichReachesTheGoal) {
  const Alone alone("zlac8015d_alone_on_ramp");
  expect_caught(alone, 2500ms);
  expect_new_start_succeeds(alone.log, alone.back);
}

/// It keeps its last twist: nothing but a program stops it.
TEST(Gt01AloneOnRamp, GoesOnUntilThereIsAProgramAgain) {
  const Alone alone("gt01_alone_on_ramp");
  for (Duration after{}; after < alone.back - alone.killed; after += 100ms)
    EXPECT_GT(alone.speed_mps(after), 0.35) << seconds(after);
}

TEST(Gt01AloneOnRamp, IsStoppedByTheNextProgramWhichReachesTheGoal) {
  const Alone alone("gt01_alone_on_ramp");
  const Time end = next_start(alone.log, alone.back);
  const Roll after = roll(alone.log, alone.back, end - kEstop);
  figure("way until it was stopped", after.way_m, "m");
  EXPECT_LT(after.way_m, 1.0);
  EXPECT_LT(std::abs(alone.log.truth_at(alone.back + 2s).vx_mps), 0.25) << "it creeps at most";
  expect_new_start_succeeds(alone.log, alone.back);
}

/// A time-out after which it is at zero: it brakes, and creeps.
void expect_to_stop_and_creep(const Alone& alone, Duration silence) {
  EXPECT_GT(alone.speed_mps(silence - 100ms), 0.35) << "it stops sooner than is said";
  const Time rest = alone.killed + silence + 500ms;
  EXPECT_LT(std::abs(alone.log.truth_at(rest).vx_mps), 0.25);
  EXPECT_LT(alone.ahead_m, 0.5 * to_s(silence) + 0.25);
  const Roll crept = roll(alone.log, rest, alone.back);
  figure("crept", crept.way_m, "m");
  figure("crept at", crept.fastest_mps, "m/s");
  EXPECT_GT(crept.way_m, 0.01) << "it holds: nobody says so";
  EXPECT_LT(crept.fastest_mps, 0.25);
}

TEST(Gt01CanAloneOnRamp, StopsByItselfAfterASecondAndCreeps) {
  expect_to_stop_and_creep(Alone("gt01_can_alone_on_ramp"), 1s);
}

TEST(Gt01CanAloneOnRamp, LetsANewStartReachTheGoal) {
  const Alone alone("gt01_can_alone_on_ramp");
  expect_new_start_succeeds(alone.log, alone.back);
}

TEST(AgilexV2AloneOnRamp, ProtectsItselfAfterHalfASecondAndCreeps) {
  expect_to_stop_and_creep(Alone("agilex_v2_alone_on_ramp"), 500ms);
}

TEST(AgilexV2AloneOnRamp, LetsANewStartReachTheGoal) {
  const Alone alone("agilex_v2_alone_on_ramp");
  expect_new_start_succeeds(alone.log, alone.back);
}

}  // namespace
}  // namespace drover::mission
