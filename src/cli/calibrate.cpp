#include "cli/calibrate.h"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <iostream>
#include <memory>
#include <optional>

#include "cli/calibrate_by_hand.h"
#include "cli/calibrate_drive.h"
#include "cli/exit_codes.h"
#include "cli/failure.h"
#include "cli/mapped_file.h"
#include "cli/number_checks.h"
#include "cli/show_calibration.h"
#include "config/load.h"
#include "gateway/recording/replay.h"

namespace drover::cli {

namespace {

struct CalibrateSettings {
  std::string in;
  std::string recording;
  std::string config;
  double from_s = 0;
  double to_s = 1e12;
  bool json = false;
};

int refuse(const CalibrateSettings& settings, const std::string& text) {
  tell_failure(settings.json, "drover", text);
  return kRefused;
}

int judge(const CalibrateSettings& settings, calibrate::Drive& drive,
          const config::Loaded& loaded) {
  if (const auto why = rollers_of(loaded.config.engine.base); !why.empty())
    return refuse(settings, why);
  cut(drive, settings.from_s, settings.to_s);
  const auto result = calibrate::calibrate(drive, configured_of(loaded.config.engine));
  if (!result.refused.empty()) return refuse(settings, result.refused);
  const auto keys = calibration_keys(loaded, !settings.recording.empty());
  const auto text =
      settings.json ? calibration_json(result, keys) + "\n" : show_calibration(result, keys);
  std::fputs(text.c_str(), stdout);
  return kDone;
}

int from_recording(const CalibrateSettings& settings, const std::optional<config::Loaded>& other) {
  const MappedFile file(settings.recording);
  if (!file.problem().empty()) return refuse(settings, settings.recording + ": " + file.problem());
  const auto recorded = gateway::recorded_configuration(file.bytes());
  if (!recorded.problem.empty())
    return refuse(settings, settings.recording + ": " + recorded.problem);
  const config::Loaded& loaded = other ? *other : recorded.loaded;
  DriveOfRecording taken(loaded.config.engine.base);
  const auto played = gateway::play(file.bytes(), other ? &other->config : nullptr,
                                    [&](const Snapshot& snapshot) { taken.take(snapshot); });
  if (played.verdict == gateway::Replayed::Verdict::unusable)
    return refuse(settings, settings.recording + ": " + played.note);
  return judge(settings, taken.drive, loaded);
}

int from_log(const CalibrateSettings& settings, const config::Loaded& loaded) {
  std::ifstream file;
  const bool piped = settings.in == "-";
  if (!piped) file.open(settings.in);
  if (!piped && !file)
    return refuse(settings, settings.in + ": cannot be read: " + std::strerror(errno));
  std::istream& in = piped ? std::cin : file;
  LogReader reader;
  DriveOfLog taken(loaded.config.engine.base);
  for (std::string line; std::getline(in, line);) {
    if (!reader.has_head()) {
      if (const auto wrong = reader.read_head(line))
        return refuse(settings, settings.in + ": " + wrong->text());
    } else if (const auto row = reader.read_row(line); !row.ok()) {
      return refuse(settings, settings.in + ": " + row.error().text());
    } else if (*row) {
      taken.take(**row);
    }
  }
  if (in.bad()) return refuse(settings, settings.in + ": cannot be read");
  return judge(settings, taken.drive, loaded);
}

int run_calibration(const CalibrateSettings& settings) {
  std::optional<config::Loaded> loaded;
  if (!settings.config.empty()) {
    loaded = config::load_file(settings.config);
    if (!loaded->problems.empty())
      return refuse(settings, loaded->problems.front().text(settings.config));
  }
  return settings.recording.empty() ? from_log(settings, *loaded)
                                    : from_recording(settings, loaded);
}

}  // namespace

void add_calibrate_command(CLI::App& app, const std::string& socket, int& code) {
  auto* command = app.add_subcommand("calibrate",
                                     "the robot's own numbers from a drive, each with its "
                                     "interval, as a patch to review");
  const auto settings = std::make_shared<CalibrateSettings>();
  auto* config = command->add_option("--config", settings->config, "the robot's drover.json");
  auto* recording =
      command->add_option("--recording", settings->recording, "written by droverd --record");
  command->add_option("--in", settings->in, "measurements as a table (CSV), - for stdin")
      ->needs(config)
      ->excludes(recording);
  command->add_option("--from", settings->from_s, "s after its begin: what is before is left out")
      ->check(plain_number(0));
  command->add_option("--to", settings->to_s, "s after its begin: what is after is left out")
      ->check(plain_number(0));
  command->add_flag("--json", settings->json, "one JSON object");
  command->footer(
      "The drive, on level ground with an RTK fix: stand for 6 s; straight on, 0.3 and 0.7 m/s in\n"
      "turn, three times; a left and a right circle; straight back; stand. Two minutes are "
      "enough.\n"
      "What it does not show is refused by name, with what to drive. Nothing is changed.\n"
      "Columns of a log: as of drover estimate, and receiver_mps, command_left_mps and\n"
      "command_right_mps or command_vx_mps and command_wz_radps.\n"
      "Examples:\n"
      "  drover calibrate drive           # THE ROBOT DRIVES while you hold a key\n"
      "  drover calibrate --recording run.rec\n"
      "  drover calibrate --recording run.rec --from 60 --to 200 --json | jq .patch\n"
      "  drover calibrate --config drover.json --in log.csv");
  add_calibrate_drive_command(*command, socket, code);
  command->callback([command, settings, &code] {
    if (command->got_subcommand("drive")) return;
    if (settings->in.empty() && settings->recording.empty())
      throw CLI::RequiredError("--in or --recording");
    if (settings->recording.empty() && settings->config.empty())
      throw CLI::RequiredError("--config");
    code = run_calibration(*settings);
  });
}

}  // namespace drover::cli
