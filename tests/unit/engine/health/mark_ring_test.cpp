// What was so a moment ago.
#include "engine/health/mark_ring.h"

#include <gtest/gtest.h>

namespace drover::engine {
namespace {

using std::chrono::milliseconds;

struct Mark {
  Time at = kNever;
  int number = 0;
};
Time ms(int count) {
  return Time{std::chrono::seconds(10) + milliseconds(count)};
}

class AMarkRing : public ::testing::Test {
 protected:
  void remember(int from_ms, int until_ms, int each_ms) {
    for (int at = from_ms; at <= until_ms; at += each_ms) ring.remember({ms(at), at});
  }
  int at(int count) const {
    const Mark* mark = ring.at(ms(count));
    return mark == nullptr ? -1 : mark->number;
  }
  MarkRing<Mark> ring;
};

TEST_F(AMarkRing, HasNothingAtFirst) {
  EXPECT_EQ(at(0), -1);
}

TEST_F(AMarkRing, GivesTheNearest) {
  remember(0, 1000, 10);
  EXPECT_EQ(at(504), 500);
  EXPECT_EQ(at(506), 510);
  EXPECT_EQ(at(1009), 1000);
}

TEST_F(AMarkRing, GivesNothingOfWhatIsNotNear) {
  remember(0, 100, 10);
  remember(200, 300, 10);
  EXPECT_EQ(at(150), -1);
  EXPECT_EQ(at(320), -1);
  EXPECT_EQ(at(119), 100);
}

TEST_F(AMarkRing, ReachesASecondBackHoweverFastTheyCome) {
  remember(0, 3000, 1);
  EXPECT_EQ(at(2000), 2000);
  EXPECT_EQ(at(1000), -1);
}

TEST_F(AMarkRing, ForgetsThemAll) {
  remember(0, 1000, 10);
  ring.clear();
  EXPECT_EQ(at(500), -1);
  remember(2000, 2010, 10);
  EXPECT_EQ(at(2010), 2010);
}

}  // namespace
}  // namespace drover::engine
