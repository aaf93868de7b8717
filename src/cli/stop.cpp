#include "cli/stop.h"

#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <optional>
#include <utility>

#include "cli/client.h"
#include "cli/exit_codes.h"
#include "cli/layout.h"
#include "cli/unheard_drives.h"
#include "json/json_text.h"
#include "json/located_json.h"
#include "link/packet_question.h"

namespace drover::cli {

namespace {

/// Who stops a robot does not wait: the guard answers within one cycle of its own, droverd within
/// a few of the control thread's.
constexpr std::chrono::milliseconds kGuardPatience{300};
constexpr int kDaemonPatience_s = 1;

struct Answer {
  bool obeyed = false;
  bool heard = false;  ///< it answered
  bool maybe = false;  ///< it did not, but was asked
  bool limp = false;   ///< the guard leaves the drives alone: they were released, or have no power
  std::int64_t unreached = 0;  ///< drives to which the guard never had a way
  std::string why = {};        ///< not obeyed: a sentence
};

std::string guard_path(const StopPlaces& places) {
  if (!places.guard.empty()) return places.guard;
  return places.daemon.substr(0, places.daemon.rfind('/') + 1) + "stop.sock";
}

std::string why_no_guard(const std::string& path, int error) {
  if (error == ENOENT || error == ECONNREFUSED)
    return "drover-guard does not run (no answer at " + path + ")";
  if (error == EAGAIN || error == EINPROGRESS) return "drover-guard did not answer";
  return path + ": " + std::strerror(error);
}

/// The guard's answer to one word, its state; nothing with a sentence in `problem`.
std::optional<json::Document> ask_guard(const StopPlaces& places, std::string_view word,
                                        std::string& problem) {
  const auto path = guard_path(places);
  const auto answer = link::ask_packet(path, word, kGuardPatience);
  if (!answer) {
    problem = why_no_guard(path, answer.error());
    return std::nullopt;
  }
  auto state = json::parse(*answer);
  if (state.ok()) return std::move(state.value());
  problem = "drover-guard's answer is not understood";
  return std::nullopt;
}

Answer tell_guard(const StopPlaces& places, std::string_view word) {
  std::string problem;
  const auto state = ask_guard(places, word, problem);
  if (!state) return {.why = problem};
  if (yes(at(state->root, "latched")) != (word == "stop"))
    return {.heard = true, .why = "drover-guard did not take it"};
  const auto* axes = state->root.find("axes");
  const bool has_axes = axes != nullptr && axes->integer().value_or(0) > 0;
  if (word == "stop" && !has_axes)
    return {.heard = true, .why = "drover-guard permits no motion, but knows no drives to stop"};
  const auto* may_hold = state->root.find("may_hold");
  const bool limp = may_hold != nullptr && !yes(*may_hold);
  const auto* unreached = state->root.find("axes_never_reached");
  return {.obeyed = true,
          .heard = true,
          .limp = limp,
          .unreached = unreached != nullptr ? unreached->integer().value_or(0) : 0};
}

bool holds(const StopPlaces& places) {
  std::string problem;
  const auto state = ask_guard(places, "state", problem);
  return state && yes(at(state->root, "holds"));
}

Answer tell_daemon(const StopPlaces& places, std::string_view cmd) {
  try {
    const auto question = json::JsonText().open('{').key("cmd").text(cmd).close('}').take();
    const auto reply = json::parse(ask(places.daemon, question, kDaemonPatience_s));
    if (!reply) return {.heard = true, .why = "droverd's answer is not understood"};
    if (yes(at(reply->root, "ok"))) return {.obeyed = true, .heard = true};
    const auto* reason = reply->root.find("reason");
    return {.heard = true,
            .why = reason != nullptr && reason->text() != nullptr ? *reason->text()
                                                                  : "droverd refused"};
  } catch (const NoAnswer& no) {
    return {.maybe = no.asked, .why = no.text};
  }
}

/// droverd's; nothing when it does not answer.
std::optional<json::Node> daemon_status(const StopPlaces& places) {
  try {
    const auto question = json::JsonText().open('{').key("cmd").text("status").close('}').take();
    const auto reply = json::parse(ask(places.daemon, question, kDaemonPatience_s));
    const auto* status = reply ? reply->root.find("status") : nullptr;
    return status == nullptr ? std::nullopt : std::optional(*status);
  } catch (const NoAnswer&) {
    return std::nullopt;
  }
}

/// What droverd does not hear of the drives; empty also when it does not answer.
std::string unheard(const StopPlaces& places) {
  const auto status = daemon_status(places);
  return status ? unheard_drives(*status) : std::string();
}

bool guard_is_latched(const StopPlaces& places) {
  std::string problem;
  const auto guard = ask_guard(places, "state", problem);
  return guard && yes(at(guard->root, "latched"));
}

/// Whether somebody's stop holds the robot; true where droverd does not say.
bool is_stopped(const StopPlaces& places) {
  if (guard_is_latched(places)) return true;
  const auto status = daemon_status(places);
  return !status || status->find("stopped_until_told") == nullptr ||
         yes(at(*status, "stopped_until_told"));
}

void add(json::JsonText& out, std::string_view key, const Answer& answer) {
  out.key(key).open('{').key("ok").boolean(answer.obeyed);
  if (!answer.obeyed) out.key("reason").text(answer.why);
  out.close('}');
}

/// One line for people or one object for programs.
void print(const StopPlaces& places, bool done, const Answer& guard, const Answer& daemon,
           const std::string& words) {
  if (places.json) {
    json::JsonText out;
    out.open('{').key("ok").boolean(done);
    if (!done) out.key("reason").text(words);
    add(out, "guard", guard);
    add(out, "droverd", daemon);
    std::printf("%s\n", out.close('}').str().c_str());
  } else if (done) {
    std::printf("done: %s\n", words.c_str());
  } else {
    std::fprintf(stderr, "%s: %s\n", daemon.maybe ? "not known" : "refused", words.c_str());
  }
}

/// The guard gives the bus back when droverd asks for it, which takes a moment; droverd knows a few
/// cycles later that it has it.
void wait_for_bus(const StopPlaces& places) {
  constexpr int kTries = 40;
  constexpr useconds_t kBetween_us = 50'000;
  bool held = false;
  for (int i = 0; i < kTries && holds(places); ++i) {
    held = true;
    ::usleep(kBetween_us);
  }
  if (held) ::usleep(kBetween_us);
}

}  // namespace

int stop(const StopPlaces& places) {
  const auto guard = tell_guard(places, "stop");
  const auto daemon = tell_daemon(places, "stop");
  bool done = guard.obeyed || daemon.obeyed;
  std::string words = "drover-guard and droverd stop the robot";
  if (!guard.obeyed) words = "droverd stops the robot; " + guard.why;
  if (!daemon.obeyed) words = "drover-guard stops the robot; " + daemon.why;
  if (guard.unreached > 0 && !daemon.obeyed)
    words += "; drives to which it never had a way: " + std::to_string(guard.unreached);
  if (!done)
    words = (daemon.maybe ? "nobody says that the robot stops: " : "nobody stops the robot: ") +
            guard.why + "; " + daemon.why;
  // A latched stop commands nothing to drives that were let go: a robot that rolls rolls on.
  if (done && guard.limp)
    words =
        "nothing may drive the robot, but its drives were released or have no power and hold "
        "nothing: drover hold";
  // A stop that a drive may not have heard is no stop yet: some keep the last command for ever.
  const auto missing = daemon.obeyed ? unheard(places) : std::string();
  if (!missing.empty()) {
    done = false;
    words += ", but nothing is heard from " + missing +
             ": whether the robot stops is not known; press the emergency stop";
  }
  print(places, done, guard, daemon, words);
  return done ? kDone : guard.heard || daemon.heard ? kRefused : kNoDaemon;
}

int reset(const StopPlaces& places) {
  // droverd first: it knows whether the cause is over. What it refuses is refused, and the guard
  // goes on holding; where it is not there the guard's stop can be ended all the same.
  const bool was_stopped = is_stopped(places);
  const auto daemon = tell_daemon(places, "reset");
  const bool refused = daemon.heard && !daemon.obeyed;
  Answer guard{.heard = true, .why = "not asked: droverd refused"};
  if (!refused) guard = tell_guard(places, "reset");
  if (guard.obeyed) wait_for_bus(places);
  const bool done = daemon.obeyed && (guard.obeyed || !guard.heard);
  std::string words = was_stopped ? "the stop is over" : "no stop was latched";
  if (!guard.obeyed) words = (done ? words + "; " : "") + guard.why;
  if (!daemon.obeyed)
    words = (!guard.obeyed || daemon.heard ? ""
             : daemon.maybe                ? "drover-guard's stop is over; "
                                           : "only drover-guard's stop is over: ") +
            daemon.why;
  print(places, done, guard, daemon, words);
  return done ? kDone : daemon.heard ? kRefused : kNoDaemon;
}

}  // namespace drover::cli
