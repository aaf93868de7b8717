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
TEST(TerminalWatch, AKeyCountsWhileItIsSureThatItWasTypedOnlyJustNow) {
  TerminalWatch watch;
  Time now{10s};
  EXPECT_FALSE(watch.counts(now));
  EXPECT_NE(watch.ask(now), "");
  EXPECT_FALSE(watch.counts(now));
  answer(watch, now + 250ms);
  EXPECT_TRUE(watch.counts(now + 250ms));
  EXPECT_NE(watch.ask(now + 250ms), "");
  EXPECT_TRUE(watch.counts(now + 300ms));
  // Typed at once after the first answer it would be older than that.
  EXPECT_FALSE(watch.counts(now + 310ms));
  EXPECT_FALSE(watch.is_late(now + 310ms)) << "but the line is none that is too slow";
  answer(watch, now + 400ms);
  EXPECT_TRUE(watch.counts(now + 400ms)) << "the question was asked 0.15 s ago";
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

}  // namespace
}  // namespace drover::cli
