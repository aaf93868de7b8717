#include "cli/estimate.h"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <iostream>
#include <memory>
#include <optional>
#include <vector>

#include "cli/estimate_run.h"
#include "cli/exit_codes.h"
#include "cli/failure.h"
#include "cli/mapped_file.h"
#include "cli/number_checks.h"
#include "cli/pose_file.h"
#include "cli/pose_table.h"
#include "config/load.h"
#include "gateway/recording/replay.h"

namespace drover::cli {

namespace {

struct EstimateSettings {
  std::string in;
  std::string recording;
  std::string out;
  std::string config;
  double rate_Hz = 10;
  std::vector<double> origin;  ///< latitude, longitude, altitude
};

int fail(const std::string& text) {
  tell_failure(false, "drover", text);
  return kRefused;
}

/// Nothing, and it is told why.
std::optional<config::DroverConfig> read_config(const std::string& path) {
  const auto loaded = config::load_file(path);
  for (const auto& problem : loaded.problems) std::cerr << problem.text(path) << '\n';
  if (!loaded.problems.empty()) return std::nullopt;
  return loaded.config;
}

PoseRow row_of(const Snapshot& snapshot) {
  PoseRow row;
  row.pose = snapshot.pose;
  row.error_bound_m = snapshot.nav.error_bound_m;
  row.latitude_deg = snapshot.gnss.pose_latitude_deg;
  row.longitude_deg = snapshot.gnss.pose_longitude_deg;
  if (snapshot.gnss.position_time != kNever) row.quality = snapshot.gnss.position.quality;
  if (!snapshot.why.empty()) row.reason = snapshot.why[0].view();
  return row;
}

int from_recording(const EstimateSettings& settings, const config::DroverConfig* config) {
  const MappedFile file(settings.recording);
  if (!file.problem().empty()) return fail(settings.recording + ": " + file.problem());
  PoseFile out(settings.out, settings.recording);
  if (!out.problem().empty()) return fail(out.problem());
  out.stream() << pose_head();
  std::uint64_t poses = 0;
  Time begin = kNever;
  RowTimes rows(settings.rate_Hz);
  const auto played = gateway::play(file.bytes(), config, [&](const Snapshot& snapshot) {
    if (begin == kNever) rows.begin(begin = snapshot.time);
    if (!rows.is_due(snapshot.time)) return;
    out.stream() << pose_line(to_s(snapshot.time - begin), row_of(snapshot));
    ++poses;
  });
  if (played.verdict == gateway::Replayed::Verdict::unusable)
    return fail(settings.recording + ": " + played.note);
  if (const auto trouble = out.finish(); !trouble.empty()) return fail(trouble);
  std::fprintf(
      stderr, "cycles %llu, poses %llu%s%s\n", static_cast<unsigned long long>(played.cycles),
      static_cast<unsigned long long>(poses), played.note.empty() ? "" : "; ", played.note.c_str());
  return kDone;
}

int from_log(const EstimateSettings& settings, const config::DroverConfig& config) {
  std::ifstream file;
  const bool piped = settings.in == "-";
  if (!piped) file.open(settings.in);
  if (!piped && !file) return fail(settings.in + ": cannot be read: " + std::strerror(errno));
  PoseFile out(settings.out, piped ? "/dev/stdin" : settings.in);
  if (!out.problem().empty()) return fail(out.problem());
  EstimateRun run{config.engine, settings.rate_Hz, std::nullopt};
  if (!settings.origin.empty())
    run.origin = GeodeticPoint{settings.origin[0], settings.origin[1],
                               settings.origin.size() > 2 ? settings.origin[2] : 0.0};
  const auto outcome = estimate(piped ? std::cin : file, run, out.stream());
  if (!outcome.problem.empty()) return fail(settings.in + ": " + outcome.problem);
  if (const auto trouble = out.finish(); !trouble.empty()) return fail(trouble);
  std::fprintf(stderr, "rows %llu, poses %llu\n", static_cast<unsigned long long>(outcome.rows),
               static_cast<unsigned long long>(outcome.poses));
  return kDone;
}

int run(const EstimateSettings& settings) {
  std::optional<config::DroverConfig> config;
  if (!settings.config.empty()) {
    config = read_config(settings.config);
    if (!config) return kRefused;
  }
  return settings.recording.empty() ? from_log(settings, *config)
                                    : from_recording(settings, config ? &*config : nullptr);
}

}  // namespace

void add_estimate_command(CLI::App& app, int& code) {
  auto* command = app.add_subcommand(
      "estimate", "what the robot's estimator makes of a log, or of a recording: poses as a table");
  const auto settings = std::make_shared<EstimateSettings>();
  auto* config = command->add_option("--config", settings->config, "the robot's drover.json");
  auto* in =
      command->add_option("--in", settings->in, "measurements as a table (CSV), - for stdin");
  auto* recording =
      command->add_option("--recording", settings->recording, "written by droverd --record");
  in->needs(config)->excludes(recording);
  command->add_option("--out", settings->out, "file; else standard output");
  command->add_option("--rate", settings->rate_Hz, "poses in a second")
      ->capture_default_str()
      ->check(plain_number(0.01, 200));
  command
      ->add_option("--origin", settings->origin,
                   "of x and y: latitude longitude [altitude], degrees, m; else the first position")
      ->expected(2, 3)
      ->excludes(recording);
  command->footer(
      "The columns of a log, of which only time_s has to be there: time_s, received_s,\n"
      "left_rim_mps and right_rim_mps or vx_mps and wz_radps, gyro_x_radps (y, z),\n"
      "accel_x_mps2 (y, z), latitude_deg, longitude_deg, altitude_m, quality, sigma_east_m,\n"
      "sigma_north_m, correction_age_s, heading_deg. An empty cell: not of this row's time.\n"
      "Examples:\n"
      "  drover estimate --config drover.json --in log.csv --out pose.csv\n"
      "  drover estimate --recording run.rec --out pose.csv\n"
      "  drover estimate --recording run.rec --config other.json --rate 50 --out pose.csv");
  command->callback([settings, &code] {
    if (settings->in.empty() && settings->recording.empty())
      throw CLI::RequiredError("--in or --recording");
    if (settings->recording.empty() && settings->config.empty())
      throw CLI::RequiredError("--config");
    code = run(*settings);
  });
}

}  // namespace drover::cli
