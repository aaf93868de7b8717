#include "mission/bound.h"

#include <gtest/gtest.h>

namespace drover::mission {
namespace {

TruthLine true_at(double time_s, double x_m, double vx_mps) {
  TruthLine line;
  line.time = Time{from_s(time_s)};
  line.x_m = x_m;
  line.vx_mps = vx_mps;
  return line;
}

Status told_at(double time_s, double x_m, double bound_m) {
  Status status;
  status.time = Time{from_s(time_s)};
  status.sim = {x_m, 0};
  status.document = {{"nav", {{"error_bound_m", bound_m}}}};
  return status;
}

TEST(BeyondItsBound, CountsForAsLongAsUntilTheNextWord) {
  Record record;
  record.truth = {true_at(0, 0, 1), true_at(1, 1, 1)};
  record.statuses = {told_at(0.1, 0.1, 0.05), told_at(0.2, 0.3, 0.05), told_at(0.3, 0.34, 0.05),
                     told_at(0.4, 0.4, 0.05)};
  const BeyondBound beyond = beyond_bound(record);
  EXPECT_NEAR(beyond.moved_s, 0.1, 1e-9);
  EXPECT_NEAR(beyond.worst_m, 0.05, 1e-9);
}

TEST(BeyondItsBound, IsNothingAtRestOrWithoutABound) {
  Record record;
  record.truth = {true_at(0, 0, 0), true_at(1, 0, 0)};
  record.statuses = {told_at(0.1, 3, 0.05), told_at(0.2, 3, 0.05)};
  EXPECT_EQ(beyond_bound(record).moved_s, 0);
  record.truth = {true_at(0, 0, 1), true_at(1, 1, 1)};
  for (Status& status : record.statuses) status.document = {{"nav", nlohmann::json::object()}};
  EXPECT_EQ(beyond_bound(record).moved_s, 0);
}

TEST(StoodInATask, IsWhatItStoodForAReasonWhileTheTaskRan) {
  Record record;
  record.truth = {true_at(0, 0, 1), true_at(0.05, 0, 1), true_at(0.06, 0, 0), true_at(2, 0, 0)};
  for (int i = 0; i < 10; ++i) {
    Status status = told_at(0.1 * i, 0, 0.1);
    status.nav = i < 8 ? "NAV_RUN" : "NAV_ERROR";
    status.why = i == 1 || i == 2 || i == 5 || i > 7 ? "stands and looks" : "";
    record.statuses.push_back(status);
  }
  const Stood stood = stood_in_task(record);
  EXPECT_NEAR(stood.for_s, 0.3, 1e-9);
  EXPECT_EQ(stood.times, 2);
  record.truth.front().vx_mps = record.truth[1].vx_mps = 0;
  EXPECT_EQ(stood_in_task(record).times, 0) << "it never moved";
  record.truth = {true_at(0, 0, 0.5), true_at(2, 1, 0.5)};
  EXPECT_EQ(stood_in_task(record).times, 0) << "it drives";
}

}  // namespace
}  // namespace drover::mission
