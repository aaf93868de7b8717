#include "cli/recorded.h"

#include <algorithm>
#include <cstdio>
#include <istream>
#include <map>
#include <memory>
#include <optional>
#include <ostream>
#include <string>
#include <vector>

#include "cli/can_table.h"
#include "cli/candump.h"
#include "cli/exit_codes.h"
#include "cli/measurement.h"
#include "cli/option_texts.h"
#include "cli/register_log.h"
#include "cli/register_rounds.h"
#include "config/register_map.h"
#include "drover/registry.h"
#include "text/suggestion.h"

namespace drover::cli {

namespace {

constexpr double kUsualBaud = 115200;
/// Between two rounds of a battery: its recording carries no times.
constexpr Duration kRound = std::chrono::seconds(1);
constexpr int kShownProblems = 5;

/// Prints measurements and counts what came of the recording.
class Printer final {
 public:
  Printer(const Recording& recording, std::ostream& out, std::ostream& notes)
      : json_(recording.json), out_(out), notes_(notes) {}

  /// What `device` said in the last call.
  void print(const DriverOut& said, const Device& device, const Place& place) {
    for (const auto& m : said.measurements) {
      ++measurements_;
      const Reason words = device.words(m);
      out_ << (json_ ? measurement_json(m, words, place) : measurement_text(m, words, place))
           << '\n';
    }
  }
  void problem(std::size_t number, const std::string& text) {
    if (++problems_ <= kShownProblems) notes_ << "line " << number << ": " << text << '\n';
  }
  void add_bad(std::uint64_t count) { bad_ += count; }
  int finish() { return finish(measurements_, "measurements"); }
  int finish(std::uint64_t count, std::string_view what) {
    notes_ << what << ' ' << count;
    if (bad_ > 0) notes_ << ", malformed " << bad_;
    if (problems_ > 0) notes_ << ", lines not understood " << problems_;
    if (count == 0 && bad_ == 0 && problems_ == 0)
      notes_ << ": the recording is empty, or nothing in it is of this device";
    notes_ << '\n';
    return count > 0 ? kDone : kRefused;
  }

