// Missions that record the outputs' wires: enable relay, lamp, buzzer, the hardware watchdog's
// line.

#include "mission/support.h"

namespace drover::mission {
namespace {

// The wires are looked at once in 5 ms.
constexpr Duration kLook = 5ms;
// The guard's edges are 10 ms apart; one more may fall between two looks and hide two of them.
constexpr Duration kPulseGap = 25ms;

/// The times of an output's edges to this level.
std::vector<Time> edges(const Record& log, const char* output, bool high, Time begin, Time end) {
  std::vector<Time> times;
  for (const auto& change : log.changes(output, begin, end))
    if (change.high == high) times.push_back(change.time);
  return times;
}

Duration longest_gap(const Record& log, Time begin, Time end) {
  Duration longest{};
  Time last = begin;
  for (const auto& change : log.changes("watchdog", begin, end)) {
    longest = std::max(longest, change.time - last);
    last = change.time;
  }
  return std::max(longest, end - last);
}

/// On at these ages, each for `on`, and at no other time from `begin` to `end`.
void expect_pulses(const Record& log, const char* output, Time begin, Time end,
                   const std::vector<Duration>& ages, Duration on) {
  const auto rises = edges(log, output, true, begin, end);
  ASSERT_EQ(rises.size(), ages.size()) << output << " from " << seconds(begin);
  for (std::size_t i = 0; i < ages.size(); ++i) {
    // A cycle of the simulator, until a contact is read at all, and 10 ms of the gateway.
    EXPECT_NEAR(to_s(rises[i] - begin), to_s(ages[i]), to_s(5ms + 10ms + kLook)) << output;
    const auto falls = edges(log, output, false, rises[i], end);
    ASSERT_FALSE(falls.empty()) << output << " stays on from " << seconds(rises[i]);
    EXPECT_NEAR(to_s(falls.front() - rises[i]), to_s(on), to_s(10ms + kLook)) << output;
  }
}

/// Two beeps with every start that is accepted.
void expect_warning_before_motion(const Record& log, Time start) {
  expect_pulses(log, "buzzer", start, start + 3s, {0ms, 300ms}, 150ms);
}

/// The lamp of a stopped robot: groups of three flashes, 1.6 s from one to the next.
void expect_stopped_lamp(const Record& log, Time begin, std::size_t groups) {
  const auto rises = edges(log, "lamp", true, begin + kLook, begin + groups * 1600ms - 2 * kLook);
  std::vector<Duration> gaps;
  for (std::size_t i = 1; i < rises.size(); ++i) gaps.push_back(rises[i] - rises[i - 1]);
  ASSERT_EQ(rises.size(), 3 * groups - 1) << "the first flash was on already";
  for (std::size_t i = 0; i < gaps.size(); ++i)
    EXPECT_NEAR(to_s(gaps[i]), i % 3 == 1 ? 1.0 : 0.3, to_s(2 * kLook)) << seconds(rises[i]);
}

TEST(Estop, CutsTheDrivesPowerUntilTheButtonIsReleased) {
  const Record& log = record("estop");
  const Time pressed = log.event("sim estop press");
  const Time released = log.event("sim estop release");
  ASSERT_EQ(log.level_at("enable_relay", pressed), true);
  const auto changes = log.changes("enable_relay", pressed, Time::max());
  ASSERT_EQ(changes.size(), 2U) << "off, and on again";
  figure("relay open after the button", changes[0].time - pressed);
  figure("relay closed after the release", changes[1].time - released);
  EXPECT_LE(changes[0].time - pressed, kEstop);
  // The contact is believed 0.2 s after its last change (its release_debounce_s); no motion comes
  // of it.
  EXPECT_GE(changes[1].time - released, 195ms);
  EXPECT_LE(changes[1].time - released, 230ms);
  EXPECT_EQ(changes[1].high, true);
}

TEST(Estop, IsShownByLampAndBuzzerUntilANewStartWarnsAndDrives) {
  const Record& log = record("estop");
  const Time first = log.answered("start_task_success");
  const Time pressed = log.event("sim estop press");
  const Time again = next_start(log, pressed);
  expect_warning_before_motion(log, first);
  EXPECT_THAT(log.changes("lamp", first + 1s, pressed), testing::IsEmpty()) << "on while it drives";
  EXPECT_EQ(log.level_at("lamp", pressed), true);
  expect_pulses(log, "buzzer", pressed, pressed + 3s, {0ms}, 800ms);
  const auto shown = log.changes("buzzer", pressed, pressed + kEstop);
  ASSERT_FALSE(shown.empty());
  expect_stopped_lamp(log, shown[0].time, 2);
  // Released, but latched.
  EXPECT_THAT(edges(log, "lamp", true, again - 1600ms, again - 2 * kLook), testing::SizeIs(3));
  expect_warning_before_motion(log, again);
  const Time done = log.event("event nav_success#1");
  EXPECT_THAT(log.changes("buzzer", again + 1s, Time::max()), testing::IsEmpty());
  EXPECT_EQ(log.level_at("lamp", done - 200ms), true);
  EXPECT_EQ(log.level_at("lamp", done + 500ms), false);
}

TEST(KillOnRamp, LeavesTheHardwareWatchdogFedByTheGuard) {
  const Record& log = record("kill_on_ramp");
  const Time begin = log.event("event boot#1") + 100ms;
  const Duration gap = longest_gap(log, begin, log.event("the end"));
  figure("longest time between two edges of the watchdog's line", gap);
  EXPECT_LE(gap, kPulseGap);
}

TEST(KillOnRamp, KeepsTheEnableRelayClosedByTheGuardAlone) {
  const Record& log = record("kill_on_ramp");
  const Time killed = log.event("signal 9 to droverd");
  ASSERT_EQ(log.level_at("enable_relay", killed), true);
  const Time restarted = log.event("start droverd", 2);
  ASSERT_GT(restarted - killed, 1s);
  EXPECT_THAT(log.changes("enable_relay", killed, restarted), testing::IsEmpty())
      << "the guard has its line until the new gateway takes it back";
}

TEST(BrakeOnRamp, ClosesNoRelayWhileAnEstopIsPressedThatNobodySaw) {
  const Record& log = record("brake_on_ramp");
  const Time back = log.event("start droverd", 3);
  const Time released = log.event("sim estop release");
  ASSERT_EQ(log.level_at("enable_relay", back), false) << "both programs were dead";
  EXPECT_THAT(log.changes("enable_relay", back, released), testing::IsEmpty());
  const auto on = edges(log, "enable_relay", true, released, Time::max());
  ASSERT_EQ(on.size(), 1U);
  figure("relay closed after the release", on[0] - released);
  EXPECT_LE(on[0] - released, 230ms);
}

TEST(BrakeOnRamp, SaysNothingOfLinesThatItDoesNotKnowYet) {
  const Record& log = record("brake_on_ramp");
  const Time back = log.event("start droverd", 2);
  std::size_t looked = 0;
  std::size_t unknown = 0;
  for (const auto& status : log.statuses) {
    if (status.time < back || status.time > back + 1s) continue;
    ++looked;
    unknown += status.why.find("not known yet") != std::string::npos ? 1 : 0;
    for (const char* claim : {"pressed", "touched", "obstacle", "far zone: slowly"})
      EXPECT_EQ(status.why.find(claim), std::string::npos) << status.why;
    EXPECT_EQ(status.document.at("robot").at("robot_status").get<int>() & 0b10001, 0);
    EXPECT_FALSE(status.obstacle);
  }
  figure("statuses in the first second", static_cast<double>(looked), "");
  figure("of them with lines not known", static_cast<double>(unknown), "");
  EXPECT_GT(looked, 0U);
}

TEST(Hang, LeavesTheHardwareWatchdogFedByTheGuardAndIsHeardAfterwards) {
  const Record& log = record("hang");
  EXPECT_LE(longest_gap(log, log.event("event boot#1") + 100ms, log.event("the end")), kPulseGap);
  const Time hung = log.event("signal 19 to droverd");
  const Time woken = log.event("signal 18 to droverd");
  // The player writes the signal down after it has sent it, and droverd may be quicker than that.
  for (const char* output : {"enable_relay", "lamp", "buzzer"})
    EXPECT_THAT(log.changes(output, hung, woken - 1ms), testing::IsEmpty()) << output;
  expect_pulses(log, "buzzer", woken - 1ms, woken + 3s, {0ms}, 800ms);
}

TEST(HangWithoutBus, LeavesTheDrivesToTheHardwareWatchdogAlone) {
  const Record& log = record("hang_without_bus");
  const Time hung = log.event("signal 19 to droverd");
  const Time pulled = log.event("sim can can0 unplug");
  const Time woken = log.event("signal 18 to droverd");
  EXPECT_LE(longest_gap(log, log.event("event boot#1") + 100ms, pulled), kPulseGap)
      << "the guard stops the drives, so the watchdog is not to act";
  ASSERT_LT(hung, pulled);
  // The kernel takes a second to part with an interface, then waits for the last who holds it in
  // pauses that double up to a quarter of a second; it takes frames until then.
  const auto edges = log.changes("watchdog", pulled, woken);
  ASSERT_FALSE(edges.empty());
  std::printf("  the last edge came %s after the adapter was pulled, %s before droverd woke\n",
              seconds(edges.back().time - pulled).c_str(),
              seconds(woken - edges.back().time).c_str());
  EXPECT_LT(edges.back().time - pulled, 1s + 250ms + 50ms);
  EXPECT_GT(woken - edges.back().time, 1500ms) << "a new interface alone changes nothing";
  EXPECT_LE(longest_gap(log, woken + 1s, log.event("the end")), kPulseGap);
}

TEST(HangWithoutBus, LetsANewStartReachTheGoal) {
  const Record& log = record("hang_without_bus");
  const Time woken = log.event("signal 18 to droverd");
  expect_rest_until_started(log, woken);
  expect_new_start_succeeds(log, woken);
}

const std::string kUnreadable = "line e-stop: the line cannot be read";

TEST(ChipReplugged, StopsAndSaysSo) {
  const Record& log = record("chip_replugged");
  const Time pulled = log.event("sim lines unplug");
  ASSERT_TRUE(moved_until(log, pulled));
  EXPECT_EQ(log.level_at("lamp", pulled + kLook), std::nullopt) << "the chip is still there";
  expect_rest_until_started(log, pulled + kEstop);
  const auto& error = log.first_status("NAV_ERROR", pulled);
  EXPECT_LT(error.time - pulled, 200ms);
  EXPECT_THAT(error.why, testing::HasSubstr(kUnreadable));
  EXPECT_EQ(log.feedback_words(),
            (std::vector<std::string>{"save_trajectory_success", "start_task_success",
                                      "start_nav_success", "start_task_failse",
                                      "start_task_success", "start_nav_success"}));
  EXPECT_EQ(log.feedback.at(3).reason, kUnreadable);
}

TEST(ChipReplugged, IsPickedUpAgainByTheSameProcesses) {
  const Record& log = record("chip_replugged");
  const Time back = log.event("sim lines plug");
  EXPECT_EQ(log.all("start droverd").size(), 1U);
  EXPECT_EQ(log.all("start drover-guard").size(), 1U);
  const auto on = edges(log, "enable_relay", true, back, Time::max());
  ASSERT_FALSE(on.empty());
  // The pause before the next attempt is 0.5 s at most; then a contact must hold for 0.2 s.
  EXPECT_LT(on.front() - back, 800ms);
  const auto pulses = log.changes("watchdog", back, Time::max());
  ASSERT_GT(pulses.size(), 1U);
  // The first is the level at which the chip came back; it is looked for once a second.
  std::printf("  relay on again after %s, watchdog fed after %s\n",
              seconds(on.front() - back).c_str(), seconds(pulses[1].time - back).c_str());
  EXPECT_LT(pulses[1].time - back, 1100ms);
  EXPECT_LE(longest_gap(log, pulses[1].time, log.event("the end")), kPulseGap);
  const Time start = next_start(log, back);
  expect_warning_before_motion(log, start);
  EXPECT_LT(drive_figures(log, start, log.first_status("NAV_SUCCESS", start).time).goal_m, 0.10);

  const std::string told = said(log, "droverd.log");
  for (const char* text : {"error: lines: lost (", "error: outputs: lost (",
                           "warning: gpio drover-sim: no chip with this label or name"})
    EXPECT_THAT(told, testing::HasSubstr(text));
}

}  // namespace
}  // namespace drover::mission
