// A Scout that is not well: silent, in an exception, in a person's hands, stopped by its own
// button.
#include <algorithm>

#include "mission/support.h"
#include "mission/wire_twist.h"

namespace drover::mission {
namespace {

/// One of the faults: when it came, when it went, and what is said of it.
struct Trouble {
  const char* fault;
  const char* text;
  bool brakes;  ///< its motors still obey
};
constexpr Trouble kTroubles[] = {
    {"silent", "no motion (0x221)", true},
    {"exception", "the chassis reports a fault, error 0000", false},
    {"remote", "its remote control drives the chassis", true},
    {"estop", "the chassis' emergency stop is pressed", false},
};

/// No twist but zero.
void expect_zeros(const Record& log, Time begin, Time end) {
  std::size_t told = 0;
  for (const CanLine& line : log.can) {
    if (line.time < begin || line.time > end) continue;
    const auto twist = agilex_v2::twist_command(line.frame);
    if (!twist) continue;
    ++told;
    EXPECT_FALSE(twist->moves()) << seconds(line.time);
  }
  EXPECT_GT(told, 10U) << "nobody speaks to it";
}

TEST(AgilexV2Faults, EachEndTheTaskInWordsAndLeaveZerosOnTheWire) {
  const Record& log = record("agilex_v2_faults");
  for (std::size_t i = 0; i < std::size(kTroubles); ++i) {
    const Trouble& trouble = kTroubles[i];
    SCOPED_TRACE(trouble.fault);
    const Time came = log.event(std::string("sim drive chassis fault ") + trouble.fault);
    const Time well = log.event("event well_" + std::to_string(i + 1) + "#1");
    ASSERT_GT(log.truth_at(came).vx_mps, 0.4) << "it does not drive";
    const auto& error = log.first_status("NAV_ERROR", came);
    figure("task ended after", error.time - came);
    EXPECT_LT(error.time - came, 500ms);
    EXPECT_THAT(error.why, testing::HasSubstr(trouble.text));
    const Roll rolled = roll(log, came, well);
    figure("way to rest", rolled.way_m, "m");
    figure("time to rest", rolled.rest - came);
    EXPECT_LT(rolled.way_m, 0.4);
    EXPECT_LT(rolled.rest - came, 2s);
    // A silent one is braked by the ramp of a stop that is not an emergency's.
    expect_zeros(log, came + (trouble.brakes ? 1500ms : 250ms), next_start(log, well) - 20ms);
  }
}

TEST(AgilexV2Faults, RefuseAStartUntilTheyAreOverAndLeaveTheNextOneToTheGoal) {
  const Record& log = record("agilex_v2_faults");
  auto words = kStarted;
  for (std::size_t i = 0; i < std::size(kTroubles); ++i)
    words.insert(words.end(), {"start_task_failse", "start_task_success", "start_nav_success"});
  EXPECT_EQ(log.feedback_words(), words);
  // What is wrong is shown all the time; the refusal may name what it means for the drives.
  for (std::size_t i = 0; i < std::size(kTroubles); ++i) {
    const Time refused = log.event("event refused_" + std::to_string(i + 1) + "#1");
    const auto shown = std::find_if(log.statuses.begin(), log.statuses.end(),
                                    [&](const Status& status) { return status.time > refused; });
    EXPECT_THAT(shown->why, testing::HasSubstr(kTroubles[i].text));
  }
  for (const Feedback& one : log.feedback) {
    if (one.cmd != "start_task_failse") continue;
    EXPECT_FALSE(one.reason.empty());
  }
  EXPECT_EQ(log.statuses.back().nav, "NAV_SUCCESS");
}

TEST(AgilexV2EstopOnRamp, RollsBackAndIsOnlyDrivenOnByANewStart) {
  const Record& log = record("agilex_v2_estop_on_ramp");
  const Time pressed = log.event("event pressed#1");
  const Time released = log.event("event released#1");
  ASSERT_GT(log.truth_at(pressed).z_m - log.truth.front().z_m, 0.1) << "it is not on the ramp";
  const auto& error = log.first_status("NAV_ERROR", pressed);
  EXPECT_LT(error.time - pressed, 500ms);
  EXPECT_THAT(error.why, testing::HasSubstr("the chassis' emergency stop is pressed"));
  const auto [ahead_m, back_m] = ahead_and_back_m(log, pressed, released);
  figure("rolled on", ahead_m, "m");
  figure("rolled back", back_m, "m");
  EXPECT_GT(back_m, 0.05) << "it held: nobody says that it does";
  // It stayed in CAN mode: what it is told from then on is obeyed.
  const Time start = next_start(log, released);
  expect_zeros(log, pressed + 250ms, start - 20ms);
  const Roll crept = roll(log, released + 500ms, start - 20ms);
  figure("crept at", crept.fastest_mps, "m/s");
  EXPECT_LT(crept.fastest_mps, 0.1);
  expect_new_start_succeeds(log, released);
}

}  // namespace
}  // namespace drover::mission
