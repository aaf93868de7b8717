// A log of a simulated drive, estimated: the poses are where the robot was, as in the estimator's
// own tests.
#include "cli/estimate_run.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <map>
#include <random>
#include <sstream>

#include "cli/pose_table.h"
#include "drover/angle.h"
#include "engine/estimate/local_frame.h"
#include "unit/engine/estimate/rig.h"

namespace drover::cli {
namespace {

using engine::estimate::kField;
using testing::HasSubstr;

struct TruePlace {
  double x_m = 0;
  double y_m = 0;
  double yaw_rad = 0;
};

/// A drive round a curve and a straight way, as a logger of a robot writes it: 20 wheel speeds and
/// gyro samples a second, 10 positions 80 ms late.
struct Drive {
  std::string log;
  std::map<long, TruePlace> truth;  ///< by twentieths of a second
};

Drive drive(bool as_twist = false) {
  constexpr double kTrack_m = 0.6;
  Drive made;
  engine::estimate::LocalFrame frame;
  frame.set_origin(kField);
  std::mt19937 random(7);
  std::normal_distribution<double> normal;
  std::ostringstream log;
  log.precision(12);
  log << "time_s,received_s," << (as_twist ? "vx_mps,wz_radps" : "left_rim_mps,right_rim_mps")
      << ",gyro_z_radps,latitude_deg,longitude_deg,altitude_m,quality,heading_deg\n";
  TruePlace at;
  std::string late;
  for (int i = 0; i < 60 * 20; ++i) {
    const double t_s = 0.05 * i;
    const double vx_mps = t_s < 2 ? 0 : 0.5;
    const double wz_radps = t_s > 20 && t_s < 30 ? 0.3 : 0;
    at.yaw_rad += 0.5 * 0.05 * wz_radps;
    at.x_m += 0.05 * vx_mps * std::cos(at.yaw_rad);
    at.y_m += 0.05 * vx_mps * std::sin(at.yaw_rad);
    at.yaw_rad += 0.5 * 0.05 * wz_radps;
    const double half_mps = 0.5 * kTrack_m * wz_radps;
    log << t_s + 0.05 << ',' << t_s + 0.05 << ',' << (as_twist ? vx_mps : vx_mps - half_mps) << ','
        << (as_twist ? wz_radps : vx_mps + half_mps) << ','
        << wz_radps + 0.01 + 0.002 * normal(random) << ",,,,,\n"
        << late;
    late.clear();
    made.truth[std::lround(20 * (t_s + 0.05))] = at;
    if (i % 2 != 0) continue;
    const auto place = frame.geodetic(
        {at.x_m + 0.01 * normal(random), at.y_m + 0.01 * normal(random)}, kField.altitude_m);
    std::ostringstream fix;
    fix.precision(12);
    fix << t_s + 0.05 << ',' << t_s + 0.1 << ",,,," << place.latitude_deg << ','
        << place.longitude_deg << ',' << kField.altitude_m << ",4,"
        << compass_deg_from_yaw_rad(at.yaw_rad + 0.003 * normal(random)) << "\n";
    late = fix.str();
  }
  made.log = log.str();
  return made;
}

EstimateRun settings() {
  EstimateRun run;
  run.config = engine::estimate::rig_config();
  run.origin = kField;
  return run;
}

/// Rows of a table, by the names in its first line. No cell of ours has a comma but the last two.
std::vector<std::map<std::string, std::string>> rows_of(const std::string& table) {
  std::istringstream in(table);
  std::string line;
  const auto cells = [&] {
    std::vector<std::string> found(1);
    for (const char c : line) c == ',' ? (void)found.emplace_back() : found.back().push_back(c);
    return found;
  };
  std::getline(in, line);
  const auto names = cells();
  std::vector<std::map<std::string, std::string>> rows;
  while (std::getline(in, line)) {
    const auto values = cells();
    EXPECT_GE(values.size(), names.size()) << line;
    auto& row = rows.emplace_back();
    for (std::size_t i = 0; i < names.size(); ++i) row[names[i]] = values[i];
  }
  return rows;
}

double rms_m(const Drive& made, const std::string& table) {
  double sum = 0;
  int n = 0;
  for (auto& row : rows_of(table)) {
    const double t_s = std::stod(row["time_s"]);
    const auto truth = made.truth.find(std::lround(20 * t_s));
    if (t_s < 10 || truth == made.truth.end()) continue;
    EXPECT_NE(row["x_m"], "") << t_s;
    if (row["x_m"].empty()) return INFINITY;
    const double off_m = std::hypot(std::stod(row["x_m"]) - truth->second.x_m,
                                    std::stod(row["y_m"]) - truth->second.y_m);
    EXPECT_LE(off_m, std::stod(row["error_bound_m"])) << t_s;
    sum += off_m * off_m;
    ++n;
  }
  EXPECT_GT(n, 400);
  return std::sqrt(sum / n);
}

TEST(EstimateOfALog, IsWhereTheRobotWas) {
  const Drive made = drive();
  std::istringstream in(made.log);
  std::ostringstream out;
  const auto outcome = estimate(in, settings(), out);
  EXPECT_EQ(outcome.problem, "");
  EXPECT_EQ(outcome.rows, 1200U + 600U);
  EXPECT_NEAR(static_cast<double>(outcome.poses), 600, 3) << "ten a second";
  const double off_m = rms_m(made, out.str());
  std::printf("  rms %.4f m\n", off_m);
  EXPECT_LT(off_m, 0.015);
  auto last = rows_of(out.str()).back();
  EXPECT_EQ(last["quality"], "4");
  EXPECT_NEAR(std::stod(last["vx_mps"]), 0.5, 0.02);
}

TEST(EstimateOfALog, IsTheSameByATwistAsByRims) {
  const Drive made = drive(true);
  std::istringstream in(made.log);
  std::ostringstream out;
  EXPECT_EQ(estimate(in, settings(), out).problem, "");
  EXPECT_LT(rms_m(made, out.str()), 0.015);
}

TEST(EstimateOfALog, HoldsForABaseThatTakesATwist) {
  for (const bool as_twist : {false, true}) {
    const Drive made = drive(as_twist);
    EstimateRun run = settings();
    run.config.base = {};
    run.config.base.kind = engine::BaseKind::twist;
    std::istringstream in(made.log);
    std::ostringstream out;
    EXPECT_EQ(estimate(in, run, out).problem, "");
    EXPECT_LT(rms_m(made, out.str()), 0.02);
  }
}

TEST(EstimateOfALog, CountsFromTheFirstPositionWhereNoOriginIsGiven) {
  const Drive made = drive();
  std::istringstream in(made.log);
  std::ostringstream out;
  EstimateRun run = settings();
  run.origin.reset();
  EXPECT_EQ(estimate(in, run, out).problem, "");
  EXPECT_LT(rms_m(made, out.str()), 0.04) << "by the noise of that position beside the other one";
}

TEST(EstimateOfALog, HasEmptyCellsAndAReasonBeforeThereIsAPlace) {
  std::istringstream in("time_s,vx_mps,wz_radps\n0,0,0\n0.5,0,0\n");
  std::ostringstream out;
  EXPECT_EQ(estimate(in, settings(), out).problem, "");
  auto first = rows_of(out.str()).front();
  EXPECT_EQ(first["x_m"], "");
  EXPECT_EQ(first["error_bound_m"], "");
  EXPECT_EQ(first["quality"], "");
  EXPECT_EQ(first["reason"], "\"no position yet\"");
}

TEST(EstimateOfALog, EndsAtWhatIsWrongAndSaysWhere) {
  std::istringstream in("time_s,vx_mps,wz_radps\n0,0,0\n1,0,zero\n2,0,0\n");
  std::ostringstream out;
  const auto outcome = estimate(in, settings(), out);
  EXPECT_EQ(outcome.problem, "line 3, column 3 (wz_radps): \"zero\" is no number");
  EXPECT_EQ(outcome.rows, 1U);
  std::istringstream nothing("\n# nothing\n");
  EXPECT_THAT(estimate(nothing, settings(), out).problem, HasSubstr("no row"));
}

TEST(EstimateOfALog, TellsAFileThatCannotBeReadFromOneWithoutARow) {
  std::ifstream folder("/");
  std::ostringstream out;
  EXPECT_EQ(estimate(folder, settings(), out).problem, "cannot be read");
}

TEST(EstimateOfALog, HasTheTimesOfTheLogInItsRows) {
  std::istringstream in(
      "time_s,vx_mps,wz_radps\n1772373900.25,0,0\n1772373900.75,0,0\n1772373901,0,0\n");
  std::ostringstream out;
  const auto outcome = estimate(in, settings(), out);
  EXPECT_EQ(outcome.problem, "");
  ASSERT_GE(outcome.poses, 7U);
  EXPECT_NEAR(std::stod(rows_of(out.str()).back()["time_s"]), 1772373900.95, 0.1);
}

TEST(RowTimes, KeepTheirRateAfterAGap) {
  constexpr auto at = [](double s) { return Time{from_s(s)}; };
  RowTimes rows(10);
  rows.begin(at(1));
  std::vector<double> due_s;
  for (int i = 0; i < 150; ++i) {
    const double now_s = i < 50 ? 1 + 0.01 * i : 60 + 0.01 * i;
    if (rows.is_due(at(now_s))) due_s.push_back(now_s);
  }
  ASSERT_EQ(due_s.size(), 15U);
  EXPECT_NEAR(due_s[5], 60.5, 1e-9) << "the first after it";
  for (std::size_t i = 6; i < due_s.size(); ++i) EXPECT_NEAR(due_s[i] - due_s[i - 1], 0.1, 1e-9);
}

}  // namespace
}  // namespace drover::cli
