// drover-guard: stops the wheels when droverd dies or hangs, or when a person says so and droverd
// does not hear. It opens no device, knows no protocol and shares no code path with what it
// watches. README.md here tells what it can and cannot do.
#include <pwd.h>
#include <sched.h>
#include <signal.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <optional>
#include <string>

#include "guard/guard.h"
#include "guard/sockets.h"

namespace {

constexpr const char* kHelp =
    "drover-guard [--socket PATH] [--stop-socket PATH] [--user NAME]\n"
    "Stops the drives, with the messages droverd gave it, when droverd dies or hangs.\n"
    "  --socket PATH       droverd hands them over here (/run/drover/guard.sock)\n"
    "  --stop-socket PATH  drover stop and drover reset (stop.sock beside the other)\n"
    "  --user NAME         name or number of droverd's user; nobody else but root hands over\n"
    "                      (the guard's own)\n";

struct Options {
  std::string socket = "/run/drover/guard.sock";
  std::string stop_socket;
  uid_t user = ::geteuid();
};

std::optional<uid_t> user_of(const char* name) {
  char* end = nullptr;
  const auto number = std::strtoul(name, &end, 10);
  if (end != name && *end == '\0') return static_cast<uid_t>(number);
  if (const auto* entry = ::getpwnam(name)) return entry->pw_uid;
  std::fprintf(stderr, "drover-guard: no user %s\n", name);
  return std::nullopt;
}

std::optional<Options> parse(int argc, char** argv) {
  Options options;
  for (int i = 1; i < argc; i += 2) {
    const std::string_view key = argv[i];
    if (i + 1 == argc) return std::nullopt;
    if (key == "--socket") {
      options.socket = argv[i + 1];
    } else if (key == "--stop-socket") {
      options.stop_socket = argv[i + 1];
    } else if (key == "--user") {
      const auto user = user_of(argv[i + 1]);
      if (!user) return std::nullopt;
      options.user = *user;
    } else {
      return std::nullopt;
    }
  }
  if (options.stop_socket.empty())
    options.stop_socket = options.socket.substr(0, options.socket.rfind('/') + 1) + "stop.sock";
  return options;
}

void become_real_time(drover::guard::Speech& speech) {
  sched_param priority{};
  priority.sched_priority = 70;  // above droverd's control thread: it must run when that one spins
  if (::sched_setscheduler(0, SCHED_FIFO, &priority) != 0)
    speech.say("drover-guard: no real-time priority (%s)", ::strerrordesc_np(errno));
  ::prctl(PR_SET_TIMERSLACK, 1);  // without that priority: 50 us of slack are the rule
  ::mlockall(MCL_CURRENT | MCL_FUTURE);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc == 2 && std::strcmp(argv[1], "--help") == 0) {
    std::fputs(kHelp, stdout);
    return 0;
  }
  const auto options = parse(argc, argv);
  if (!options) {
    std::fputs(kHelp, stderr);
    return 2;
  }
  ::signal(SIGPIPE, SIG_IGN);
  std::string problem;
  const int daemon = drover::guard::listen_at(options->socket, problem);
  const int stop = daemon < 0 ? -1 : drover::guard::listen_at(options->stop_socket, problem);
  if (stop < 0) {
    std::fprintf(stderr, "drover-guard: %s\n", problem.c_str());
    return 2;
  }
  static drover::guard::Speech speech;
  static drover::guard::Notify notify;
  static drover::guard::Guard guard(daemon, stop, options->user, speech, notify);
  become_real_time(speech);
  guard.take_over(drover::guard::take_kept());
  guard.run();
}
