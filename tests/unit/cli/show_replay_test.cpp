#include "cli/show_replay.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "json/located_json.h"

namespace drover::cli {
namespace {

using gateway::Replayed;
using ::testing::EndsWith;
using ::testing::HasSubstr;

Replayed equal_one() {
  Replayed it;
  it.verdict = Replayed::Verdict::equal;
  it.version = "0.1.0";
  it.cycles = 200;
  it.inputs = 1234;
  it.begin = Time{std::chrono::seconds(50)};
  it.end = Time{std::chrono::seconds(51)};
  return it;
}

Replayed one_that_differs() {
  Replayed it = equal_one();
  it.verdict = Replayed::Verdict::differs;
  it.difference = {77,
                   it.begin + std::chrono::milliseconds(385),
                   "pose.x_m",
                   "1.5",
                   "1.25",
                   3,
                   {"at 50.380000000 s: levels: 1 1", "at 50.385000000 s: tick, guard alive"}};
  return it;
}

TEST(ShowReplay, SaysThatItWasEqualAndForHowLong) {
  EXPECT_EQ(show_replay(equal_one()), "equal: 200 cycles, 1234 inputs, 1.0 s\n");
}

TEST(ShowReplay, NamesTheFirstDifferenceItsTimeAndTheInputsBeforeIt) {
  EXPECT_EQ(show_replay(one_that_differs()),
            "differs in cycle 77, 0.385 s after its begin (at 50.385000000 s): pose.x_m\n"
            "  recorded  1.5\n"
            "  replayed  1.25\n"
            "  and 3 more in that cycle\n"
            "the last inputs before it:\n"
            "  at 50.380000000 s: levels: 1 1\n"
            "  at 50.385000000 s: tick, guard alive\n");
}

TEST(ShowReplay, SuspectsAnotherLibraryOfMathematics) {
  auto it = one_that_differs();
  it.other_mathematics = true;
  EXPECT_THAT(show_replay(it), EndsWith("GLIBC_TUNABLES=glibc.cpu.hwcaps=-FMA,-FMA4,-AVX2\n"));
}

TEST(ShowReplay, TellsWhatWasNotCompared) {
  auto it = equal_one();
  it.not_compared = {"nav.paused", "nav.gone"};
  EXPECT_THAT(show_replay(it), HasSubstr("2 values were not compared"));
}

TEST(ShowReplay, IsOneJsonObject) {
  for (const auto& it : {equal_one(), one_that_differs(), Replayed{}}) {
    const auto document = json::parse(replay_json(it));
    ASSERT_TRUE(document) << replay_json(it);
    EXPECT_NE(document->root.find("verdict"), nullptr);
    const bool equal = it.verdict == Replayed::Verdict::equal;
    EXPECT_EQ(*document->root.find("ok")->boolean(), equal);
    EXPECT_EQ(document->root.find("reason") == nullptr, equal);
    EXPECT_EQ(document->root.find("difference") != nullptr,
              it.verdict == Replayed::Verdict::differs);
  }
}

}  // namespace
}  // namespace drover::cli
