// How often a mission ends without a person, in the field of field_world.h with a mixture of what
// ordinarily goes wrong. For people: `bench_availability --help`.
#include <cstdio>
#include <cstdlib>
#include <map>
#include <string>
#include <vector>

#include "bench/field_mission.h"
#include "bench/field_stops.h"
#include "bench/field_world.h"

namespace drover::bench {
namespace {

constexpr std::size_t kShown = 10;

struct Driven {
  std::uint64_t seed = 0;
  Judgement end;
  std::vector<Stop> stops;
  std::vector<Beyond> beyond;
  double needless_s = 0;

  /// Seconds beyond the bound while wheels slipped without a fix that would have shown it.
  double unseen_s = 0;

  int needless() const {
    return static_cast<int>(std::count_if(stops.begin(), stops.end(), [](const Stop& stop) {
      return stop.kind == Stop::Kind::needless && !stop.is_end;
    }));
  }
};

Driven drive_mission(std::uint64_t seed) {
  const FieldMission mission = draw_mission(seed);
  const engine::EngineConfig config = field_config();
  StopWatch stops(config.estimate, mission.plan);
  FieldWorld world(config, mission.plan, seed);
  Driven driven;
  driven.seed = seed;
  driven.end = world.drive(field_rows(mission.rows, mission.leg_m), 1500,
                           [&](const Snapshot& seen, const Pose& truth, double s) {
                             if (s >= 0) stops.look(seen, truth, s);
                           });
  driven.stops = stops.stops();
  driven.beyond = stops.beyond();
  driven.unseen_s = stops.unseen_s();
  driven.needless_s = stops.needless_s();
  return driven;
}

/// What was said without its numbers, to count it.
std::string without_numbers(const std::string& text) {
  std::string words;
  for (const char c : text.substr(0, text.find(';'))) {
    const bool digit = c >= '0' && c <= '9';
    const bool in_number = !words.empty() && words.back() == '#';
    if (digit || (in_number && c == '.')) {
      if (!in_number) words += '#';
    } else {
      words += c;
    }
  }
  return words;
}

const char* word(Stop::Kind kind) {
  switch (kind) {
    case Stop::Kind::needless: return "needless";
    case Stop::Kind::careful: return "careful";
    case Stop::Kind::right: break;
  }
  return "right";
}

struct Count {
  int of[3] = {};
  double for_s = 0;
  void add(const Stop& stop) {
    ++of[static_cast<int>(stop.kind)];
    for_s += stop.for_s;
  }
};

void print_counts(const char* what, const std::map<std::string, Count>& counts) {
  std::printf("\n%8s %8s %8s %8s  %s\n", "needless", "careful", "right", "s", what);
  for (const auto& [why, count] : counts) {
    std::printf("%8d %8d %8d %8.1f  %s\n", count.of[0], count.of[1], count.of[2], count.for_s,
                why.c_str());
  }
}

void print_sums(const std::vector<Driven>& all) {
  int successes = 0, pauses = 0, needless = 0, hindered = 0, wide = 0, beyond = 0;
  double paused_s = 0, needless_s = 0, wide_s = 0, moving_s = 0, time_s = 0, outside_s = 0,
         unseen_s = 0, corridor_s = 0;
  std::map<std::string, Count> paused, ended;
  for (const Driven& d : all) {
    successes += d.end.success ? 1 : 0;
    pauses += d.end.pauses;
    needless += d.needless();
    hindered += d.needless() > 0 ? 1 : 0;
    wide += d.end.wide_s > 0 ? 1 : 0;
    paused_s += d.end.paused_s;
    needless_s += d.needless_s;
    wide_s += d.end.wide_s;
    moving_s += d.end.moving_s;
    time_s += d.end.time_s;
    outside_s += d.end.outside_s;
    corridor_s += d.end.beyond_s;
    unseen_s += d.unseen_s;
    beyond += d.end.outside_s > 0 ? 1 : 0;
    for (const Stop& stop : d.stops) {
      if (stop.is_end) {
        ended[without_numbers(d.end.words)].add(stop);
      } else {
        paused[without_numbers(stop.why)].add(stop);
      }
    }
  }
  const double n = static_cast<double>(all.size());
  std::printf("ended without a person   %d of %zu (%.1f %%)\n", successes, all.size(),
              100 * successes / n);
  std::printf("needless stops           %d of %d, in %d missions\n", needless, pauses, hindered);
  std::printf(
      "paused                   %.1f s a mission (%.1f %% of its time), %.1f s needlessly\n",
      paused_s / n, 100 * paused_s / time_s, needless_s / n);
  std::printf("beside the track         %.1f s beyond %.0f cm (%.2f %% of the motion), in %d\n",
              wide_s, 100 * kWide_m, 100 * wide_s / moving_s, wide);
  std::printf("beyond the bound         %.2f s, in %d; %.2f s of it after a slip without a fix\n",
              outside_s, beyond, unseen_s);
  std::printf("beyond the corridor      %.2f s\n", corridor_s);
  print_counts("paused, first reason", paused);
  print_counts("failed", ended);
}

bool is_worse(const Driven& a, const Driven& b) {
  if (a.end.outside_s != b.end.outside_s) return a.end.outside_s > b.end.outside_s;
  if (a.end.success != b.end.success) return b.end.success;
  if (a.needless_s != b.needless_s) return a.needless_s > b.needless_s;
  return a.end.paused_s > b.end.paused_s;
}

void print_each(const Driven& d, bool all_said) {
  const Judgement& j = d.end;
  std::printf("\nseed %llu: %s, %s; %.1f s, %d pauses of %.1f s, %.1f s needlessly\n",
              static_cast<unsigned long long>(d.seed), j.success ? "success" : "NO SUCCESS",
              j.words.c_str(), j.time_s, j.pauses, j.paused_s, d.needless_s);
  std::printf(
      "  rms %.0f mm, max %.0f mm, %.1f s beyond 10 cm, %.2f s beyond the corridor, %.2f s beyond "
      "the bound (%.3f m)\n",
      1e3 * j.rms_m, 1e3 * j.max_m, j.wide_s, j.beyond_s, j.outside_s, j.worst_outside_m);
  const std::string plan = in_words(draw_mission(d.seed));
  for (std::size_t at = 0; at < plan.size(); at = plan.find('\n', at) + 1) {
    const std::string text = plan.substr(at, plan.find('\n', at) - at);
    std::printf("    %s\n", text.c_str());
  }
  for (const Stop& stop : d.stops) {
    std::printf(
        "  %s %.1f s, for %.1f s, %s: %s (truly off %.3f m, %.1f degrees; published %.3f m, %.1f "
        "degrees)\n",
        stop.is_end ? "ended" : "paused", stop.at_s, stop.for_s, word(stop.kind), stop.why.c_str(),
        stop.error_m, to_deg(stop.error_rad), stop.doubt_m, to_deg(stop.doubt_rad));
  }
  for (const Beyond& b : d.beyond) {
    std::printf("  BEYOND THE BOUND from %.2f to %.2f s: truly off %.3f m, published %.3f m\n",
                b.from_s, b.to_s, b.error_m, b.bound_m);
  }
  constexpr std::size_t kLast = 8;
  const std::size_t first = all_said || j.said.size() < kLast ? 0 : j.said.size() - kLast;
  for (std::size_t i = first; i < j.said.size(); ++i) std::printf("      %s\n", j.said[i].c_str());
}

constexpr const char* kUsage = R"(usage: bench_availability [--seeds N] [--first SEED] [--each]

Drives the whole engine over N missions (200) of 200 m, drawn from the seeds SEED (1) on: rows with
U-turns at 0.5 m/s, and a mixture of what ordinarily goes wrong. Fixes come and go as a Markov chain
(a float of 0.3 to 10 s, an outage of 2 to 30 s, 70 s of fix between them in the mean); up to four
slips of 10 to 35 % for 1 to 10 s and two side slopes of 1 to 5 degrees; in one of five a wrong
integer solution of 5 to 40 cm for 2 to 20 s, in one of five a shove of 10 to 40 cm; the antenna
line up to 2 degrees off, stamps up to 60 ms late, tyres up to 2 % off, GST in one of two.

Prints how many ended without a person, and of the pauses which were
  needless  when they began the true error was inside estimate.bound_run_m and bound_yaw_deg, and so
            was what was published: two sigma, and what lies between sources that contradict
            each other;
  careful   the true error was inside, what was published was not;
  right     the true error was beyond.
Seconds that were paused needlessly are those in which both are inside. Then the seconds of motion
beyond 10 cm beside the track and beyond the published bound (of the truth), and in how many of
these wheels slipped, or had slipped since a fix that had settled, which no source shows; why it
paused and failed, and the ten worst: beyond the bound, failed, paused needlessly, paused, in this
order.
--each tells each mission, with all that was said.

Exit status: 0; 1 a mission moved beyond the published bound; 2 wrong usage.
)";

int run(int argc, char** argv) {
  std::uint64_t first = 1;
  int seeds = 200;
  bool each = false;
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    if (word == "--seeds" && i + 1 < argc) {
      seeds = std::atoi(argv[++i]);
    } else if (word == "--first" && i + 1 < argc) {
      first = std::strtoull(argv[++i], nullptr, 10);
    } else if (word == "--each") {
      each = true;
    } else {
      std::fputs(kUsage, word == "--help" ? stdout : stderr);
      return word == "--help" ? 0 : 2;
    }
  }
  if (seeds < 1) {
    std::fputs(kUsage, stderr);
    return 2;
  }
  std::vector<Driven> all;
  bool inside = true;
  for (int i = 0; i < seeds; ++i) {
    all.push_back(drive_mission(first + static_cast<std::uint64_t>(i)));
    const Driven& d = all.back();
    inside = inside && d.end.outside_s == 0;
    std::fprintf(stderr, "%d of %d, seed %llu: %s\n", i + 1, seeds,
                 static_cast<unsigned long long>(d.seed), d.end.words.c_str());
    if (each) print_each(d, true);
  }
  if (each) std::printf("\n");
  print_sums(all);
  std::stable_sort(all.begin(), all.end(), is_worse);
  if (all.size() > kShown) all.resize(kShown);
  if (!each) {
    for (const Driven& d : all) print_each(d, false);
  }
  return inside ? 0 : 1;
}

}  // namespace
}  // namespace drover::bench

int main(int argc, char** argv) {
  return drover::bench::run(argc, argv);
}