 private:
  bool json_;
  std::ostream& out_;
  std::ostream& notes_;
  std::uint64_t measurements_ = 0;
  std::uint64_t problems_ = 0;
  std::uint64_t bad_ = 0;
};

/// A device that has this face. What its driver refuses of its options is wrong usage here.
template <class Face>
Made made(const DriverEntry& entry, Face Made::*face, const Options& options,
          const MakeContext& context) {
  Made device;
  try {
    device = entry.make(options, context);
  } catch (const std::exception& error) {
    throw WrongUsage(error.what());
  }
  if (device.*face == nullptr)
    throw WrongUsage("driver " + std::string(entry.name) + " does not read such recordings");
  return device;
}

const DriverEntry& entry_of(SlotKind kind, const std::string& name) {
  if (const auto* entry = find_driver(name, kind)) return *entry;
  std::vector<std::string> names;
  std::string known;
  for (const auto& each : driver_registry()) {
    if (each.kind != kind) continue;
    known += (known.empty() ? "" : ", ") + std::string(each.name);
    names.emplace_back(each.name);
  }
  if (name.empty()) throw WrongUsage("--driver is missing: " + known);
  const auto meant = text::did_you_mean(name, names);
  throw WrongUsage("no driver \"" + name + "\" for this device: " + known +
                   (meant.empty() ? "" : " (" + meant + ")"));
}

/// The recording carries no times: its bytes come one after the other at the line's speed.
int show_bytes(SlotKind kind, std::istream& in, const Recording& recording, std::ostream& out,
               std::ostream& notes) {
  const auto& entry = entry_of(kind, recording.driver);
  const auto options = options_from(entry.options, recording.options);
  const auto driver = made(entry, &Made::bytes, options, {.kind = kind});
  const double baud = options.has("baud") ? options.number("baud") : kUsualBaud;
  const Duration byte_time = from_s(kBitsPerByte / baud);
  Printer printer(recording, out, notes);
  DriverOut said;
  Time now{};
  driver.device->on_link_up(now);
  std::uint64_t offset = 0;
  for (int c = in.get(); c != std::istream::traits_type::eof(); c = in.get()) {
    const auto byte = static_cast<std::uint8_t>(c);
    driver.bytes->on_bytes({&byte, 1}, now, said);
    printer.print(said, *driver.device, {"byte", static_cast<double>(++offset), 0, ""});
    said.clear();
    now += byte_time;
  }
  printer.add_bad(driver.device->health(now).bad);
  return printer.finish();
}

/// In two parts: nanoseconds since 1970 are too many for a double.
double seconds_of(Time stamp) {
  constexpr std::int64_t kSecond = 1'000'000'000;
  const std::int64_t ns = stamp.time_since_epoch().count();
  const std::int64_t whole_s = ns / kSecond;
  return static_cast<double>(whole_s) + static_cast<double>(ns % kSecond) / 1e9;
}

struct DriveNode {
  std::string name;
  Made made;
};

std::vector<DriveNode> nodes_of(const Recording& recording) {
  const auto& entry = entry_of(SlotKind::drive, recording.driver);
  std::vector<DriveNode> nodes;
  const auto add = [&](const std::string& name, const std::vector<std::string>& texts) {
    nodes.push_back({name, made(entry, &Made::frames, options_from(entry.options, texts), {})});
  };
  if (recording.nodes.empty()) add("", recording.options);
  for (const int node : recording.nodes) {
    auto texts = recording.options;
    texts.push_back("node=" + std::to_string(node));
    add("node " + std::to_string(node), texts);
  }
  return nodes;
}

int show_frames(std::istream& in, const Recording& recording, std::ostream& out,
                std::ostream& notes) {
  Printer printer(recording, out, notes);
  std::optional<CanTable> table;
  std::vector<DriveNode> nodes;
  if (recording.driver.empty()) {
    if (!recording.nodes.empty() || !recording.options.empty())
      throw WrongUsage("--node and --option need --driver");
    table.emplace();
  } else {
    nodes = nodes_of(recording);
  }
  DriverOut said;
  Time last{};
  bool begun = false;
  std::string line;
  for (std::size_t number = 1; std::getline(in, line); ++number) {
    if (line.find_first_not_of(" \t\r") == std::string::npos) continue;
    const auto logged = parse_candump(line);
    if (!logged) {
      printer.problem(number, "not of the form (SECONDS) BUS ID#DATA");
      continue;
    }
    if (!recording.bus.empty() && logged->bus != recording.bus) continue;
    last = logged->time;
    const double stamp_s = seconds_of(last);
    if (table) table->add(*logged);
    for (const auto& node : nodes) {
      if (!begun) node.made.device->on_link_up(last);
      if (!logged->frame.error) node.made.frames->on_frame(logged->frame, last, said);
      printer.print(said, *node.made.device, {"t_s", stamp_s, 6, node.name});
      said.clear();
    }
    begun = true;
  }
  for (const auto& node : nodes) {
    const auto health = node.made.device->health(last);
    printer.add_bad(health.bad);
    if (!health.reason.empty())
      notes << node.name << (node.name.empty() ? "" : ": ") << health.reason.view() << '\n';
  }
  if (!table) return printer.finish();
  table->print(out, recording.json);
  return printer.finish(table->frames(), "frames");
}

std::string unit_text(std::uint8_t unit) {
  char text[16];
  std::snprintf(text, sizeof text, "0x%02X", unsigned{unit});
  return text;
}

int show_registers(std::istream& in, const Recording& recording, std::ostream& out,
                   std::ostream& notes) {
  const auto& entry = entry_of(SlotKind::battery, recording.driver);
  if (recording.map.empty()) throw WrongUsage("--map is missing: the file of the registers");
  if (const auto missing = config::missing_register_map(recording.map, ".");
      !missing.message.empty())
    throw WrongUsage("--map: there is no \"" + recording.map + "\" here, nor an installed map" +
                     (missing.hint.empty() ? "" : " (" + missing.hint + ")"));
  const auto loaded = config::load_register_map(config::find_register_map(recording.map, "."));
  for (const auto& problem : loaded.problems) throw WrongUsage(problem.text(problem.file));
  const auto options = options_from(entry.options, recording.options);
  const auto make = [&](const RegisterMap& map) {
    return made(entry, &Made::registers, options, {.kind = SlotKind::battery, .registers = &map});
  };
  const auto whole = make(loaded.map);
  RegisterLog log(whole.registers->blocks(), loaded.map.stride);
  RoundDecoder decoder(make, loaded.map);
  Printer printer(recording, out, notes);
  DriverOut said;
  Time now{};
  std::optional<std::uint8_t> unit;
  std::string line;
  std::size_t number = 0;
  std::size_t last_number = 0;
  const auto show_round = [&](const RegisterImage& round, std::size_t where) {
    if (round.empty()) return;
    now += kRound;
    if (const Device* const device = decoder.decode(round, now, said))
      printer.print(said, *device, {"line", static_cast<double>(where), 0, ""});
    said.clear();
  };
  while (std::getline(in, line)) {
    ++number;
    line.resize(std::min(line.size(), line.find('#')));
    if (line.find_first_not_of(" \t\r") == std::string::npos) continue;
    if (const auto problem = log.add(line); !problem.empty()) printer.problem(number, problem);
    if (log.unit() != unit) {
      unit = log.unit();
      if (*unit != loaded.map.unit)
        notes << "line " << number << ": unit " << unit_text(*unit) << " answers; the map's is "
              << unit_text(loaded.map.unit) << '\n';
    }
    show_round(log.take_ended(), last_number);
    show_round(log.take_complete(), number);
    last_number = number;
  }
  show_round(log.take_rest(), last_number);
  printer.add_bad(decoder.bad(now));
  if (const auto missing = decoder.missing(); !missing.empty())
    notes << "not in the recording: " << missing << '\n';
  if (const auto reason = decoder.reason(now); !reason.empty()) notes << reason << '\n';
  return printer.finish();
}

}  // namespace

int show_recording(std::string_view device, std::istream& in, const Recording& recording,
                   std::ostream& out, std::ostream& notes) {
  if (device == "gnss") return show_bytes(SlotKind::gnss, in, recording, out, notes);
  if (device == "imu") return show_bytes(SlotKind::imu, in, recording, out, notes);
  if (device == "bms") return show_registers(in, recording, out, notes);
  if (device == "can") return show_frames(in, recording, out, notes);
  throw WrongUsage("levels of GPIO lines are not recorded: leave out --file");
}

}  // namespace drover::cli
