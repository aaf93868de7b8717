#include "runtime/late_looks.h"

#include <gtest/gtest.h>

namespace drover::runtime {
namespace {

using namespace std::chrono_literals;

/// One look after the other, each as long as `took`.
struct Looks {
  LateLooks late{100ms, 250ms};
  Time now{100s};

  void look(Duration took, int times = 1) {
    for (int i = 0; i < times; ++i) {
      const Time seen = now;
      now += took;
      late.note(seen, now);
    }
  }
  std::string words() const { return std::string(late.words(900, 1000).view()); }
};

TEST(LateLooks, SayNothingOfLooksInTime) {
  Looks looks;
  looks.look(45ms, 100);
  EXPECT_EQ(looks.words(), "");
}

TEST(LateLooks, SayNothingOfASingleOne) {
  Looks looks;
  looks.look(25ms, 10);
  looks.look(180ms);
  looks.look(25ms, 10);
  EXPECT_EQ(looks.words(), "");
}

TEST(LateLooks, SayForHowLongNobodyLookedAndAtHowMuch) {
  Looks looks;
  looks.look(25ms, 10);
  looks.look(70ms, 3);
  EXPECT_EQ(looks.words(), "") << "not yet";
  looks.look(70ms, 5);
  EXPECT_EQ(looks.words(),
            "nobody looked for 0.14 s: the scene takes too long (900 objects, 1000 constraints)");
  looks.look(25ms, 4);
  EXPECT_NE(looks.words(), "") << "the next one may be late again";
  looks.look(25ms);
  EXPECT_EQ(looks.words(), "");
}

TEST(LateLooks, AreNotTakenBackForOneThatIsInTimeNowAndThen) {
  Looks looks;
  for (int i = 0; i < 10; ++i) {
    looks.look(110ms, 2);
    looks.look(30ms, 2);
    if (i > 2) {
      EXPECT_NE(looks.words(), "") << i;
    }
  }
}

}  // namespace
}  // namespace drover::runtime
