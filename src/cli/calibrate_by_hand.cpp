#include "cli/calibrate_by_hand.h"

#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <memory>
#include <thread>

#include "calibrate/calibrate.h"
#include "cli/ancestors.h"
#include "cli/calibration_drive.h"
#include "cli/client.h"
#include "cli/drive_values.h"
#include "cli/exit_codes.h"
#include "cli/failure.h"
#include "cli/key_terminal.h"
#include "cli/reply.h"
#include "cli/show_calibration.h"
#include "cli/terminal_between.h"
#include "config/load.h"
#include "json/json_text.h"
#include "runtime/clock.h"

namespace drover::cli {
namespace {

constexpr int kPatience_s = 1;
constexpr int kLook_ms = 10;
constexpr Duration kLookAtMost = std::chrono::milliseconds(5);  // each, however fast keys come
constexpr Duration kShowEach = std::chrono::milliseconds(100);

struct DriveSettings {
  std::string out;
  bool json = false;
};

using runtime::monotonic_now;

/// What a person follows: a line that changes, and one that stays for each piece.
class Screen final {
 public:
  explicit Screen(bool twist_base) : twist_base_(twist_base) {}

  void show(const CalibrationDrive& drive, const KeyTerminal& terminal, Time at) {
    if (drive.missing() != missing_) {
      missing_ = drive.missing();
      std::fputs("\nnot seen well enough yet:", stderr);
      for (const auto what : missing_) std::fprintf(stderr, " %s", name_of(what, twist_base_));
      std::fputs("\nanother round shows more; q ends with what there is", stderr);
    }
    if (shown_at_ != kNever && at - shown_at_ < kShowEach) return;
    shown_at_ = at;
    if (drive.recipe().at() != piece_) std::fputs("\n", stderr);
    piece_ = drive.recipe().at();
    std::fprintf(stderr, "\r%s", drive.line().c_str());
    if (terminal.is_silent())
      std::fputs(": your terminal does not tell how late your keys come: they count for nothing",
                 stderr);
    else if (terminal.answers() && terminal.is_late())
      std::fprintf(stderr, ": your keys come %.1f s late, and count for nothing",
                   terminal.delay_s());
    std::fputs("\033[K", stderr);
  }

