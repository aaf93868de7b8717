// What becomes of a task when something ordinary goes wrong: rows of seeded drives of the whole
// engine in the field of field_world.h. For people: `bench_events --help`.
#include <array>
#include <cstdio>
#include <cstring>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "bench/field_world.h"

namespace drover::bench {
namespace {

/// `share` in [0, 1) and `seed` draw what the row leaves open.
using Change =
    std::function<void(FieldPlan&, engine::EngineConfig&, double share, std::uint64_t seed)>;

/// What each drive of a row is judged by.
enum class Must {
  reach,    ///< the target, and the next two
  be_true,  ///< never moved beyond the published bound or the corridor
};

struct Row {
  const char* name;
  const char* what;
  Change change;
  int rows = 2;
  double leg_m = 20;
  Must must = Must::reach;
};

using Config = engine::EngineConfig;

/// For so long, somewhere on the first row.
Span while_s(double share, double for_s) {
  return {8 + 20 * share, 8 + 20 * share + for_s};
}

Change slip(double slip_share, double for_s = 2) {
  return [=](FieldPlan& p, Config&, double share, std::uint64_t) {
    p.slip_s = while_s(share, for_s);
    p.slip_share = slip_share;
  };
}

Change shoved(double aside_m) {
  return [=](FieldPlan& p, Config&, double share, std::uint64_t seed) {
    p.shove_at_s = while_s(share, 0).from;
    p.shove_left_m = seed % 2 == 0 ? aside_m : -aside_m;
  };
}

Change stepped(double step_m) {
  return [=](FieldPlan& p, Config&, double share, std::uint64_t) {
    p.step_s = while_s(share, 10);
    p.step_m = step_m;
    p.step_rad = 2 * kPi * share * 7;
  };
}

/// Another draw of a row.
double another(double share, double times) {
  return times * share - std::floor(times * share);
}

/// No RTK fix for so long, as receivers lose it: a float all the time, no position, or that and a
/// float of 3 s at its end. The antenna line is known to every second robot.
void lose_fix(FieldPlan& p, Config& c, double share, std::uint64_t seed, double for_s) {
  const Span lost = while_s(share, for_s);
  const double float_s = seed % 3 == 0 ? for_s : seed % 3 == 1 ? 0 : 3;
  p.outage_s = {lost.from, lost.to - float_s};
  p.float_s = {lost.to - float_s, lost.to};
  if (seed % 2 == 0) c.estimate.heading_mount_sigma_deg = 0.1;
}

/// Found again 0.35, 0.5 or 0.7 m beside, any direction, for 20 to 60 s or for good.
Change found_wrong(double lost_s, bool stays) {
  return [=](FieldPlan& p, Config& c, double share, std::uint64_t seed) {
    lose_fix(p, c, share, seed, lost_s);
    const double from_s = while_s(share, lost_s).to;
    p.step_s = {from_s, stays ? INFINITY : from_s + 20 + 40 * another(share, 13)};
    p.step_m = std::array{0.35, 0.5, 0.7}[seed / 3 % 3];
    p.step_rad = 2 * kPi * another(share, 7);
  };
}

Change mounted(double off_deg) {
  return [=](FieldPlan& p, Config&, double, std::uint64_t) { p.heading_off_deg = off_deg; };
}

Change drifts(double from_m, double within_m) {
  return [=](FieldPlan& p, Config&, double share, std::uint64_t) {
    p.drift_m = {from_m + within_m * share, INFINITY};
    p.drift_mps = 0.02;
  };
}

Change slope(double slope_deg, double crab_per_slope = FieldPlan{}.crab_per_slope) {
  return [=](FieldPlan& p, Config&, double share, std::uint64_t) {
    p.slope_m = {4 + 4 * share, 40};
    p.slope_deg = slope_deg;
    p.crab_per_slope = crab_per_slope;
  };
}

void at_1_mps(FieldPlan& p, Config& c) {
  p.speed_mps = 1;
  c.limits.max_speed_mps = 1.2;
}

const std::vector<Row>& all_rows() {
  using Plan = FieldPlan;
  static const std::vector<Row> rows{
      {"well", "nothing is wrong", [](Plan&, Config&, double, std::uint64_t) {}},
      {"well_1mps", "nothing is wrong, at 1 m/s",
       [](Plan& p, Config& c, double, std::uint64_t) { at_1_mps(p, c); }},
      {"drift_early", "20 mm/s sideways from 3 to 12 m on", drifts(3, 9), 1, 70, Must::be_true},
      {"drift_late", "20 mm/s sideways from 25 to 60 m on, after two legs", drifts(85, 35), 4, 40,
       Must::be_true},
      {"slope_2", "side slope of 2 degrees, entered and left", slope(2), 2, 30},
      {"slope_5", "side slope of 5 degrees, entered and left", slope(5), 2, 30},
      {"slope_5_wet", "the same where it is wet: a degree of crab for each", slope(5, 1), 2, 30},
      {"mount_1", "heading mounted 1 degree off", mounted(1)},
      {"mount_3", "heading mounted 3 degrees off", mounted(3), 4, 20},
      {"mount_5", "heading mounted 5 degrees off", mounted(-5), 4, 20},
      {"mount_2_outage", "2 degrees off, 30 s without receiver on the fourth leg",
       [](Plan& p, Config& c, double, std::uint64_t) {
         p.heading_off_deg = 2;
         p.outage_s = {155, 185};
         c.estimate.bound_run_m = 0.6;
       },
       4, 20},
      {"slip_25", "slip of 25 % for 2 s", slip(0.25)},
      {"slip_30", "slip of 30 % for 2 s", slip(0.30)},
      {"slip_35", "slip of 35 % for 2 s", slip(0.35)},
      {"slip_10s", "slip of 30 % for 10 s", slip(0.30, 10)},
      {"shove_14", "shoved 14 cm aside", shoved(0.14)},
      {"shove_25", "shoved 25 cm aside", shoved(0.25)},
      {"shove_40", "shoved 40 cm aside", shoved(0.40)},
      {"step_8", "another integer solution, 8 cm off for 10 s, any direction", stepped(0.08)},
      {"step_15", "15 cm", stepped(0.15)},
      {"step_30", "30 cm", stepped(0.30)},
      {"step_50", "50 cm", stepped(0.50)},
      {"refix_40", "float for 3 s, then for good a fix that is 40 cm off",
       [](Plan& p, Config&, double share, std::uint64_t) {
         p.float_s = while_s(share, 3);
         p.step_s = {p.float_s.to, INFINITY};
         p.step_m = 0.4;
         p.step_rad = 2 * kPi * share * 7;
       },
       2, 20, Must::be_true},
      {"found_right", "no RTK fix for 10 to 40 s, then a right one",
       [](Plan& p, Config& c, double share, std::uint64_t seed) {
         lose_fix(p, c, share, seed, 10 + 30 * another(share, 11));
       }},
      {"wrong_10", "no RTK fix for 10 s, then one 0.35 to 0.7 m beside for 20 to 60 s",
       found_wrong(10, false), 2, 20, Must::be_true},
      {"wrong_20", "the same after 20 s", found_wrong(20, false), 2, 20, Must::be_true},
      {"wrong_40", "the same after 40 s", found_wrong(40, false), 2, 20, Must::be_true},
      {"wrong_stays_10", "no RTK fix for 10 s, then for good one 0.35 to 0.7 m beside",
       found_wrong(10, true), 2, 20, Must::be_true},
      {"wrong_stays_20", "the same after 20 s", found_wrong(20, true), 2, 20, Must::be_true},
      {"wrong_stays_40", "the same after 40 s", found_wrong(40, true), 2, 20, Must::be_true},
      {"slip_30_1mps", "slip of 30 % for 2 s, at 1 m/s",
       [](Plan& p, Config& c, double share, std::uint64_t seed) {
         slip(0.30)(p, c, share, seed);
         at_1_mps(p, c);
       }},
      {"late_50_1mps", "stamps 50 ms late, at 1 m/s",
       [](Plan& p, Config& c, double, std::uint64_t) {
         p.late_s = 0.05;
         at_1_mps(p, c);
       },
       4, 20},
      {"late_200", "stamps 200 ms late",
       [](Plan& p, Config&, double, std::uint64_t) { p.late_s = 0.2; }, 4, 20},
      {"epochs", "the heading is an epoch older than the position",
       [](Plan& p, Config&, double, std::uint64_t) { p.heading_epoch_s = 0.1; }, 4, 20},
      {"lever_x_20", "antenna 20 cm farther ahead than told",
       [](Plan& p, Config&, double, std::uint64_t) { p.lever_x_m = 0.2; }, 4, 20, Must::be_true},
      {"lever_y_20", "antenna 20 cm farther to the left than told",
       [](Plan& p, Config&, double, std::uint64_t) { p.lever_y_m = 0.2; }, 4, 20, Must::be_true},
      {"imu_roll_1", "inertial sensor rolled by 1 degree, antenna 1.5 m up",
       [](Plan& p, Config& c, double, std::uint64_t) {
         p.imu_roll_deg = 1;
         c.estimate.antenna_z_m = 1.5;
       },
       4, 20},
      {"tyres_3", "tyres 3 % low", [](Plan& p, Config&, double, std::uint64_t) { p.tyres = 0.97; },
       4, 20},
      {"ambiguity", "heading 5 to 30 degrees wrong for 3 s",
       [](Plan& p, Config&, double share, std::uint64_t seed) {
         p.heading_wrong_s = while_s(share, 3);
         p.heading_wrong_deg = (5 + 25 * share) * (seed % 2 == 0 ? 1 : -1);
       }},
      {"swapped", "antennas swapped", mounted(180), 2, 20, Must::be_true},
      {"two_cm", "receiver of 2 cm without GST",
       [](Plan& p, Config&, double, std::uint64_t) { p.sigma_m = 0.02; }, 4, 20},
      {"float_10", "float for 10 s",
       [](Plan& p, Config&, double share, std::uint64_t) { p.float_s = while_s(share, 10); }},
      {"outage_10", "no receiver for 10 s",
       [](Plan& p, Config&, double share, std::uint64_t) { p.outage_s = while_s(share, 10); }},
      {"no_imu", "without inertial sensor",
       [](Plan& p, Config&, double, std::uint64_t) { p.imu = false; }},
      {"heading_lost", "the receiver's heading is lost for good on the first row",
       [](Plan& p, Config&, double share, std::uint64_t) {
         p.no_heading_s.from = 8 + 20 * share, p.no_heading_s.to = INFINITY;
       },
       4, 20},
      {"one_antenna", "no heading from the start on, once it is known",
       [](Plan& p, Config&, double, std::uint64_t) {
         p.no_heading_s = {0.5, INFINITY};
       },
       4, 20},
      {"one_antenna_no_gyro", "the same without inertial sensor",
       [](Plan& p, Config&, double, std::uint64_t) {
         p.no_heading_s = {0.5, INFINITY};
         p.imu = false;
       },
       4, 20},
      {"tyres_8", "a radius 8 % wrong",
       [](Plan& p, Config&, double, std::uint64_t) { p.tyres = 0.92; }, 4, 20},
      {"five_Hz", "receiver of 5 Hz",
       [](Plan& p, Config&, double, std::uint64_t) { p.receiver_Hz = 5; }},
  };
  return rows;
}

double share_of(std::uint64_t seed) {
  const double x = static_cast<double>(seed) * 0.6180339887498949;
  return x - std::floor(x);
}

struct Sum {
  int drives = 0, successes = 0;
  double pauses = 0, paused_s = 0, outside_s = 0, beyond_s = 0, rms_m = 0, p95_m = 0, max_m = 0;
  double time_s = 0, two_sigma = 0, three_sigma = 0;
};

Judgement drive_row(const Row& row, std::uint64_t seed) {
  FieldPlan plan;
  engine::EngineConfig config = field_config();
  row.change(plan, config, share_of(seed), seed);
  FieldWorld world(config, plan, seed);
  const Path path = field_rows(row.rows, row.leg_m);
  const double length_m = row.rows * row.leg_m + (row.rows - 1) * kPi * 1.5;
  return world.drive(path, 3 * length_m / plan.speed_mps + 120);
}

void print_header() {
  std::printf("%-15s %7s %6s %6s %6s %7s %7s %8s %8s %6s %6s %7s\n", "row", "success", "rms", "p95",
              "max mm", "pauses", "paused", "outside", "beyond", "2sig", "3sig", "time s");
}

bool is_well(const Row& row, const Sum& sum) {
  const bool reached = row.must != Must::reach || sum.successes == sum.drives;
  return reached && sum.outside_s == 0 && sum.beyond_s == 0;
}

bool run_row(const Row& row, std::uint64_t first, int seeds, bool each) {
  Sum sum;
  std::vector<std::string> words;
  for (int i = 0; i < seeds; ++i) {
    const std::uint64_t seed = first + static_cast<std::uint64_t>(i);
    const Judgement j = drive_row(row, seed);
    ++sum.drives;
    sum.successes += j.success ? 1 : 0;
    sum.pauses += j.pauses;
    sum.paused_s += j.paused_s;
    sum.outside_s += j.outside_s;
    sum.beyond_s += j.beyond_s;
    sum.rms_m += j.rms_m * j.rms_m;
    sum.p95_m = std::max(sum.p95_m, j.p95_m);
    sum.max_m = std::max(sum.max_m, j.max_m);
    sum.time_s += j.time_s;
    sum.two_sigma += j.inside_two_sigma;
    sum.three_sigma += j.inside_three_sigma;
    if (!j.success) words.push_back(std::to_string(seed) + ": " + j.words);
    if (!each) continue;
    std::printf(
        "  seed %llu: %s, %s; %.1f s, rms %.0f mm, max %.0f mm, goal %.0f mm, outside %.2f s "
        "(worst %.3f m)\n",
        static_cast<unsigned long long>(seed), j.success ? "success" : "NO SUCCESS",
        j.words.c_str(), j.time_s, 1e3 * j.rms_m, 1e3 * j.max_m, 1e3 * j.goal_m, j.outside_s,
        j.worst_outside_m);
    for (const std::string& said : j.said) std::printf("      %s\n", said.c_str());
  }
  const double n = sum.drives;
  std::printf("%-15s %4d/%-2d %6.1f %6.1f %6.0f %7.1f %7.1f %8.2f %8.2f %6.3f %6.3f %7.1f\n",
              row.name, sum.successes, sum.drives, 1e3 * std::sqrt(sum.rms_m / n), 1e3 * sum.p95_m,
              1e3 * sum.max_m, sum.pauses / n, sum.paused_s / n, sum.outside_s, sum.beyond_s,
              sum.two_sigma / n, sum.three_sigma / n, sum.time_s / n);
  if (!is_well(row, sum)) std::printf("                NOT AS IT HAS TO BE\n");
  for (std::size_t i = 0; !each && i < words.size() && i < 2; ++i)
    std::printf("                seed %s\n", words[i].c_str());
  return is_well(row, sum);
}

constexpr const char* kUsage = R"(usage: bench_events [--seeds N] [--first SEED] [--each] [ROW...]

Drives the whole engine over a field in which something ordinary goes wrong, N times (20) from SEED
(1) on, and prints for each row: how many reached the target, cross-track error of the truth (rms,
the worst seed's 95th percentile and maximum, by the way), pauses and their seconds (mean), seconds
of motion with the true error beyond the published bound and beyond the corridor (sum), the share of
time inside two and three published sigma, and the mean time. Without ROW: all rows. --each tells
each drive, with what was said; --list names the rows.

Exit status: 0; 1 a drive moved beyond the published bound or the corridor, or did not reach the
target where it can be reached (drifts, a wrong fix for good and swapped antennas have to be named
instead; a lever arm that nobody told may end it); 2 wrong usage.
)";

int run(int argc, char** argv) {
  std::uint64_t first = 1;
  int seeds = 20;
  bool each = false;
  std::vector<std::string> names;
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    if (word == "--seeds" && i + 1 < argc) {
      seeds = std::atoi(argv[++i]);
    } else if (word == "--first" && i + 1 < argc) {
      first = std::strtoull(argv[++i], nullptr, 10);
    } else if (word == "--each") {
      each = true;
    } else if (word == "--list") {
      for (const Row& row : all_rows()) std::printf("%-15s %s\n", row.name, row.what);
      return 0;
    } else if (word.starts_with("-")) {
      std::fputs(kUsage, word == "--help" ? stdout : stderr);
      return word == "--help" ? 0 : 2;
    } else {
      names.push_back(word);
    }
  }
  for (const std::string& name : names) {
    const auto known = [&](const Row& row) { return row.name == name; };
    if (std::none_of(all_rows().begin(), all_rows().end(), known)) {
      std::fprintf(stderr, "there is no row %s: --list names them\n", name.c_str());
      return 2;
    }
  }
  print_header();
  bool well = true;
  for (const Row& row : all_rows()) {
    if (!names.empty() && std::find(names.begin(), names.end(), row.name) == names.end()) continue;
    well = run_row(row, first, seeds, each) && well;
    std::fflush(stdout);
  }
  return well ? 0 : 1;
}

}  // namespace
}  // namespace drover::bench

int main(int argc, char** argv) {
  return drover::bench::run(argc, argv);
}
