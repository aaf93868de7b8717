#include "cli/devices.h"

#include <cerrno>
#include <cstring>
#include <fstream>
#include <iostream>
#include <memory>

#include "cli/exit_codes.h"
#include "cli/failure.h"
#include "cli/live.h"
#include "cli/number_checks.h"
#include "cli/option_texts.h"
#include "cli/recorded.h"

namespace drover::cli {

namespace {

struct Texts {
  std::string_view name;
  std::string_view what;
  std::string_view file;
  std::string_view driver;  ///< for a recording, unless told otherwise
};

constexpr Texts kTexts[] = {
    {"gnss", "receiver: position, quality, speed, heading",
     "recorded bytes of the receiver's line, as they came", "nmea0183"},
    {"imu", "inertial sensor: acceleration, rate, bias, attitude",
     "recorded bytes of the sensor's line, as they came", "witmotion"},
    {"bms", "battery: charge, voltage, current, cells, alarms",
     "recorded registers, a line each: a frame of Modbus RTU in hexadecimal with its checksum, as "
     "loggers write it (requests tell which registers an answer holds), or ADDRESS: WORDS, as in "
     "0x0028: 0212 74D7 or 40: 0212 74D7 (4/0x0028: when function 4 read them); # begins a comment",
     "modbus_bms"},
    {"can", "buses and drives: counts, rates, state, motion, temperatures, faults",
     "log of candump -l; without --driver a table of its ids", ""},
    {"gpio", "digital lines: levels in words", "there is no recording of lines", ""},
};

struct Command {
  std::string file;
  LiveSettings live;
  Recording recording;
};

int show(const DeviceView& view, const Command& command) {
  if (command.file.empty()) return show_live(view, command.live);
  if (command.live.watch) throw WrongUsage("--watch and --file exclude each other");
  if (view.name == "gpio") return show_recording(view.name, std::cin, {}, std::cout, std::cerr);
  if (command.file == "-")
    return show_recording(view.name, std::cin, command.recording, std::cout, std::cerr);
  std::ifstream in(command.file, std::ios::binary);
  if (!in) {
    tell_failure(command.live.json, "drover", command.file + ": " + std::strerror(errno));
    return kRefused;
  }
  const int code = show_recording(view.name, in, command.recording, std::cout, std::cerr);
  if (code == kRefused && command.live.json)
    tell_failure(true, "drover", command.file + ": nothing in it could be decoded");
  return code;
}

}  // namespace

void add_device_commands(CLI::App& app, const std::string& socket, int& code) {
  for (const auto& texts : kTexts) {
    const DeviceView* view = nullptr;
    for (const auto& each : device_views())
      if (each.name == texts.name) view = &each;
    if (view == nullptr) continue;
    auto command = std::make_shared<Command>();
    command->recording.driver = texts.driver;
    auto* sub = app.add_subcommand(std::string(texts.name), std::string(texts.what));
    sub->add_flag("--json", command->live.json, "JSON: one object, from a file one for each line");
    sub->add_flag("--watch", command->live.watch, "again and again");
    auto* file =
        sub->add_option("--file", command->file, std::string(texts.file) + "; - is standard input");
    // What droverd shows it has read by its own configuration.
    const auto of_recording = [file](CLI::Option* option) { return option->needs(file); };
    if (texts.name != "gpio") {
      of_recording(sub->add_option("--driver", command->recording.driver, "of a recording"))
          ->capture_default_str();
      of_recording(sub->add_option("--option", command->recording.options,
                                   "NAME=VALUE of a recording's driver, as in the configuration"));
    }
    if (texts.name == "bms")
      of_recording(
          sub->add_option("--map", command->recording.map,
                          "file of a recording's registers: a path or one of the installed maps"));
    if (texts.name == "can") {
      of_recording(sub->add_option("--node", command->recording.nodes,
                                   "node id of a drive, several if needed"))
          ->transform(whole_number(0, INT32_MAX));
      of_recording(
          sub->add_option("--bus", command->recording.bus, "of a recording: only this one"));
    }
    sub->callback([command, view, &socket, &code] {
      command->live.socket = socket;
      command->recording.json = command->live.json;
      code = show(*view, *command);
    });
  }
}

}  // namespace drover::cli
