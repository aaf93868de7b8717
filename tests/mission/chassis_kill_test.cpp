// droverd is killed while a chassis drives by twists, on a serial line and on CAN.
#include "mission/support.h"
#include "mission/wire_twist.h"

namespace drover::mission {
namespace {

using ReadTwist = std::optional<TwistCommand> (*)(const CanFrame& frame);

/// What one message to the chassis asks.
struct Said {
  Time time = kNever;
  bool moves = false;
};

std::vector<Said> said_on_can(const Record& log, ReadTwist twist_of) {
  std::vector<Said> all;
  for (const CanLine& line : log.can)
    if (const auto twist = twist_of(line.frame)) all.push_back({line.time, twist->moves()});
  return all;
}

/// From the guard's first message on none moves the chassis, until droverd is back.
void expect_the_guard_stops_it(const Record& log, const std::vector<Said>& all) {
  const Time killed = log.event("signal 9 to droverd");
  const Time back = log.event("start droverd", 2);
  Time first = kNever;
  for (const Said& said : all) {
    // What lay in the line's queue when it died may still leave.
    if (said.time < killed + 10ms || said.time > back) continue;
    EXPECT_FALSE(said.moves) << "at " << seconds(said.time);
    if (first == kNever) first = said.time;
  }
  ASSERT_NE(first, kNever) << "nobody spoke";
  figure("the guard's first message after it went", first - killed);
  EXPECT_LE(first - killed, 100ms);
  tell_way_to_rest(log, killed, back);
  EXPECT_LE(roll(log, killed, back).way_m, 0.35);
  EXPECT_LE(roll(log, killed, back).rest - killed, 800ms);
}

void expect_a_new_start_reaches_the_goal(const Record& log) {
  expect_new_start_succeeds(log, log.event("start droverd", 2));
}

TEST(Gt01Kill, IsBroughtToRestByTheGuardsPackets) {
  const Record& log = record("gt01_kill");
  const gt01::Line line = gt01::read_line(log.folder);
  // Half a packet of the one who died may stand before the guard's first.
  EXPECT_LT(line.strange, 18U);
  std::vector<Said> all;
  for (const gt01::Asked& asked : line.packets) all.push_back({asked.time, asked.moves()});
  expect_the_guard_stops_it(log, all);
}

TEST(Gt01Kill, LetsANewStartReachTheGoal) {
  expect_a_new_start_reaches_the_goal(record("gt01_kill"));
}

TEST(Gt01CanKill, IsBroughtToRestByTheGuardsFrames) {
  const Record& log = record("gt01_can_kill");
  expect_the_guard_stops_it(log, said_on_can(log, gt01::twist_command));
}

TEST(Gt01CanKill, LetsANewStartReachTheGoal) {
  expect_a_new_start_reaches_the_goal(record("gt01_can_kill"));
}

TEST(AgilexV2Kill, IsBroughtToRestByTheGuardsFrames) {
  const Record& log = record("agilex_v2_kill");
  expect_the_guard_stops_it(log, said_on_can(log, agilex_v2::twist_command));
}

TEST(AgilexV2Kill, LetsANewStartReachTheGoal) {
  expect_a_new_start_reaches_the_goal(record("agilex_v2_kill"));
}

TEST(HunterKill, IsBroughtToRestByTheGuardsFrames) {
  const Record& log = record("hunter_kill");
  expect_the_guard_stops_it(log, said_on_can(log, hunter::twist_command));
}

TEST(HunterKill, LetsANewStartReachTheGoal) {
  expect_a_new_start_reaches_the_goal(record("hunter_kill"));
}

}  // namespace
}  // namespace drover::mission
