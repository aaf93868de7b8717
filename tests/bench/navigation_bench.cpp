// How near to its track the robot is driven, and how fast, beside two common followers that steer
// the same robot through the same gate. For people: `tests/bench/navigation --help`.
#include <time.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "bench/pursuit.h"
#include "engine/navigate/tracker.h"
#include "support/track_drive.h"

namespace drover::bench {
namespace {

using test::Drive;
using test::DriveSetup;

constexpr double kCloseSpeed = 1e-9;

struct Way {
  const char* name;
  test::Points (*draw)();
  test::Points (*tune)();  ///< what the peers are tuned on: as long ways, shorter
};

test::Points two_rows() {
  test::Pen pen;
  pen.line(20).arc(1.5, kPi).line(20).arc(1.5, -kPi).line(5);
  return pen.points();
}

constexpr Way kWays[] = {
    {"rows", test::rows, test::rows},       {"figure8", test::figure_eight, test::figure_eight},
    {"square", test::square, test::square}, {"loop", test::loop, test::loop},
    {"field", test::field, two_rows},
};
constexpr double kSpeeds_mps[] = {0.2, 0.5, 0.8, 1.0, 2.0};

/// A robot's limits; a faster one has a stronger gate and leans on its tyres more.
DriveSetup setup_at(double speed_mps, unsigned seed) {
  DriveSetup setup;
  setup.speed_mps = speed_mps;
  setup.plant.seed = seed;
  setup.limits.max_speed_mps = 1.0;
  if (speed_mps > 1) {
    setup.limits.max_speed_mps = 2.0;
    setup.limits.max_yaw_rate_radps = 1.5;
    setup.limits.acceleration_mps2 = 1.0;
    setup.limits.deceleration_mps2 = 1.5;
    setup.limits.jerk_mps3 = 4.0;
    setup.limits.yaw_acceleration_radps2 = 4.0;
    setup.navigate.lateral_acceleration_mps2 = 1.0;
    setup.max_rim_mps = 3.0;
  }
  return setup;
}

enum class Who { drover, pure_pursuit, regulated };
constexpr Who kAll[] = {Who::drover, Who::pure_pursuit, Who::regulated};
const char* name_of(Who who) {
  switch (who) {
    case Who::drover: return "drover";
    case Who::pure_pursuit: return "pure pursuit";
    case Who::regulated: return "regulated";
  }
  return "";
}

std::uint32_t last(const Path& path) {
  return static_cast<std::uint32_t>(path.points.size() - 1);
}

Drive drive_once(Who who, const PursuitConfig& tuned, const Path& path, const DriveSetup& setup) {
  test::Plant2d plant({}, setup.plant, 0, 0, 0);
  if (who != Who::drover) {
    Pursuit pursuit(tuned, setup.limits, setup.navigate.braking_fraction, path, setup.speed_mps);
    return test::drive(path, last(path), setup, plant,
                       [&](const Pose& pose, double) { return pursuit.steer(pose); });
  }
  engine::Tracker tracker(setup.navigate, setup.limits);
  tracker.begin(path, last(path), setup.speed_mps, plant.estimate());
  return test::drive(path, last(path), setup, plant, [&](const Pose& pose, double dt_s) {
    const engine::TrackProgress progress = tracker.locate(pose);
    return test::Steered{tracker.follow(pose, progress, setup.cap_mps, from_s(dt_s)),
                         progress.arrived};
  });
}

/// The least of the errors among those settings that are not slow: within 5 % of the fastest.
PursuitConfig tune(Who who, const Way& way, double speed_mps) {
  constexpr unsigned kFirstSeed = 1001;  // not a judged one
  constexpr unsigned kSeeds = 3;
  struct Tried {
    PursuitConfig config;
    double square_m2 = 0;
    double time_s = 0;
  };
  std::vector<Tried> all;
  for (const double lookahead_s : {0.5, 0.8, 1.1, 1.5}) {
    for (const double least_m : {0.3, 0.45, 0.6}) {
      for (const double slow_radius_m : {0.9, 1.8}) {
        if (who == Who::pure_pursuit && slow_radius_m > 0.9) continue;
        Tried tried;
        tried.config.lookahead_s = lookahead_s;
        tried.config.min_lookahead_m = least_m;
        tried.config.regulated = who == Who::regulated;
        tried.config.slow_radius_m = slow_radius_m;
        if (who == Who::regulated) tried.config.max_lookahead_m = std::max(0.9, speed_mps);
        for (unsigned seed = kFirstSeed; seed < kFirstSeed + kSeeds; ++seed) {
          const Path path = test::record(way.tune(), 0.5, 0.01, seed);
          const Drive d = drive_once(who, tried.config, path, setup_at(speed_mps, seed));
          tried.square_m2 += d.arrived ? d.rms_m * d.rms_m : INFINITY;
          tried.time_s += d.time_s;
        }
        all.push_back(tried);
      }
    }
  }
  double fastest_s = INFINITY;
  for (const Tried& t : all)
    if (std::isfinite(t.square_m2)) fastest_s = std::min(fastest_s, t.time_s);
  Tried best = all.front();
  best.square_m2 = INFINITY;
  for (const Tried& t : all)
    if (t.time_s <= 1.05 * fastest_s && t.square_m2 < best.square_m2) best = t;
  return best.config;
}

double cpu_ns() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return 1e9 * static_cast<double>(now.tv_sec) + static_cast<double>(now.tv_nsec);
}

/// Of one update, over poses of a drive: without plant, gate and judge.
double update_ns(Who who, const PursuitConfig& tuned, const Path& path, DriveSetup setup) {
  setup.keep_poses = true;
  std::vector<Pose> poses = drive_once(who, tuned, path, setup).poses;
  poses.resize(std::min<std::size_t>(poses.size(), 20000));
  double least_ns = INFINITY;
  double sum = 0;
  for (int round = 0; round < 5; ++round) {
    engine::Tracker tracker(setup.navigate, setup.limits);
    tracker.begin(path, last(path), setup.speed_mps, poses.front());
    Pursuit pursuit(tuned, setup.limits, setup.navigate.braking_fraction, path, setup.speed_mps);
    const double from_ns = cpu_ns();
    for (const Pose& pose : poses) {
      if (who == Who::drover) {
        const engine::TrackProgress progress = tracker.locate(pose);
        sum += tracker.follow(pose, progress, setup.cap_mps, from_s(0.005)).wz_radps;
      } else {
        sum += pursuit.steer(pose).twist.wz_radps;
      }
    }
    least_ns = std::min(least_ns, (cpu_ns() - from_ns) / static_cast<double>(poses.size()));
  }
  return std::isfinite(sum) ? least_ns : NAN;
}

/// Over all seeds.
struct Figures {
  int drives = 0;
  int arrived = 0;
  double rms_m = 0;
  double worst_rms_m = 0;
  double p95_m = 0;  ///< of the worst seed, as all that follow but the means
  double max_m = 0;
  double goal_m = 0;
  double goal_rad = 0;
  double mean_time_s = 0;
  double mean_rms_jerk_mps3 = 0;
  double max_jerk_mps3 = 0;
  double cpu_ns = 0;
};

Figures judge(Who who, const PursuitConfig& tuned, const Way& way, double speed_mps, unsigned first,
              unsigned seeds) {
  Figures f;
  double square_m2 = 0;
  const test::Points drawn = way.draw();
  const PathPoint& before = drawn[drawn.size() - 2];
  const double last_rad = std::atan2(drawn.back().y_m - before.y_m, drawn.back().x_m - before.x_m);
  for (unsigned seed = first; seed < first + seeds; ++seed) {
    const Path path = test::record(drawn, 0.5, 0.01, seed);
    const Drive d = drive_once(who, tuned, path, setup_at(speed_mps, seed));
    ++f.drives;
    f.arrived += d.arrived ? 1 : 0;
    square_m2 += d.rms_m * d.rms_m;
    f.worst_rms_m = std::max(f.worst_rms_m, d.rms_m);
    f.p95_m = std::max(f.p95_m, d.p95_m);
    f.max_m = std::max(f.max_m, d.max_m);
    f.goal_m = std::max(f.goal_m, d.final_m);
    f.goal_rad = std::max(f.goal_rad, std::abs(wrap_rad(d.end.yaw_rad - last_rad)));
    f.mean_time_s += d.time_s / seeds;
    f.mean_rms_jerk_mps3 += d.rms_jerk_mps3 / seeds;
    f.max_jerk_mps3 = std::max(f.max_jerk_mps3, d.max_jerk_mps3);
  }
  f.rms_m = std::sqrt(square_m2 / seeds);
  const Path path = test::record(way.draw(), 0.5, 0.01, first);
  f.cpu_ns = update_ns(who, tuned, path, setup_at(speed_mps, first));
  return f;
}

struct Goal {
  std::string what;
  double value = 0;
  double most = 0;
  bool met() const { return value <= most; }
};

/// The one that needs neither peers nor many seeds.
Goal all_arrive(const Figures& ours) {
  return {"drives that did not arrive", 1.0 * (ours.drives - ours.arrived), 0};
}

std::vector<Goal> goals_of(const std::string& way, double speed_mps, const Figures& ours,
                           const Figures& pure, const Figures& regulated) {
  const auto at = [&](double v) { return std::abs(speed_mps - v) < kCloseSpeed; };
  std::vector<Goal> goals{all_arrive(ours)};
  const bool judged = way == "rows" || way == "figure8" || way == "square";
  if (judged && (at(0.5) || at(1))) {
    goals.push_back(
        {"rms, of the best peer's", ours.rms_m / std::min(pure.rms_m, regulated.rms_m), 0.85});
    goals.push_back({"max, of regulated pure pursuit's", ours.max_m / regulated.max_m, 0.6});
    goals.push_back(
        {"time, of regulated pure pursuit's", ours.mean_time_s / regulated.mean_time_s, 1.05});
  }
  if (way == "rows" && (at(0.5) || at(1))) {
    goals.push_back({"rms of the worst seed, cm", 100 * ours.worst_rms_m, at(1) ? 1.5 : 1.3});
    goals.push_back({"p95 of the worst seed, cm", 100 * ours.p95_m, at(1) ? 3.0 : 2.5});
    goals.push_back({"max of all seeds, cm", 100 * ours.max_m, at(1) ? 5.0 : 4.0});
  }
  if (way == "square") goals.push_back({"corners by pivot: max, cm", 100 * ours.max_m, 3});
  goals.push_back({"at rest, from the target, cm", 100 * ours.goal_m, 5});
  goals.push_back({"at rest, beside its direction, degrees", ours.goal_rad * 180 / kPi, 2});
  return goals;
}

void print_text(const Way& way, double speed_mps, Who who, const Figures& f) {
  std::printf(
      "%-8s %4.1f  %-12s %3d/%-3d %5.2f %5.2f %6.2f %6.2f %6.1f %5.1f %8.1f %7.1f %8.0f %7.0f\n",
      way.name, speed_mps, name_of(who), f.arrived, f.drives, 100 * f.rms_m, 100 * f.worst_rms_m,
      100 * f.p95_m, 100 * f.max_m, 100 * f.goal_m, f.goal_rad * 180 / kPi, f.mean_time_s,
      f.mean_rms_jerk_mps3, f.max_jerk_mps3, f.cpu_ns);
}

void print_json(const Way& way, double speed_mps, Who who, const Figures& f) {
  std::printf(
      "{\"track\": \"%s\", \"speed_mps\": %g, \"who\": \"%s\", \"arrived\": %d, "
      "\"drives\": %d, \"rms_m\": %.5f, \"worst_rms_m\": %.5f, \"p95_m\": %.5f, "
      "\"max_m\": %.5f, \"goal_m\": %.5f, \"goal_deg\": %.3f, \"time_s\": %.2f, "
      "\"rms_jerk_mps3\": %.2f, \"max_jerk_mps3\": %.1f, \"cpu_ns\": %.0f}",
      way.name, speed_mps, name_of(who), f.arrived, f.drives, f.rms_m, f.worst_rms_m, f.p95_m,
      f.max_m, f.goal_m, f.goal_rad * 180 / kPi, f.mean_time_s, f.mean_rms_jerk_mps3,
      f.max_jerk_mps3, f.cpu_ns);
}

struct Asked {
  unsigned first = 1;
  unsigned seeds = 20;
  bool json = false;
  bool alone = false;
  std::vector<std::string> ways;
  std::vector<double> speeds_mps;
};

bool wanted(const Asked& asked, const Way& way, double speed_mps) {
  const auto& ways = asked.ways;
  const auto& speeds = asked.speeds_mps;
  const auto near = [&](double v) { return std::abs(v - speed_mps) < kCloseSpeed; };
  return (ways.empty() || std::find(ways.begin(), ways.end(), way.name) != ways.end()) &&
         (speeds.empty() || std::any_of(speeds.begin(), speeds.end(), near));
}

struct Judged {
  const Way* way;
  double speed_mps;
  std::vector<Goal> goals;
};

bool print_goals(const std::vector<Judged>& rows, bool json) {
  bool met = true;
  const char* between = "";
  for (const Judged& row : rows) {
    for (const Goal& goal : row.goals) {
      met = met && goal.met();
      if (json) {
        std::printf(
            "%s\n  {\"track\": \"%s\", \"speed_mps\": %g, \"what\": \"%s\", \"value\": %.3f, "
            "\"goal\": %g, \"met\": %s}",
            between, row.way->name, row.speed_mps, goal.what.c_str(), goal.value, goal.most,
            goal.met() ? "true" : "false");
        between = ",";
      } else {
        std::printf("%-8s %4.1f  %-40s %7.2f   < %-5g %s\n", row.way->name, row.speed_mps,
                    goal.what.c_str(), goal.value, goal.most, goal.met() ? "met" : "NOT MET");
      }
    }
  }
  return met;
}

bool run(const Asked& asked) {
  std::vector<Judged> rows;
  if (asked.json) {
    std::printf("{\"rows\": [");
  } else {
    std::printf("%-8s %4s  %-12s %7s %5s %5s %6s %6s %6s %5s %8s %7s %8s %7s\n", "track", "m/s",
                "who", "arrived", "rms", "worst", "p95", "max cm", "goal", "deg", "time s", "jerk",
                "max m/s3", "cpu ns");
  }
  const char* between = "";
  for (const Way& way : kWays) {
    for (const double speed_mps : kSpeeds_mps) {
      if (!wanted(asked, way, speed_mps)) continue;
      Figures figures[3];
      for (const Who who : kAll) {
        if (asked.alone && who != Who::drover) continue;
        const PursuitConfig tuned =
            who == Who::drover ? PursuitConfig{} : tune(who, way, speed_mps);
        Figures& f = figures[static_cast<int>(who)];
        f = judge(who, tuned, way, speed_mps, asked.first, asked.seeds);
        if (asked.json) {
          std::printf("%s\n  ", between);
          print_json(way, speed_mps, who, f);
          between = ",";
        } else {
          print_text(way, speed_mps, who, f);
        }
        std::fflush(stdout);
      }
      rows.push_back({&way, speed_mps,
                      asked.alone
                          ? std::vector<Goal>{all_arrive(figures[0])}
                          : goals_of(way.name, speed_mps, figures[0], figures[1], figures[2])});
    }
  }
  std::printf(asked.json ? "\n], \"goals\": [" : "\n");
  const bool met = print_goals(rows, asked.json);
  if (asked.json) std::printf("\n]}\n");
  return met;
}

constexpr const char* kUsage =
    R"(usage: bench_navigation [--seeds N] [--first SEED] [--alone] [--json] [TRACK|SPEED...]
tracks: rows figure8 square loop field; speeds: 0.2 0.5 0.8 1 2. tests/bench/navigation --help
says more.
)";

