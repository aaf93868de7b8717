// drover: the field engineer's command line. Talks to droverd over a Unix socket, broker or not.
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "cli/calibrate.h"
#include "cli/client.h"
#include "cli/devices.h"
#include "cli/estimate.h"
#include "cli/exit_codes.h"
#include "cli/failure.h"
#include "cli/learned.h"
#include "cli/option_texts.h"
#include "cli/replay.h"
#include "cli/reply.h"
#include "cli/report.h"
#include "cli/scene.h"
#include "cli/show.h"
#include "cli/stop.h"
#include "cli/tracks.h"
#include "cli/verbs.h"
#include "cli/zone.h"
#include "json/json_text.h"

namespace {

using drover::json::JsonText;
using drover::json::Node;

using drover::cli::read_reply;
using drover::cli::request;
using drover::cli::tell;

using drover::cli::kDone;
using drover::cli::kNoDaemon;
using drover::cli::kRefused;
using drover::cli::kUsage;

struct Settings {
  std::string socket = "/run/drover/drover.sock";
  std::string stop_socket;
  bool json = false;
  bool watch = false;
  bool on_slope = false;
};

/// Asks, prints the member `wanted` of the answer, or why it was refused.
int run(const Settings& settings, const std::string& question, std::string_view wanted = {},
        std::string (*show)(const Node&) = nullptr) {
  const auto answer = read_reply(drover::cli::ask(settings.socket, question));
  return drover::cli::tell_member(answer, settings.json, wanted, show);
}

std::string release_request(bool on_slope) {
  return JsonText()
      .open('{')
      .key("cmd")
      .text("release")
      .key("on_slope")
      .boolean(on_slope)
      .close('}')
      .take();
}

int status(const Settings& settings) {
  const auto question = request("status");
  if (!settings.watch) return run(settings, question, "status", drover::cli::show_status);
  const bool terminal = ::isatty(STDOUT_FILENO) != 0;
  bool answered = false;
  bool waits = false;
  for (;;) {
    try {
      const auto answer = read_reply(drover::cli::ask(settings.socket, question));
      answered = true;
      waits = false;
      if (terminal && !settings.json) std::fputs("\033[H\033[2J", stdout);
      const auto* status = answer.document.root.find("status");
      if (const int code = tell(answer, settings.json, [&](const Node& root) {
            return drover::cli::show_status(status == nullptr ? root : *status);
          }))
        return code;
    } catch (const drover::cli::NoAnswer& no) {
      // A restart is what somebody watches for. Whoever asks in vain at once asks the wrong place.
      if (!answered) throw;
      if (!waits) drover::cli::tell_failure(settings.json, "waiting", no.text);
      waits = true;
    }
    std::fflush(stdout);
    ::usleep(terminal ? 200'000 : 1'000'000);
  }
}

void print_version(const Settings& settings) {
  std::string running;
  std::string problem = "droverd's answer is not understood";
  try {
    const auto document =
        drover::json::parse(drover::cli::ask(settings.socket, request("version")));
    const auto* version = document ? document->root.find("version") : nullptr;
    if (version != nullptr && version->text() != nullptr) running = *version->text();
  } catch (const drover::cli::NoAnswer& no) {
    problem = no.text;
  }
  if (settings.json) {
    JsonText out;
    out.open('{').key("ok").boolean(true).key("drover").text(DROVER_VERSION);
    if (!running.empty()) out.key("droverd").text(running);
    std::printf("%s\n", out.close('}').str().c_str());
  } else {
    std::printf("drover %s\n", DROVER_VERSION);
    if (running.empty()) {
      std::printf("droverd: %s\n", problem.c_str());
    } else {
      std::printf("droverd %s\n", running.c_str());
    }
  }
}

/// A configuration that was refused is the most frequent reason for no droverd.
constexpr const char* kLookWhy =
    "; see why: journalctl -u droverd; droverd --check /etc/drover/drover.json";

void add_common_options(CLI::App& app, Settings& s) {
  app.set_version_flag("--version", DROVER_VERSION);
  app.require_subcommand(1);
  app.fallthrough();  // the options of all verbs may stand behind the verb, too
  app.add_option("--socket", s.socket, "droverd's socket")
      ->capture_default_str()
      ->envname("DROVER_SOCKET");
  app.add_option("--stop-socket", s.stop_socket, "drover-guard's (stop.sock beside droverd's)")
      ->envname("DROVER_STOP_SOCKET");
  app.footer(
      "Exit codes: 0 done, 1 refused (the reason is on stderr), 2 wrong usage, 3 no droverd.\n"
      "With --json a failure is {\"ok\":false,\"reason\":...} on standard output.\n"
      "Examples:\n"
      "  drover status --watch\n"
      "  drover status --json\n"
      "  drover gnss --watch\n"
      "  drover can --file candump.log --driver odrive --node 3\n"
      "  drover traj list\n"
      "  drover task start 'row 7' --id 57 --speed 0.5\n"
      "  drover task cancel");
}

void add_status_command(CLI::App& app, Settings& s, int& code) {
  auto* status_command = app.add_subcommand("status", "what the robot does, and why it does not");
  status_command->add_flag("--json", s.json, "one JSON object");
  status_command->add_flag("--watch", s.watch, "again and again");
  status_command->callback([&] { code = status(s); });
}

void add_place_commands(CLI::App& app, Settings& s, int& code) {
  auto* heading = app.add_subcommand("heading", "direction of the robot")->require_subcommand(1);
  auto* find = heading->add_subcommand(
      "find",
      "DRIVES a short way straight ahead, so that one antenna shows the heading. WATCH THAT IT "
      "GOES "
      "AHEAD: when it goes back, stop it, the wheels' signs are wrong, and the heading would be "
      "found the wrong way round");
  find->add_flag("--json", s.json, "one JSON object");
  find->callback([&] { code = run(s, request("heading_find")); });

  auto* position = app.add_subcommand("position", "place of the robot")->require_subcommand(1);
  auto* accept = position->add_subcommand(
      "accept", "believe the receiver: you see the robot stand where the map shows it");
  accept->add_flag("--json", s.json, "one JSON object");
  accept->callback([&] { code = run(s, request("position_accept")); });
}

void add_stop_commands(CLI::App& app, Settings& s, int& code) {
  auto* stop = app.add_subcommand("stop", "emergency stop: zero at once, until `drover reset`");
  stop->add_flag("--json", s.json, "one JSON object");
  stop->callback([&] { code = drover::cli::stop({s.socket, s.stop_socket, s.json}); });
  auto* reset = app.add_subcommand("reset", "clear a latched software stop; never starts motion");
  reset->add_flag("--json", s.json, "one JSON object");
  reset->callback([&] { code = drover::cli::reset({s.socket, s.stop_socket, s.json}); });
}

void add_release_commands(CLI::App& app, Settings& s, int& code) {
  auto* release = app.add_subcommand(
      "release",
      "let the drives of the base go, so that the robot can be pushed; until `drover hold`. An arm "
      "is held meanwhile, where its drives run, and follows nobody");
  release->add_flag("--on-slope", s.on_slope, "though it may roll: you hold it");
  release->add_flag("--json", s.json, "one JSON object");
  release->footer("Examples:\n  drover release\n  drover release --on-slope");
  release->callback([&] { code = run(s, release_request(s.on_slope)); });
  auto* hold =
      app.add_subcommand("hold", "take the drives into closed loop: it stands where it is");
  hold->add_flag("--json", s.json, "one JSON object");
  hold->footer("Examples:\n  drover hold");
  hold->callback([&] { code = run(s, request("hold")); });
}

void add_version_command(CLI::App& app, Settings& s) {
  auto* version = app.add_subcommand("version", "versions of drover and droverd");
  version->add_flag("--json", s.json, "one JSON object");
  version->callback([&] { print_version(s); });
}

/// `drover help stop` is what people type first.
std::vector<char*> words_of(int argc, char** argv) {
  std::vector<char*> words(argv, argv + argc);
  static char as_option[] = "--help";
  if (argc > 1 && std::string_view(argv[1]) == "help") {
    words.erase(words.begin() + 1);
    words.push_back(as_option);
  }
  return words;
}

/// Parses, which carries the verb out. Nothing: it was; else why not is told, and this is the exit
/// code.
std::optional<int> parse(CLI::App& app, std::vector<char*>& words) {
  // What cannot be parsed has set no option yet.
  const auto arguments = std::span<const char* const>(words).subspan(1);
  const bool json = std::count(arguments.begin(), arguments.end(), std::string_view("--json")) > 0;
  if (const auto wrong = drover::cli::unknown_verb(app, arguments); !wrong.empty()) {
    const auto option = drover::cli::unknown_option(app, arguments);
    drover::cli::tell_failure(json, "drover", option.empty() ? wrong : option);
    return kUsage;
  }
  try {
    app.parse(static_cast<int>(words.size()), words.data());
  } catch (const CLI::ParseError& error) {
    const auto option = drover::cli::unknown_option(app, arguments);
    if (error.get_exit_code() != 0 && !option.empty()) {
      drover::cli::tell_failure(json, "drover", option);
      return kUsage;
    }
    if (error.get_exit_code() == 0) return app.exit(error) == 0 ? kDone : kUsage;
    drover::cli::tell_failure(json, "drover",
                              drover::cli::incomplete(app, arguments, error.what()));
    return kUsage;
  } catch (const drover::cli::WrongUsage& wrong) {
    drover::cli::tell_failure(json, "drover", wrong.what());
    return kUsage;
  } catch (const drover::cli::NoAnswer& no) {
    drover::cli::tell_failure(json, "drover", no.text + (no.absent ? kLookWhy : ""));
    return kNoDaemon;
  }
  return std::nullopt;
}

}  // namespace

int main(int argc, char** argv) {
  auto words = words_of(argc, argv);
  Settings s;
  int code = kDone;
  CLI::App app{"drover: ask and command droverd"};
  add_common_options(app, s);
  // In the order in which --help shows them.
  add_status_command(app, s, code);
  drover::cli::add_device_commands(app, s.socket, code);
  drover::cli::add_replay_command(app, code);
  drover::cli::add_estimate_command(app, code);
  drover::cli::add_calibrate_command(app, s.socket, code);
  drover::cli::add_track_commands(app, s.socket, code);
  drover::cli::add_task_commands(app, s.socket, code);
  drover::cli::add_report_command(app, s.socket, code);
  drover::cli::add_scene_commands(app, s.socket, code);
  drover::cli::add_zone_commands(app, s.socket, code);
  add_place_commands(app, s, code);
  drover::cli::add_learned_commands(app, s.socket, code);
  add_stop_commands(app, s, code);
  add_release_commands(app, s, code);
  add_version_command(app, s);
  drover::cli::add_examples(app);
  if (const auto failed = parse(app, words)) return *failed;
  // A script that writes to a full disk must not take nothing for an answer.
  if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0) {
    std::fprintf(stderr, "drover: cannot write to standard output\n");
    return kRefused;
  }
  return code;
}
