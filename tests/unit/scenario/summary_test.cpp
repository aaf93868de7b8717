#include "sim/scenario/summary.h"

#include <gtest/gtest.h>

#include <optional>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace drover::sim {
namespace {

std::vector<TruthSample> read(const std::string& text) {
  std::istringstream stream(text);
  return read_truth(stream);
}

TEST(Truth, RefusesAFileWithoutItsColumns) {
  EXPECT_THROW(read("time_s,x_m,z_m\n1,2,3\n"), std::runtime_error);
  EXPECT_THROW(read(""), std::runtime_error);
}

TEST(Truth, RefusesLinesThatAreNoNumbersOrOfAnotherLength) {
  EXPECT_THROW(read("time_s,x_m,y_m\n1,2,three\n"), std::runtime_error);
  EXPECT_THROW(read("time_s,x_m,y_m\n1,2\n"), std::runtime_error);
}

TEST(Truth, FindsColumnsByNameAndLeavesOutALineThatWasCut) {
  const auto samples = read("y_m,time_s,other,x_m\n2,1.5,9,-3\n2,1.6,9");
  ASSERT_EQ(samples.size(), 1U);
  EXPECT_DOUBLE_EQ(samples[0].time_s, 1.5);
  EXPECT_DOUBLE_EQ(samples[0].x_m, -3);
  EXPECT_DOUBLE_EQ(samples[0].y_m, 2);
}

const std::vector<TrackPose> kTrack{{0, 0, 0}, {5, 0, 0}, {10, 0, 0}};

TEST(DriveFigures, AreNothingWithoutSamplesInTheTime) {
  const auto figures = measure_drive({{1, 0, 0}, {9, 1, 1}}, kTrack, 2, 2, 8);
  EXPECT_EQ(figures.distance_m, 0);
  EXPECT_EQ(figures.cross_track_max_m, 0);
}

TEST(DriveFigures, CountOnlyTheTimeOfTheDrive) {
  const auto figures =
      measure_drive({{0, 0, 5}, {1, 0, 0}, {2, 3, 0}, {3, 7, 0}, {4, 7, 9}}, kTrack, 2, 1, 3);
  EXPECT_DOUBLE_EQ(figures.time_s, 2);
  EXPECT_DOUBLE_EQ(figures.distance_m, 7);
  EXPECT_DOUBLE_EQ(figures.cross_track_max_m, 0);
  EXPECT_DOUBLE_EQ(figures.goal_distance_m, 3);
}

TEST(DriveFigures, WeighTheErrorByTheWayAndNotByTheTimeStoodStill) {
  std::vector<TruthSample> truth{{0, 0, 0.1}, {1, 4, 0.1}};
  const auto moving = measure_drive(truth, kTrack, 2, 0, 100);
  for (int i = 2; i < 90; ++i) truth.push_back({static_cast<double>(i), 4, 0.1});
  truth.push_back({91, 4, 0.0});
  const auto standing = measure_drive(truth, kTrack, 2, 0, 100);
  EXPECT_NEAR(moving.cross_track_rms_m, 0.1, 1e-12);
  EXPECT_NEAR(standing.cross_track_rms_m, 0.1, 2e-3);
  EXPECT_NEAR(standing.cross_track_max_m, 0.1, 1e-12);
}

TEST(DriveFigures, MeasureTheDistanceToTheAskedPoint) {
  const auto figures = measure_drive({{0, 0, 0}, {1, 5, 0.03}}, kTrack, 1, 0, 2);
  EXPECT_NEAR(figures.goal_distance_m, 0.03, 1e-12);
}

std::optional<std::vector<std::string>> touches(const std::string& text) {
  std::istringstream stream(text);
  return read_touches(stream);
}

TEST(Touches, AreToldOnceEach) {
  EXPECT_EQ(touches("(0.880000000) watching 36\n"
                    "(1.905000000) put box box -4 -4.1 0.4 0.26 0.6 0.4 0.8\n"
                    "(2.000000000) touch box 1 2 0 0.5 0 0 0.001\n"
                    "(2.100000000) leave box 0.002 0.5 0\n"
                    "(2.200000000) touch pole 1 2 0 0.5 0 0 0.001\n"
                    "(2.300000000) touch box 1 2 0 0.5 0 0 0.001\n"),
            (std::vector<std::string>{"box", "pole"}));
}

TEST(Touches, AreNoneOnlyWhereSomebodyWatched) {
  EXPECT_EQ(touches("(0.880000000) watching 36\n"), std::vector<std::string>{});
  EXPECT_EQ(touches(""), std::nullopt);
}

}  // namespace
}  // namespace drover::sim