int main_of(int argc, char** argv) {
  Asked asked;
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    const auto known = [&](const Way& way) { return word == way.name; };
    char* end = nullptr;
    const double number = std::strtod(word.c_str(), &end);
    const auto near = [&](double v) { return std::abs(v - number) < kCloseSpeed; };
    if ((word == "--seeds" || word == "--first") && i + 1 < argc) {
      const int value = std::atoi(argv[++i]);
      if (value < 1) {
        std::fputs(kUsage, stderr);
        return 2;
      }
      (word == "--seeds" ? asked.seeds : asked.first) = static_cast<unsigned>(value);
    } else if (word == "--json") {
      asked.json = true;
    } else if (word == "--alone") {
      asked.alone = true;
    } else if (std::any_of(std::begin(kWays), std::end(kWays), known)) {
      asked.ways.push_back(word);
    } else if (*end == '\0' && std::any_of(std::begin(kSpeeds_mps), std::end(kSpeeds_mps), near)) {
      asked.speeds_mps.push_back(number);
    } else {
      std::fputs(kUsage, word == "--help" ? stdout : stderr);
      return word == "--help" ? 0 : 2;
    }
  }
  return run(asked) ? 0 : 1;
}

}  // namespace
}  // namespace drover::bench

int main(int argc, char** argv) {
  return drover::bench::main_of(argc, argv);
}
