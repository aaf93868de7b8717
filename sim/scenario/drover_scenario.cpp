// drover-scenario: plays a scenario with the real programs and says how the drive went.
#include <unistd.h>
#include <CLI/CLI.hpp>

#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <fstream>

#include "sim/scenario/player.h"
#include "sim/scenario/summary.h"

namespace {

using drover::sim::Outcome;

constexpr const char* kFooter = R"(
Starts mosquitto, drover-sim, drover-guard and droverd, saves the mission's track, starts it, does
what the scenario's steps say, and ends with a summary. Logs: can.log, truth.csv, mqtt.log,
events.log, summary.json, scenario.json, drover.json, NAME.log of each program, and droverd.rec,
all that droverd heard and said (drover replay).

Exit status: 0 the mission ended as the scenario expects, 1 it ended otherwise, 2 it cannot start,
3 a program broke, 4 the scenario's time-out, 130 interrupted.

Examples:
  sim/lab -- build/demo/sim/scenario/drover-scenario sim/scenarios/figure8.json
  drover-scenario --native --view lines sim/scenarios/estop.json
  drover-scenario --native --set mission.speed_mps=0.3 --log-dir /tmp/logs sim/scenarios/demo.json
)";

struct Options {
  drover::sim::WorkplaceSettings place;
  std::string view = "auto";
  bool keep = false;
};

drover::sim::ViewKind view_kind(const std::string& text) {
  using drover::sim::ViewKind;
  if (text == "none") return ViewKind::none;
  if (text == "lines") return ViewKind::lines;
  return text == "terminal" || ::isatty(STDOUT_FILENO) != 0 ? ViewKind::terminal : ViewKind::lines;
}

void summarize(const drover::sim::Workplace& place, const drover::sim::Mission& mission,
               const drover::sim::Player& player, Outcome outcome) {
  const auto& result = player.result();
  drover::sim::DriveFigures figures;
  std::ifstream truth(place.log_folder() + "/truth.csv");
  if (truth && result.begin != drover::kNever) {
    const double end_s = result.end == drover::kNever ? 1e18 : drover::to_s(result.end);
    figures = drover::sim::measure_drive(drover::sim::read_truth(truth), mission.track,
                                         result.target_id - 1, drover::to_s(result.begin), end_s);
  }
  std::ifstream objects(place.log_folder() + "/objects.log");
  const auto touched = drover::sim::read_touches(objects);
  const std::string status = result.status.empty() ? "no result" : result.status;
  nlohmann::ordered_json document{{"name", mission.name},
                                  {"status", status},
                                  {"expected", mission.expect_status},
                                  {"exit_status", static_cast<int>(outcome)},
                                  {"distance_m", figures.distance_m},
                                  {"time_s", figures.time_s},
                                  {"cross_track_rms_m", figures.cross_track_rms_m},
                                  {"cross_track_max_m", figures.cross_track_max_m},
                                  {"goal_distance_m", figures.goal_distance_m}};
  auto& waits = document["waited"] = nlohmann::ordered_json::array();
  for (const auto& wait : player.waits())
    if (wait.end != drover::kNever)
      waits.push_back({{"time_s", drover::to_s(wait.end - wait.begin)}, {"why", wait.why}});
  if (touched) document["touched"] = *touched;
  std::ofstream(place.log_folder() + "/summary.json") << document.dump(1) << "\n";
  std::printf("\n%s\n", mission.name.c_str());
  std::printf("  driven        %8.2f m in %.1f s\n", figures.distance_m, figures.time_s);
  std::printf("  cross-track   %8.1f mm RMS, %.1f mm at most\n", figures.cross_track_rms_m * 1e3,
              figures.cross_track_max_m * 1e3);
  std::printf("  from the goal %8.1f mm\n", figures.goal_distance_m * 1e3);
  for (const auto& wait : waits)
    std::printf("  waited        %8.1f s: %s\n", wait.at("time_s").get<double>(),
                wait.at("why").get<std::string>().c_str());
  if (touched) {
    std::string names;
    for (const auto& name : *touched) names += (names.empty() ? "" : ", ") + name;
    std::printf("  touched        %s\n", names.empty() ? "nothing" : names.c_str());
  }
  if (outcome == Outcome::broken) std::printf("  broken: %s\n", player.broken().c_str());
  if (outcome == Outcome::timed_out) std::printf("  the scenario's time is over\n");
  std::printf("%s\n", status.c_str());
  std::fflush(stdout);
}

