// drover-ros2: shows the robot to ROS 2 users, without ROS.
#include <signal.h>

#include <CLI/CLI.hpp>
#include <atomic>
#include <cstdio>

#include "config/load.h"
#include "ros2/program.h"
#include "ros2/say.h"

namespace {

constexpr int kBadConfiguration = 2;

std::atomic<bool> stop_asked{false};

void on_signal(int) {
  stop_asked.store(true, std::memory_order_relaxed);
}

/// False: it is not good, and each problem is a line on standard error.
bool report(const drover::config::Loaded& loaded, const std::string& file) {
  for (const auto& problem : loaded.problems)
    std::fprintf(stderr, "%s\n", problem.text(file).c_str());
  return loaded.problems.empty();
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"drover-ros2: shows the robot to ROS 2 users"};
  std::string file = "/etc/drover/drover.json";
  app.add_option("-c,--config", file, "droverd's configuration, with a section \"ros2\"")
      ->capture_default_str();
  app.set_version_flag("--version", DROVER_VERSION);
  app.footer(
      "Exit codes: 0 ended as asked, or the configuration wants nothing shown; "
      "1 it could not go on and says why; 2 wrong arguments or configuration.");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : kBadConfiguration;  // 0: --help and --version
  }
  const auto loaded = drover::config::load_file(file);
  if (!report(loaded, file)) return kBadConfiguration;
  const auto& ros2 = loaded.config.ros2;
  if (!ros2.configured || ros2.mode == "off") {
    std::fprintf(stderr, "%s: %s: nothing is shown\n", file.c_str(),
                 ros2.configured ? "ros2.mode is off" : "there is no section \"ros2\"");
    return 0;
  }
  struct sigaction action {};
  action.sa_handler = on_signal;  // without SA_RESTART: poll returns
  for (const int signal : {SIGTERM, SIGINT}) ::sigaction(signal, &action, nullptr);
  const drover::runtime::LogWriter log_writer;  // before any other thread: as droverd's
  try {
    drover::ros2::Program(loaded.config).run(stop_asked);
  } catch (const std::exception& error) {
    drover::ros2::say(drover::ros2::Level::error, error.what());
    return 1;
  }
  return 0;
}
