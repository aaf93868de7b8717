// A value over time and its integral, against what is plain to see.
#include "calibrate/series.h"

#include <gtest/gtest.h>

#include <random>

namespace drover::calibrate {
namespace {

TEST(Series, GoesStraightBetweenSamplesAndStaysOutside) {
  const Series series({1, 2, 4}, {10, 20, 0});
  EXPECT_EQ(series.at(0), 10);
  EXPECT_EQ(series.at(1.5), 15);
  EXPECT_EQ(series.at(2), 20);
  EXPECT_EQ(series.at(3), 10);
  EXPECT_EQ(series.at(9), 0);
  EXPECT_EQ(series.integral(1, 2), 15);
  EXPECT_EQ(series.integral(2, 4), 20);
  EXPECT_EQ(series.integral(0, 1), 10);
  EXPECT_EQ(series.integral(4, 100), 0);
}

TEST(Series, FindsItsSamplesHoweverUnevenTheyAre) {
  std::mt19937_64 random(3);
  std::vector<double> times_s;
  double now_s = 50;
  for (int i = 0; i < 500; ++i) {
    now_s += random() % 5 == 0 ? 7.5 : 0.001 * static_cast<double>(1 + random() % 50);
    times_s.push_back(now_s);
  }
  const Series series(times_s, times_s);  // the value is the time
  for (int i = 0; i < 20000; ++i) {
    const double span_s = times_s.back() - times_s.front();
    const double at_s = times_s.front() + span_s * static_cast<double>(i) / 20000;
    ASSERT_NEAR(series.at(at_s), at_s, 1e-9);
    ASSERT_NEAR(series.integral(at_s), (at_s * at_s - times_s.front() * times_s.front()) / 2, 1e-4);
  }
  for (const double time_s : times_s) ASSERT_EQ(series.at(time_s), time_s);
}

TEST(Series, IsZeroWithoutSamplesAndConstantWithOne) {
  EXPECT_EQ(Series().at(3), 0);
  EXPECT_EQ(Series().integral(1, 3), 0);
  EXPECT_EQ(Series({5}, {2}).at(9), 2);
  EXPECT_EQ(Series({5}, {2}).integral(6, 9), 6);
}

TEST(Series, KnowsItsGapsAndChanges) {
  const Series series({0, 1, 2, 5, 6}, {0, 1, 0, 0.01, 1});
  EXPECT_TRUE(series.covers(0, 2, 1));
  EXPECT_FALSE(series.covers(1, 5.5, 1));
  EXPECT_FALSE(series.covers(5, 9, 1));
  EXPECT_NEAR(series.variation(0.1), 3, 0.02);
}

}  // namespace
}  // namespace drover::calibrate