/// What a person can do while all goes on running.
void tell_ways_in(const drover::sim::Workplace& place) {
  std::printf("\nEverything goes on running; Ctrl-C ends it.\n");
  int port = place.port();
  // The lab leaves the port of the machine outside here.
  std::ifstream outside(place.log_folder() + "/host-port");
  const bool lab = static_cast<bool>(outside >> port);
  std::printf("  mosquitto_sub -h 127.0.0.1 -p %d -t base_status\n", port);
  if (lab) {
    std::printf("  sim/lab enter        a shell beside the programs\n");
  } else {
    const auto sim_folder = std::filesystem::path(place.sim_socket()).parent_path().string();
    std::printf("  DROVER_SOCKET=%s %s status\n", place.daemon_socket().c_str(),
                place.program("drover").command[0].c_str());
    std::printf("  %s ctl --run-dir %s truth\n", place.program("drover-sim").command[0].c_str(),
                sim_folder.c_str());
  }
  if (place.document().contains("/gateway/ros2"_json_pointer)) {
    std::printf("  export ROS_LOCALHOST_ONLY=1 RMW_IMPLEMENTATION=rmw_cyclonedds_cpp\n");
    std::printf("  ros2 topic echo /odom        with other settings: src/ros2/README.md\n");
  }
  std::fflush(stdout);
}

int play(const Options& options) {
  // Else the first that is told is some interface or folder that is missing.
  if (!options.place.native && std::getenv("DROVER_LAB") == nullptr)
    std::fprintf(
        stderr,
        "drover-scenario: this is not the lab: CAN interfaces, gpio-sim and /run/drover-sim "
        "have to be there. sim/lab -- drover-scenario ... has them, --native needs none\n");
  const drover::sim::Workplace place(options.place);
  const auto mission = drover::sim::read_mission(place.document());
  const char* const plain = std::getenv("NO_COLOR");
  const bool coloured = plain == nullptr || *plain == '\0';
  drover::sim::View view(view_kind(options.view), coloured, mission, place.daemon_socket());
  drover::sim::Player player(place, mission, view);
  auto outcome = player.play();
  if (options.keep && outcome != Outcome::interrupted && outcome != Outcome::broken) {
    view.close();
    summarize(place, mission, player, outcome);
    tell_ways_in(place);
    player.keep_running();
    player.finish();
    return static_cast<int>(outcome);
  }
  const auto broken = player.broken();
  if (!player.finish() && outcome != Outcome::interrupted) outcome = Outcome::broken;
  // A stop that never came would prove nothing.
  if (outcome == Outcome::as_expected && !player.steps_left().empty()) outcome = Outcome::otherwise;
  view.close();
  summarize(place, mission, player, outcome);
  if (outcome != Outcome::interrupted)
    for (const auto& step : player.steps_left())
      std::fprintf(stderr, "drover-scenario: %s\n", step.c_str());
  if (!broken.empty()) std::fprintf(stderr, "drover-scenario: %s\n", broken.c_str());
  return static_cast<int>(outcome);
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  auto& place = options.place;
  std::error_code ignored;
  const auto self = std::filesystem::read_symlink("/proc/self/exe", ignored);
  place.program_folder = self.parent_path().parent_path().parent_path().string();

  CLI::App app("Plays a scenario with the real programs.", "drover-scenario");
  app.footer(kFooter);
  app.set_version_flag("--version", DROVER_VERSION);
  app.add_option("file", place.scenario_file, "the scenario (JSON)")->required();
  app.add_option("--seed", place.seed, "source of all randomness")
      ->envname("DROVER_SEED")
      ->capture_default_str();
  app.add_option("--log-dir", place.log_folder, "for the logs; none: they vanish at the end")
      ->envname("DROVER_LOGS");
  app.add_option("--bin-dir", place.program_folder, "a build folder, or one with the programs")
      ->capture_default_str();
  app.add_option("--view", options.view, "auto: a picture on a terminal, lines elsewhere")
      ->check(CLI::IsMember({"auto", "terminal", "lines", "none"}))
      ->capture_default_str();
  app.add_option("--set", place.changes, "change the scenario: mission.speed_mps=0.3");
  app.add_flag("--keep", options.keep, "after the mission, leave all running until Ctrl-C");
  app.add_flag("--native", place.native, "without CAN and GPIO of the kernel: sockets and files");
  app.add_flag("--own-ages", place.own_ages,
               "in real time, too, wait no longer than the robot does before a device is silent");
  CLI11_PARSE(app, argc, argv);
  try {
    return play(options);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "drover-scenario: %s\n", error.what());
    return 2;
  }
}
