#include "engine/signals/signals.h"

#include <gtest/gtest.h>

#include <string>

namespace drover::engine {
namespace {

/// One character for each 50 ms: '#' on, '.' off.
std::string pattern(Output output, const Snapshot& snapshot, bool moving, bool armed,
                    double seconds) {
  Signals signals;
  std::string text;
  for (int i = 0; i < static_cast<int>(seconds * 20 + 0.5); ++i) {
    const Time now{std::chrono::seconds(5) + i * std::chrono::milliseconds(50)};
    const auto& levels = signals.step(now, snapshot, moving, armed, true);
    text += levels[static_cast<std::size_t>(output)] ? '#' : '.';
  }
  return text;
}

TEST(Signals, OfAStoppedRobotAreThreeFlashesAndALongBeep) {
  Snapshot snapshot;
  snapshot.stop_latched = true;
  EXPECT_EQ(pattern(Output::lamp, snapshot, false, false, 1.6), "###...###...###.................");
  EXPECT_EQ(pattern(Output::buzzer, snapshot, false, false, 1.6),
            "################................");
}
TEST(Signals, OfARobotThatIsReadyAreOneFlashInTwoSeconds) {
  EXPECT_EQ(pattern(Output::lamp, {}, false, false, 2.1),
            "##......................................##");
  EXPECT_EQ(pattern(Output::buzzer, {}, false, false, 2), std::string(40, '.'));
}
TEST(Signals, WarnWithTwoBeepsBeforeMotion) {
  EXPECT_EQ(pattern(Output::buzzer, {}, false, true, 1), "###...###...........");
  EXPECT_EQ(pattern(Output::lamp, {}, true, true, 1), std::string(20, '#'));
}
TEST(Signals, BeepTwiceThoughItMovesMeanwhileAndNotWhenItHalts) {
  Signals signals;
  std::string text;
  for (int i = 0; i < 40; ++i) {
    const Time now{std::chrono::seconds(5) + i * std::chrono::milliseconds(50)};
    const bool moving = i > 1 && i != 30;  // it halts for a moment
    text += signals.step(now, {}, moving, true, true)[static_cast<std::size_t>(Output::buzzer)]
                ? '#'
                : '.';
  }
  EXPECT_EQ(text, "###...###" + std::string(31, '.'));
}
TEST(Signals, OfAPauseFlashQuickly) {
  Snapshot snapshot;
  snapshot.nav.paused = true;
  EXPECT_EQ(pattern(Output::lamp, snapshot, false, true, 0.5), "###..###..");
}
TEST(Signals, ShowOnTheRelayWhetherTheDrivesAreToHavePower) {
  Signals signals;
  const auto relay = [&](bool power) {
    return signals.step(Time{}, {}, false, false,
                        power)[static_cast<std::size_t>(Output::enable_relay)];
  };
  EXPECT_TRUE(relay(true));
  EXPECT_FALSE(relay(false));
}

}  // namespace
}  // namespace drover::engine
