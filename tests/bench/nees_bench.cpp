// Whether the published pose is as good as it says: normalised errors of the whole engine in the
// field of field_world.h. For people: `bench_nees --help`.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "bench/field_nees.h"
#include "bench/field_world.h"

namespace drover::bench {
namespace {

constexpr double kOut_s = 20;  // when an outage begins
constexpr double kEach_s = 0.5;

struct Drive {
  const char* name = "";
  const char* what = "";
  FieldWay way = FieldWay::rows;
  double outage_s = 0;
  bool drawn = false;       ///< mounting, tyres and lateness, from what the configuration believes
  bool calibrated = false;  ///< it is known how the antenna line is mounted
};

constexpr Drive kDrives[] = {
    {"well", "nothing is wrong, two rows", FieldWay::rows},
    {"straight_10", "no receiver for 10 s, on a straight", FieldWay::straight, 10},
    {"straight_30", "30 s", FieldWay::straight, 30},
    {"straight_60", "60 s", FieldWay::straight, 60},
    {"curve_10", "no receiver for 10 s, on a curve of 10 m radius", FieldWay::curve, 10},
    {"curve_30", "30 s", FieldWay::curve, 30},
    {"curve_60", "60 s", FieldWay::curve, 60},
    {"known_30", "30 s on a straight, the mounting of the antenna line is known",
     FieldWay::straight, 30, false, true},
    {"drawn_well", "two rows; mounting, tyres, lateness drawn as they are believed", FieldWay::rows,
     0, true},
    {"drawn_straight", "the same, no receiver for 30 s, on a straight", FieldWay::straight, 30,
     true},
    {"drawn_curve", "the same, on a curve", FieldWay::curve, 30, true},
};

double normal(std::mt19937_64& random) {
  double sum = -6;  // twelve uniform numbers, the same in every library
  for (int i = 0; i < 12; ++i) sum += static_cast<double>(random() >> 11) / 9007199254740992.0;
  return sum;
}

FieldPlan plan_of(const Drive& drive, const engine::EstimateConfig& believed, bool gst,
                  std::uint64_t seed) {
  FieldPlan plan;
  plan.gst = gst;
  if (drive.outage_s > 0) plan.outage_s = {kOut_s, kOut_s + drive.outage_s};
  if (!drive.drawn) return plan;
  std::mt19937_64 random(seed);
  plan.heading_off_deg = believed.heading_mount_sigma_deg * normal(random);
  plan.tyres = 1 + believed.wheel_scale_sigma * normal(random);
  plan.late_s = believed.gnss_late_sigma_s * std::abs(normal(random));  // never early
  return plan;
}

/// It is to drive on however little it knows: that is what is looked at.
engine::EngineConfig config_of(const Drive& drive) {
  engine::EngineConfig config = field_config();
  config.estimate.bound_run_m = 20;
  config.estimate.bound_yaw_deg = 90;
  config.navigate.corridor_m = 10;
  if (drive.calibrated) config.estimate.heading_mount_sigma_deg = 0;
  return config;
}

struct Driven {
  ErrorTable errors;
  double outside_s = 0;
  int reached = 0;
};

Driven drive_all(const Drive& drive, bool gst, std::uint64_t first, int seeds) {
  Driven all;
  const engine::EngineConfig config = config_of(drive);
  const Path path = field_way(drive.way, 2);
  for (int i = 0; i < seeds; ++i) {
    const std::uint64_t seed = first + static_cast<std::uint64_t>(i);
    FieldWorld world(config, plan_of(drive, config.estimate, gst, seed), seed);
    std::size_t instant = 0;
    const Judgement j =
        world.drive(path, 400, [&](const Snapshot& seen, const Pose& truth, double since_s) {
          if (since_s < static_cast<double>(instant) * kEach_s) return;
          all.errors.add(instant++, sample_of(seen, truth));
        });
    all.outside_s += j.outside_s;
    all.reached += j.success ? 1 : 0;
    if (!j.success)
      std::fprintf(stderr, "%s, seed %llu: %s\n", drive.name, static_cast<unsigned long long>(seed),
                   j.words.c_str());
  }
  return all;
}

void print_header(double n) {
  std::printf("upper 95 %% bound of the mean of %.0f drives: place %.2f, heading %.2f\n\n", n,
              chi_square_95(2 * n) / n, chi_square_95(n) / n);
  std::printf("%-15s %-4s %-7s| %5s %6s %5s %6s %6s %6s | %5s %6s %5s %6s %6s %6s | %7s\n", "", "",
              "", "place", "worst", "over", "sigma", "error", "3sig", "yaw", "worst", "over",
              "sigma", "error", "3sig", "outside");
  std::printf("%-15s %-4s %-7s| %5s %6s %5s %6s %6s %6s | %5s %6s %5s %6s %6s %6s | %7s\n", "drive",
              "gst", "when", "nees", "", "%", "mm", "mm", "%", "nees", "", "%", "deg", "deg", "%",
              "s");
}

void print_part(const Drive& drive, bool gst, const char* when, const Consistency& c,
                double outside_s) {
  if (c.instants == 0) return;
  std::printf("%-15s %-4s %-7s| %5.2f %6.2f %5.1f %6.1f %6.1f %6.2f | %5.2f %6.2f %5.1f %6.2f ",
              drive.name, gst ? "yes" : "no", when, c.place2, c.worst_place2, 100 * c.place_over,
              1e3 * c.place_sigma_m, 1e3 * c.place_m, 100 * c.place_inside, c.yaw2, c.worst_yaw2,
              100 * c.yaw_over, to_deg(c.yaw_sigma_rad));
  std::printf("%6.2f %6.2f | %7.2f\n", to_deg(c.yaw_rad), 100 * c.yaw_inside, outside_s);
}

/// True when nothing moved beyond the published bound.
bool run_drive(const Drive& drive, bool gst, std::uint64_t first, int seeds) {
  const Driven all = drive_all(drive, gst, first, seeds);
  const auto n = static_cast<std::size_t>(seeds);
  const std::size_t end = static_cast<std::size_t>(-1);
  const auto out = static_cast<std::size_t>(kOut_s / kEach_s);
  const auto back = out + static_cast<std::size_t>(drive.outage_s / kEach_s);
  if (drive.outage_s > 0) {
    print_part(drive, gst, "before", all.errors.weigh(0, out, n), 0);
    print_part(drive, gst, "outage", all.errors.weigh(out, back, n), 0);
    print_part(drive, gst, "its end", all.errors.weigh(back - 1, back, n), 0);
    print_part(drive, gst, "after", all.errors.weigh(back, end, n), 0);
  }
  print_part(drive, gst, "all", all.errors.weigh(0, end, n), all.outside_s);
  if (all.reached < seeds) std::printf("%20s reached by %d of %d\n", "", all.reached, seeds);
  std::fflush(stdout);
  std::fprintf(stderr, "%s %s\n", drive.name, gst ? "with GST" : "without GST");
  return all.outside_s == 0;
}

constexpr const char* kUsage = R"(usage: bench_nees [--seeds N] [--first SEED] [DRIVE...]

Normalised estimation error squared (NEES) of what is published, over N independent drives (50) from
SEED (1) on, each half second: the square of the true error over the published sigma. A place has
two degrees of freedom, and what is published of it is one sigma of its larger axis: its mean is to
be below 2, a heading's below 1. Printed are the mean over drives and instants, the worst instant
(mean over drives), the share of instants whose mean is beyond the upper 95 % bound of a chi-square;
for sharpness the mean published sigma and the mean true error; and the share of samples inside
three published sigma (99.7 % is wanted). Last come the seconds of motion beyond the published
bound. An outage begins after 20 s, and it drives on however little it knows.
Without DRIVE: all, each with and without GST. --list names them.

Exit status: 0; 1 a drive moved beyond the published bound; 2 wrong usage.
)";

int run(int argc, char** argv) {
  std::uint64_t first = 1;
  int seeds = 50;
  std::vector<std::string> names;
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    if (word == "--seeds" && i + 1 < argc) {
      seeds = std::max(std::atoi(argv[++i]), 1);
    } else if (word == "--first" && i + 1 < argc) {
      first = std::strtoull(argv[++i], nullptr, 10);
    } else if (word == "--list") {
      for (const Drive& drive : kDrives) std::printf("%-15s %s\n", drive.name, drive.what);
      return 0;
    } else if (word.starts_with("-")) {
      std::fputs(kUsage, word == "--help" ? stdout : stderr);
      return word == "--help" ? 0 : 2;
    } else {
      names.push_back(word);
    }
  }
  for (const std::string& name : names) {
    const auto known = [&](const Drive& drive) { return drive.name == name; };
    if (std::none_of(std::begin(kDrives), std::end(kDrives), known)) {
      std::fprintf(stderr, "there is no drive %s: --list names them\n", name.c_str());
      return 2;
    }
  }
  print_header(seeds);
  bool inside = true;
  for (const Drive& drive : kDrives) {
    if (!names.empty() && std::find(names.begin(), names.end(), drive.name) == names.end())
      continue;
    for (const bool gst : {false, true}) inside = run_drive(drive, gst, first, seeds) && inside;
  }
  return inside ? 0 : 1;
}

}  // namespace
}  // namespace drover::bench

int main(int argc, char** argv) {
  return drover::bench::run(argc, argv);
}
