// A key that comes late is none: how late it is, the terminal's own answers tell.
#include "cli/terminal_watch.h"

#include <gtest/gtest.h>

namespace drover::cli {
namespace {

using namespace std::chrono_literals;

void answer(TerminalWatch& watch, Time now) {
  for (const char key : std::string_view("\033[0n")) EXPECT_TRUE(watch.take(key, now));
}

TEST(TerminalWatch, IsLateWhenTheAnswerWasAndUntilOneIsFast) {
  TerminalWatch watch;
  Time now{10s};
  EXPECT_EQ(watch.ask(now), "\033[5n");
  EXPECT_EQ(watch.ask(now + 150ms), "") << "one at a time";
  answer(watch, now + 200ms);
  EXPECT_FALSE(watch.is_late(now + 200ms));
  now += 300ms;
  EXPECT_EQ(watch.ask(now), "\033[5n");
  EXPECT_FALSE(watch.is_late(now + 250ms));
  EXPECT_TRUE(watch.is_late(now + 350ms)) << "it stalls";
  answer(watch, now + 2s);
  EXPECT_TRUE(watch.is_late(now + 2s)) << "what came with it was typed long ago";
  now += 2100ms;
  EXPECT_NE(watch.ask(now), "");
  answer(watch, now + 50ms);
  EXPECT_FALSE(watch.is_late(now + 50ms));
}
TEST(TerminalWatch, NoKeyCountsBeforeTheFirstAnswer) {
  TerminalWatch watch;
  EXPECT_TRUE(watch.is_late(Time{10s}));
  EXPECT_FALSE(watch.is_silent(Time{10s}));
  EXPECT_NE(watch.ask(Time{10s}), "");
  EXPECT_TRUE(watch.is_late(Time{10s} + 10ms));
  EXPECT_FALSE(watch.is_silent(Time{11s})) << "it may answer yet";
  answer(watch, Time{11s});
  EXPECT_TRUE(watch.is_late(Time{11s})) << "it took a second";
}
TEST(TerminalWatch, OfATerminalThatNeverAnswersNothingIsKnownAndNoKeyCounts) {
  TerminalWatch watch;
  EXPECT_NE(watch.ask(Time{10s}), "");
  EXPECT_TRUE(watch.is_late(Time{100s}));
  EXPECT_TRUE(watch.is_silent(Time{12100ms}));
}
TEST(TerminalWatch, LeavesKeysAlone) {
  TerminalWatch watch;
  EXPECT_FALSE(watch.take(' ', Time{10s}));
  EXPECT_TRUE(watch.take('\033', Time{10s}));
  EXPECT_FALSE(watch.take('q', Time{10s}));
  EXPECT_FALSE(watch.take(' ', Time{10s}));
}
TEST(TerminalWatch, KnowsWhoAnswersForTheTerminal) {
  EXPECT_EQ(answers_for_the_terminal({}), "");
  EXPECT_EQ(answers_for_the_terminal({.tmux = "/tmp/tmux-0/default,7,0"}), "tmux");
  EXPECT_EQ(answers_for_the_terminal({.screen = "7.pts-0.robot"}), "screen");
  EXPECT_EQ(answers_for_the_terminal({.kind = "tmux-256color", .sudo_user = "ann"}), "tmux");
  EXPECT_EQ(answers_for_the_terminal({.kind = "screen.xterm", .sudo_user = "ann"}),
            "tmux or screen");
  EXPECT_EQ(answers_for_the_terminal({.kind = "tmux-256color"}), "") << "the person's own end";
  EXPECT_EQ(answers_for_the_terminal({.kind = "xterm", .sudo_user = "ann"}), "");
}

}  // namespace
}  // namespace drover::cli
