// droverd is killed while a chassis drives by twists on CAN.
#include "mission/support.h"
#include "mission/wire_twist.h"

namespace drover::mission {
namespace {

using ReadTwist = std::optional<TwistCommand> (*)(const CanFrame& frame);

/// From the guard's first frame on no frame moves the chassis, until droverd is back.
void expect_the_guard_stops_it(const char* name, ReadTwist twist_of) {
  const Record& log = record(name);
  const Time killed = log.event("signal 9 to droverd");
  const Time back = log.event("start droverd", 2);
  Time first = kNever;
  for (const CanLine& line : log.can) {
    // What lay in the bus' queue when it died may still leave.
    if (line.time < killed + 10ms || line.time > back) continue;
    const auto twist = twist_of(line.frame);
    if (!twist) continue;
    EXPECT_FALSE(twist->moves()) << "at " << seconds(line.time);
    if (first == kNever) first = line.time;
  }
  ASSERT_NE(first, kNever) << "nobody spoke";
  figure("the guard's first frame after it went", first - killed);
  EXPECT_LE(first - killed, 100ms);
  tell_way_to_rest(log, killed, back);
  EXPECT_LE(roll(log, killed, back).way_m, 0.35);
  EXPECT_LE(roll(log, killed, back).rest - killed, 800ms);
}

TEST(Gt01CanKill, IsBroughtToRestByTheGuardsFrames) {
  expect_the_guard_stops_it("gt01_can_kill", gt01::twist_command);
}

TEST(Gt01CanKill, LetsANewStartReachTheGoal) {
  const Record& log = record("gt01_can_kill");
  expect_new_start_succeeds(log, log.event("start droverd", 2));
}

TEST(AgilexV2Kill, IsBroughtToRestByTheGuardsFrames) {
  expect_the_guard_stops_it("agilex_v2_kill", agilex_v2::twist_command);
}

TEST(AgilexV2Kill, LetsANewStartReachTheGoal) {
  const Record& log = record("agilex_v2_kill");
  expect_new_start_succeeds(log, log.event("start droverd", 2));
}

}  // namespace
}  // namespace drover::mission
