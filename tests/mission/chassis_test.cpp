// A chassis that takes a twist: over a serial line and over CAN.
#include <algorithm>

#include "mission/support.h"
#include "mission/wire_twist.h"

namespace drover::mission {
namespace {

using gt01::Asked;
using gt01::Line;

Line read_line(const Record& log) {
  return gt01::read_line(log.folder);
}

TEST(Gt01, IsDrivenToSuccessCloseToTheTrack) {
  expect_drive_on_a_chassis("gt01");
}

TEST(Gt01, HearsNothingButWholeTwistsAndStandsBeforeAndAfterTheTask) {
  const Record& log = record("gt01");
  const Line line = read_line(log);
  ASSERT_GT(line.packets.size(), 1000U);
  EXPECT_EQ(line.strange, 0U);
  const Time begin = log.answered("start_task_success");
  const Time end = log.first_status("NAV_SUCCESS").time + 200ms;
  for (const Asked& asked : line.packets)
    EXPECT_TRUE(!asked.moves() || (asked.time > begin - 100ms && asked.time < end))
        << "at " << seconds(asked.time);
}

TEST(Gt01, ShowsNoJointToAnybody) {
  for (const auto& status : record("gt01").statuses)
    ASSERT_EQ(status.why.find("wheel"), std::string::npos) << status.why;
}

TEST(Gt01Can, IsDrivenToSuccessCloseToTheTrack) {
  expect_drive_on_a_chassis("gt01_can");
}

/// 0x01: 01 01, then the twist; nothing else has this id.
TEST(Gt01Can, HearsNothingButTwists) {
  const Record& log = record("gt01_can");
  std::size_t told = 0;
  for (const CanLine& line : log.can) {
    if (line.frame.id != 0x01) continue;
    ++told;
    ASSERT_EQ(line.frame.len, 8);
    ASSERT_EQ(line.frame.data[0], 0x01);
    ASSERT_EQ(line.frame.data[1], 0x01);
    ASSERT_EQ(line.frame.data[6] | line.frame.data[7], 0);
  }
  EXPECT_GT(told, 500U);
}

/// It keeps its last twist, and nobody reaches it: only its power can be taken.
TEST(Gt01Torn, LosesItsPowerAndComesToRest) {
  const Record& log = record("gt01_torn");
  const Time torn = log.event("event torn#1");
  const Time plugged = log.event("event plugged#1");
  const auto relay = log.changes("enable_relay", torn, plugged);
  ASSERT_FALSE(relay.empty()) << "the relay stays closed";
  figure("the relay opens after", relay.front().time - torn);
  tell_way_to_rest(log, torn, plugged);
  EXPECT_LE(relay.front().time - torn, 2500ms);
  // Without power it rolls out.
  EXPECT_LE(roll(log, torn, plugged).way_m, 2.0);
  EXPECT_LE(roll(log, torn, plugged).rest - torn, 4900ms);
}

TEST(Gt01Torn, GoesOnOnlyAfterAResetAndANewStart) {
  const Record& log = record("gt01_torn");
  const auto& error = log.first_status("NAV_ERROR", log.event("event torn#1"));
  EXPECT_LE(error.time - log.event("event torn#1"), 500ms);
  // The guard has no line then either: that is what follows, not the cause.
  EXPECT_TRUE(error.why.starts_with("the base: ")) << error.why;
  EXPECT_EQ(log.statuses.back().nav, "NAV_SUCCESS");
  const Line line = read_line(log);
  const Time start = next_start(log, log.event("event plugged#1"));
  for (const Asked& asked : line.packets)
    if (asked.time > log.event("event plugged#1") && asked.time < start - 100ms) {
      EXPECT_FALSE(asked.moves()) << "at " << seconds(asked.time);
    }
}

bool told(const Record& log, const char* what, Time begin) {
  return std::any_of(log.statuses.begin(), log.statuses.end(), [&](const Status& status) {
    return status.time >= begin && status.why.find(what) != std::string::npos;
  });
}

void expect_success_after_a_cancel(const char* name) {
  const Record& log = record(name);
  auto words = kStarted;
  words.insert(words.end(), {"cancel_task_success", "start_task_success", "start_nav_success"});
  EXPECT_EQ(log.feedback_words(), words);
  EXPECT_EQ(log.statuses.back().nav, "NAV_SUCCESS");
}

/// Its zero only brakes: it creeps, tells nothing for a while, and is pushed.
TEST(Gt01RestOnRamp, KeepsItsPower) {
  const Record& log = record("gt01_rest_on_ramp");
  const Time cancelled = log.event("event cancelled#1");
  ASSERT_GT(log.truth_at(cancelled).z_m - log.truth.front().z_m, 0.05) << "it is not on the ramp";
  const Roll crept = roll(log, cancelled + 1s, log.event("event pushed#1"));
  figure("way that it crept", crept.way_m, "m");
  EXPECT_LT(crept.way_m, 0.5);
  EXPECT_TRUE(log.changes("enable_relay", cancelled, Time::max()).empty());
  EXPECT_FALSE(told(log, "did not stop", kNever));
}

TEST(Gt01RestOnRamp, DrivesOnAfterwards) {
  expect_success_after_a_cancel("gt01_rest_on_ramp");
}

/// The program that begins meanwhile did not see who moves it.
TEST(Gt01PushedOverRestart, KeepsItsPowerAndDrivesOnAfterwards) {
  const Record& log = record("gt01_pushed_over_restart");
  const Time pushed = log.event("event pushed#1");
  const Time back = log.event("start droverd", 2);
  ASSERT_GT(std::abs(log.truth_at(log.event("signal 9 to droverd")).vx_mps), 0.1)
      << "nobody pushes it: this proves nothing";
  ASSERT_GT(std::abs(log.truth_at(back + 1500ms).vx_mps), 0.1);
  EXPECT_TRUE(log.changes("enable_relay", pushed, Time::max()).empty());
  EXPECT_FALSE(told(log, "did not stop", kNever));
  expect_success_after_a_cancel("gt01_pushed_over_restart");
}

/// Without power it rolls back; what it must not do is to go on up.
TEST(Gt01DeafOnRamp, LosesItsPowerBecauseItGoesOnUp) {
  const Record& log = record("gt01_deaf_on_ramp");
  const Time deaf = log.event("event deaf#1");
  ASSERT_GT(log.truth_at(deaf).z_m - log.truth.front().z_m, 0.05) << "it is not on the ramp";
  ASSERT_GT(log.truth_at(deaf).vx_mps, 0.1) << "it stands: this proves nothing";
  const auto relay = log.changes("enable_relay", deaf, Time::max());
  ASSERT_FALSE(relay.empty()) << "the relay stays closed";
  figure("the relay opens after", relay.front().time - deaf);
  EXPECT_LE(relay.front().time - deaf, 2s);
  EXPECT_TRUE(told(log, "did not stop", deaf));
  EXPECT_LT(log.truth.back().x_m, log.truth_at(relay.front().time).x_m + 0.3);
}

}  // namespace
}  // namespace drover::mission