 private:
  bool twist_base_;
  Time shown_at_ = kNever;
  std::size_t piece_ = 0;
  std::vector<calibrate::Quantity> missing_;
};

/// `key`: when it came; never: none is held.
std::string key_request(const Twist& twist, Time key) {
  json::JsonText out;
  out.open('{').key("cmd").text("drive_by_hand").key("vx_mps").number(twist.vx_mps);
  out.key("wz_radps").number(twist.wz_radps);
  if (key != kNever) out.key("at_ns").integer(key.time_since_epoch().count());
  return out.close('}').take();
}

/// That of the droverd that is asked, or why not.
config::Loaded configuration_of(Connection& daemon, std::string& problem) {
  const auto reply = read_reply(daemon.ask(request("configuration")));
  const auto* text = reply.document.root.find("configuration");
  const auto* map = reply.document.root.find("register_map");
  if (text == nullptr || text->text() == nullptr || map == nullptr || map->text() == nullptr) {
    problem = reply.done ? "droverd's answer is not understood" : reply.reason;
    return {};
  }
  auto loaded = config::load_text(*text->text(), "", *map->text());
  if (!loaded.problems.empty())
    problem = "droverd's configuration is not understood: is it of another version? " +
              loaded.problems.front().text("configuration");
  return loaded;
}

/// Until it has ended, or the person ends it. Throws NoAnswer.
void drive_on(Connection& daemon, KeyTerminal& terminal, CalibrationDrive& it, bool twist_base) {
  const auto ask_values = request("drive_values");
  Screen screen(twist_base);
  Time asked = kNever;
  while (!it.ended()) {
    const auto keys = terminal.read(kLook_ms);
    if (keys.quit) break;
    const Duration early = kLookAtMost - (monotonic_now() - asked);
    if (early > Duration::zero()) std::this_thread::sleep_for(early);
    asked = monotonic_now();
    const auto values = read_reply(daemon.ask(ask_values));
    const auto* told = values.document.root.find("values");
    if (told == nullptr) break;
    if (const auto say = it.look(monotonic_now(), keys.space, snapshot_of(*told))) {
      const auto answer = read_reply(daemon.ask(key_request(*say, keys.space)));
      it.answered(answer.done, answer.done ? answer.note : answer.reason);
    }
    screen.show(it, terminal, monotonic_now());
  }
  (void)daemon.ask(key_request({}, kNever));  // rest, at once
}

/// A daemon that does not answer ends it, too: what was measured until then is judged.
void drive(Connection& daemon, CalibrationDrive& it, bool twist_base) {
  KeyTerminal terminal;
  try {
    drive_on(daemon, terminal, it, twist_base);
  } catch (const NoAnswer& none) {
    std::fprintf(stderr, "\n%s: the drive ends here", none.text.c_str());
  }
  std::fputs("\n\n", stderr);
}

int tell_result(const DriveSettings& settings, const CalibrationDrive& it,
                const config::Loaded& loaded) {
  const auto refuse = [&](const std::string& text) {
    tell_failure(settings.json, "drover", text);
    return kRefused;
  };
  const auto keys = calibration_keys(loaded, true);
  if (!it.problem().empty()) {
    std::string text = it.problem();
    for (const auto& note : sign_notes(it.signs(), keys.twist_base)) text += "; " + note;
    return refuse(text);
  }
  const auto found = calibrate::calibrate(it.drive(), configured_of(loaded.config.engine));
  if (!found.refused.empty()) return refuse(found.refused);
  const auto text =
      settings.json ? calibration_json(found, keys) + "\n" : show_calibration(found, keys);
  std::fputs(text.c_str(), stdout);
  if (settings.out.empty()) return kDone;
  std::ofstream file(settings.out, std::ios::trunc);
  file << text;
  file.close();
  return file ? kDone : refuse(settings.out + ": cannot be written");
}

std::string_view environment(const char* name) {
  const char* const value = std::getenv(name);
  return value == nullptr ? std::string_view{} : value;
}

/// Why nobody can drive with a key from where this is run; empty: one can.
std::string no_place_for_a_key() {
  if (::isatty(STDIN_FILENO) == 0)
    return "it is driven with a key that a person holds: run it at a terminal (ssh -t)";
  const auto ancestors = names_of_ancestors();
  if (!ancestors)
    return "the kernel does not tell what this runs within (hidepid?), and what that is may answer "
           "for your terminal: run it with sudo";
  const auto between = stands_between({*ancestors, environment("TMUX"), environment("STY")});
  if (between.empty()) return "";
  return "this runs within " + between +
         ", which may answer for your terminal and go on when that is gone: nobody would notice "
         "that you let the key go; run it at a plain terminal (ssh -t)";
}

int calibrate_by_hand(const DriveSettings& settings, const std::string& socket) {
  if (const auto why = no_place_for_a_key(); !why.empty()) {
    tell_failure(settings.json, "drover", why);
    return kRefused;
  }
  Connection daemon(socket, kPatience_s);
  std::string problem;
  const auto loaded = configuration_of(daemon, problem);
  if (!problem.empty()) {
    tell_failure(settings.json, "drover", problem);
    return kRefused;
  }
  if (const auto why = not_calibrated(loaded.config.engine.base); !why.empty()) {
    tell_failure(settings.json, "drover", why);
    return kRefused;
  }
  CalibrationDrive it(loaded.config.engine);
  std::fprintf(stderr, "%s\n", it.intro().c_str());
  drive(daemon, it, engine::takes_twist(loaded.config.engine.base.kind));
  return tell_result(settings, it, loaded);
}

}  // namespace

void add_calibrate_drive_command(CLI::App& calibrate, const std::string& socket, int& code) {
  auto* command = calibrate.add_subcommand(
      "drive", "DRIVES the robot while you hold the space key, and calibrates from that");
  const auto settings = std::make_shared<DriveSettings>();
  command->add_option("--out", settings->out, "write the result to this file, too");
  command->add_flag("--json", settings->json, "the result as one JSON object");
  command->footer(
      "It says first which area it needs, and begins with the first key. Let go, it comes to "
      "rest.\n"
      "Nothing is changed: the patch is to be reviewed.\n"
      "Examples:\n"
      "  drover calibrate drive\n"
      "  drover calibrate drive --out calibration.txt\n"
      "  drover calibrate drive --json | jq .patch");
  command->callback([settings, &socket, &code] { code = calibrate_by_hand(*settings, socket); });
}

}  // namespace drover::cli
