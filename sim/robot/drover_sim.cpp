// drover-sim: the MuJoCo robot that answers on the gateway's wires.
#include <CLI/CLI.hpp>

#include <cstdio>
#include <cstdlib>
#include <exception>
#include <string>
#include <vector>

#include "sim/robot/simulator.h"

namespace {

constexpr const char* kFooter = R"(
Commands for a running simulator (drover-sim ctl COMMAND...):
  estop press|release            bumper touch|free        zone near|far occupied|free
  tap estop|bumper|zone_...      (an instant only)
  obstacle NAME X Y|remove       gnss STATE|unplug|plug   kick VX VY
  obstacle NAME box X Y YAW_DEG L W H [Z] | cylinder|cone X Y R H [Z] | sphere X Y R [Z] |
    prism X Y H Z X1 Y1 X2 Y2 X3 Y3 ... | move X Y SPEED | remove
  imu STATE|well|unplug|plug     (silent, frozen, saturated, bias:2, restart, ...)
  drive NAME|all power on|off    drive NAME|all fault NAME|none     drive NAME unplug|plug
  battery soc P | charger plug|unplug | unplug|plug
  battery well|silent|slow|other_unit|wrong_crc|drip|echo|deaf_echo|exception
  gnss|imu|battery NAME ...      the same of a further device of that name
  can BUS slcan TEXT|stall|flow|unplug|plug               lines unplug|plug
  truth                                                   quit

Examples:
  drover-sim --scenario sim/scenarios/demo.json
  drover-sim --scenario s.json --can-transport unix --lines files --run-dir /tmp/robot
  drover-sim ctl estop press
  drover-sim ctl --run-dir /tmp/robot obstacle obstacle 4.0 0.0
  drover-sim ctl can can0 slcan sb256256
)";

int control(const std::string& run_folder, const std::vector<std::string>& words) {
  std::string text;
  for (const auto& word : words) text += (text.empty() ? "" : " ") + word;
  const auto answer = drover::sim::ask(run_folder + "/sim.sock", text);
  std::printf("%s\n", answer.c_str());
  return answer.starts_with("error") ? 1 : 0;
}

}  // namespace

int main(int argc, char** argv) {
  drover::sim::SimulatorSettings settings;
  std::string can_transport = "socketcan";
  std::string lines = "gpio-sim";
  std::vector<std::string> words;

  CLI::App app("The simulated robot: the other end of every wire of the gateway.", "drover-sim");
  app.footer(kFooter);
  app.set_version_flag("--version", DROVER_VERSION);
  app.add_option("--scenario", settings.scenario_file, "robot, world and events (JSON)");
  app.add_option("--seed", settings.seed, "source of all randomness")->envname("DROVER_SEED");
  app.add_option("--run-dir", settings.run_folder, "for sockets and serial lines")
      ->capture_default_str();
  app.add_option("--log-dir", settings.log_folder,
                 "for can.log, truth.csv, lines.log; none: no logs");
  app.add_option("--can-transport", can_transport, "buses as the scenario says, or all as sockets")
      ->check(CLI::IsMember({"socketcan", "unix"}))
      ->capture_default_str();
  app.add_option("--lines", lines, "contacts as a gpio-sim chip's inputs, or as files")
      ->check(CLI::IsMember({"gpio-sim", "files"}))
      ->capture_default_str();
  auto* ctl = app.add_subcommand("ctl", "send a command to a running simulator");
  ctl->add_option("--run-dir", settings.run_folder, "of the running simulator");
  ctl->add_option("command", words, "see below")->required();
  ctl->positionals_at_end(false);
  ctl->prefix_command();
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  }

  try {
    if (ctl->parsed()) {
      const auto rest = ctl->remaining();
      words.insert(words.end(), rest.begin(), rest.end());
      return control(settings.run_folder, words);
    }
    if (settings.scenario_file.empty()) {
      std::fprintf(stderr, "drover-sim: --scenario is missing; see --help\n");
      return 2;
    }
    settings.can_over_unix = can_transport == "unix";
    settings.line_files = lines == "files";
    drover::sim::Simulator simulator(settings);
    simulator.run();
    std::fprintf(stderr, "drover-sim: %s\n", simulator.summary().c_str());
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "drover-sim: %s\n", error.what());
    return 2;
  }
}
