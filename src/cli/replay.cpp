#include "cli/replay.h"

#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>

#include "cli/exit_codes.h"
#include "cli/mapped_file.h"
#include "cli/show_replay.h"

namespace drover::cli {

namespace {

using gateway::Replayed;

struct ReplaySettings {
  std::string file;
  bool json = false;
};

int play(const ReplaySettings& settings) {
  const MappedFile file(settings.file);
  auto it = file.problem().empty() ? gateway::replay(file.bytes()) : Replayed{};
  if (!file.problem().empty()) it.note = file.problem();
  if (settings.json) {
    std::printf("%s\n", replay_json(it).c_str());
  } else if (it.verdict == Replayed::Verdict::unusable) {
    std::fprintf(stderr, "drover: %s: %s\n", settings.file.c_str(), it.note.c_str());
  } else {
    std::fputs(show_replay(it).c_str(), stdout);
  }
  switch (it.verdict) {
    case Replayed::Verdict::equal: return kDone;
    case Replayed::Verdict::differs: return kRefused;
    case Replayed::Verdict::unusable: return kUsage;
  }
  return kUsage;
}

}  // namespace

void add_replay_command(CLI::App& app, int& code) {
  auto* command = app.add_subcommand(
      "replay", "play a recording of droverd again and say where this program differs");
  const auto settings = std::make_shared<ReplaySettings>();
  command->add_option("file", settings->file, "written by droverd --record")->required();
  command->add_flag("--json", settings->json, "one JSON object");
  command->footer(
      "Exit codes: 0 equal, 1 differs, 2 no usable recording.\n"
      "Examples:\n"
      "  drover replay run.rec\n"
      "  drover replay run.rec --json");
  command->callback([settings, &code] { code = play(*settings); });
}

}  // namespace drover::cli
