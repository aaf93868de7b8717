// Reads a register map file: every problem at once, each with its place.
#include "config/register_map.h"

#include <algorithm>
#include <array>
#include <filesystem>

#include "config/fields_map.h"
#include "config/reader.h"
#include "config/register_conflicts.h"
#include "text/suggestion.h"

namespace drover::config {

namespace {

/// What a field is by itself: its unit, and what cannot be true of any battery.
struct FieldKind {
  std::string_view unit;
  double min;
  double max;
};
constexpr std::array<FieldKind, kBatteryFieldCount> kKinds{{
    {"V", 1, 1000},      // voltage
    {"A", -2000, 2000},  // current
    {"%", 0, 100},       // soc
    {"Ah", 0, 10000},    // remaining
    {"degC", -40, 125},  // temperature
    {"degC", -40, 200},  // switch_temperature
    {"V", 0.5, 5},       // lowest_cell
    {"V", 0.5, 5},       // highest_cell
    {"", 0, 0},          // state
    {"", 0, 0},          // charger
}};

struct Unit {
  std::string_view name;
  std::string_view si;
  double factor;
  double offset;
};
constexpr Unit kUnits[] = {
    {"V", "V", 1, 0},       {"mV", "V", 1e-3, 0},   {"A", "A", 1, 0},
    {"mA", "A", 1e-3, 0},   {"%", "%", 1, 0},       {"Ah", "Ah", 1, 0},
    {"mAh", "Ah", 1e-3, 0}, {"degC", "degC", 1, 0}, {"K", "degC", 1, -273.15},
};

template <class T>
T index_of(const std::vector<std::string>& names, const std::string& name) {
  const auto it = std::find(names.begin(), names.end(), name);
  return static_cast<T>(it == names.end() ? 0 : it - names.begin());
}

class Converter final {
 public:
  Converter(const json::Node& root, const MapFile& file, LoadedMap& loaded)
      : root_(root), file_(file), loaded_(loaded) {}

  void run() {
    RegisterMap& map = loaded_.map;
    map.name = file_.name;
    map.unit = static_cast<std::uint8_t>(file_.unit);
    map.baud = file_.baud;
    map.stride = static_cast<std::uint8_t>(file_.stride);
    map.max_count = static_cast<std::uint16_t>(file_.max_registers);
    map.max_hole = static_cast<std::uint16_t>(file_.max_hole);
    map.gap_s = file_.gap_s;
    map.reply_s = file_.reply_s;
    for (std::size_t i = 0; i < file_.fields.size(); ++i)
      map.fields.push_back(field(file_.fields[i], i));
    for (std::size_t i = 0; i < file_.alarms.size(); ++i) {
      const MapAlarm& alarm = file_.alarms[i];
      map.alarms.push_back(
          {function("alarms", i, alarm.function), static_cast<std::uint16_t>(alarm.address),
           static_cast<std::uint8_t>(alarm.bit), alarm.level == "critical", alarm.text});
    }
    for (const auto& finding : register_conflicts(file_, map))
      loaded_.problems.push_back(problem(finding));
    addresses();
  }

 private:
  const json::Node& item(const char* list, std::size_t index) const {
    return (*root_.find(list)->list())[index];
  }

  Problem problem(const MapFinding& finding) const {
    const auto& entry = item(finding.list, finding.index);
    const auto* value = entry.find(finding.key);
    const auto& at = value != nullptr ? *value : entry;
    return {at.line,
            at.column,
            std::string(finding.list) + "[" + std::to_string(finding.index) + "]." + finding.key,
            finding.message,
            finding.hint,
            ""};
  }

  void add(const char* list, std::size_t index, const char* key, std::string message,
           std::string hint = {}) {
    loaded_.problems.push_back(problem({list, index, key, std::move(message), std::move(hint)}));
  }

  /// Who writes an address in hexadecimal has it from the wire.
  void addresses() {
    struct Place {
      const char* list;
      std::size_t index;
      int address;
    };
    std::vector<Place> suspects;
    const auto look_at = [&](const char* list, const auto& entries) {
      for (std::size_t i = 0; i < entries.size(); ++i)
        if (is_as_in_sheets(entries[i].address) && item(list, i).find("address")->number())
          suspects.push_back({list, i, entries[i].address});
    };
    look_at("fields", file_.fields);
    look_at("alarms", file_.alarms);
    if (suspects.empty()) return;
    const Place& first = suspects.front();
    loaded_.warnings.push_back(
        problem(as_in_sheets(first.list, first.index, first.address, suspects.size() - 1)));
  }

  std::uint8_t function(const char* list, std::size_t index, int own) {
    if (own == 1 || own == 2)
      add(list, index, "function", "reads bits: only 3 and 4 read registers");
    return static_cast<std::uint8_t>(own == 0 ? file_.function : own);
  }

  RegisterField field(const MapField& from, std::size_t index) {
    RegisterField to;
    to.field = index_of<BatteryField>(kMapFields, from.field);
    const FieldKind& kind = kKinds[static_cast<std::size_t>(to.field)];
    to.function = function("fields", index, from.function);
    to.address = static_cast<std::uint16_t>(from.address);
    to.count = static_cast<std::uint16_t>(from.count);
    if (from.fitted >= 0) to.count_address = static_cast<std::uint16_t>(from.fitted);
    to.type = index_of<RegisterType>(kMapTypes, from.type);
    to.order = index_of<WordOrder>(kMapOrders, from.word_order);
    to.scale = from.scale;
    to.offset = from.offset;
    to.min = kind.min;
    to.max = kind.max;
    unit(from, kind, index, to);
    range(from, index, to);
    for (const double raw : from.invalid) to.invalid.push_back(static_cast<std::int64_t>(raw));
    states(from, index, to);
    if (from.scale == 0) add("fields", index, "scale", "is 0");
    if (from.address + (from.count * registers_of(to.type) - 1) * file_.stride > 0xFFFF)
      add("fields", index, "count", "reaches beyond the last register");
    return to;
  }

  void unit(const MapField& from, const FieldKind& kind, std::size_t index, RegisterField& to) {
    if (from.unit.empty()) return;
    for (const Unit& unit : kUnits) {
      if (unit.name != from.unit || unit.si != kind.unit) continue;
      to.scale *= unit.factor;
      to.offset = to.offset * unit.factor + unit.offset;
      return;
    }
    add("fields", index, "unit", "\"" + from.unit + "\" is no unit of " + from.field,
        kind.unit.empty() ? "leave it out" : "its own is " + std::string(kind.unit));
  }

  void range(const MapField& from, std::size_t index, RegisterField& to) {
    if (from.range.size() != 2) return;
    to.min = from.range[0];
    to.max = from.range[1];
    if (!(to.min < to.max)) add("fields", index, "range", "must be [lowest, highest]");
  }

  void states(const MapField& from, std::size_t index, RegisterField& to) {
    const bool wanted = to.field == BatteryField::flow;
    if (wanted && from.states.empty())
      add("fields", index, "states", "is missing", "[\"idle\", \"charging\", \"discharging\"]");
    if (!wanted && !from.states.empty())
      add("fields", index, "states", "belongs to the field \"state\" only");
    static const std::vector<std::string> kWords{"unknown", "idle", "charging", "discharging"};
    for (const auto& word : from.states) {
      if (std::find(kWords.begin(), kWords.end(), word) == kWords.end())
        add("fields", index, "states", "\"" + word + "\" is no state",
            text::did_you_mean(word, kWords));
      to.flows.push_back(index_of<BatteryFlow>(kWords, word));
    }
  }

  const json::Node& root_;
  const MapFile& file_;
  LoadedMap& loaded_;
};

}  // namespace

LoadedMap parse_register_map(std::string_view text) {
  LoadedMap loaded;
  loaded.text = text;
  const auto document = json::parse(text);
  if (!document) {
    const auto& error = document.error();
    loaded.problems.push_back({error.line, error.column, error.path, error.message, "", ""});
    return loaded;
  }
  const auto& root = document->root;
  if (root.object() == nullptr) {
    loaded.problems.push_back({root.line, root.column, "", "an object is expected", "{ ... }", ""});
    return loaded;
  }
  MapFile file;
  Reader reader(root, "", loaded.problems);
  visit(reader, file);
  reader.finish();
  // The lists may hold what was refused: their entries do not stand for themselves then.
  if (loaded.problems.empty()) Converter(root, file, loaded).run();
  return loaded;
}

LoadedMap load_register_map(const std::string& path) {
  std::string text;
  LoadedMap loaded;
  if (const auto problem = read_text(path, text); !problem.empty()) {
    loaded.problems.push_back({0, 0, "", problem, "", ""});
  } else {
    loaded = parse_register_map(text);
  }
  for (auto& problem : loaded.problems) problem.file = path;
  for (auto& warning : loaded.warnings) warning.file = path;
  return loaded;
}

namespace {

namespace fs = std::filesystem;

/// Of the clone in which this program was built; empty when it is installed.
fs::path maps_of_the_clone() {
  std::error_code none;
  const auto self = fs::read_symlink("/proc/self/exe", none);
  for (auto above = self.parent_path(); above.has_relative_path(); above = above.parent_path())
    if (fs::exists(above / "config" / "maps" / "register_map.schema.json", none))
      return above / "config" / "maps";
  return {};
}

}  // namespace

std::string find_register_map(const std::string& map, const std::string& folder) {
  const fs::path beside = fs::path(folder) / map;  // an absolute path stays as it is
  std::error_code ignored;
  if (fs::exists(beside, ignored)) return beside.lexically_normal().string();
  for (const auto* place : {"", "maps"}) {
    const fs::path installed = fs::path(DROVER_DATA_FOLDER) / place / map;
    if (fs::exists(installed, ignored)) return installed.string();
  }
  const auto clone = maps_of_the_clone();
  if (!clone.empty() && fs::exists(clone / map, ignored)) return (clone / map).string();
  return beside.lexically_normal().string();
}

std::vector<std::string> known_register_maps() {
  std::vector<std::string> names;
  for (const auto& folder : {fs::path(DROVER_DATA_FOLDER) / "maps", maps_of_the_clone()}) {
    std::error_code ignored;
    for (const auto& entry : fs::directory_iterator(folder, ignored)) {
      const auto name = entry.path().filename().string();
      if (name.ends_with(".json") && !name.ends_with(".schema.json")) names.push_back(name);
    }
  }
  std::sort(names.begin(), names.end());
  names.erase(std::unique(names.begin(), names.end()), names.end());
  return names;
}

MissingMap missing_register_map(const std::string& map, const std::string& folder) {
  std::error_code ignored;
  if (fs::exists(find_register_map(map, folder), ignored)) return {};
  if (fs::path(map).is_absolute()) return {"there is no file \"" + map + "\"", ""};
  const auto known = known_register_maps();
  auto hint = text::did_you_mean(fs::path(map).filename().string(), known);
  if (hint.empty())
    for (const auto& name : known) hint += (hint.empty() ? "there are: " : ", ") + name;
  const auto clone = maps_of_the_clone();
  return {"there is no \"" + map + "\" beside this file, nor among the installed maps in " +
              std::string(DROVER_DATA_FOLDER) + "/maps" +
              (clone.empty() ? "" : ", nor in " + clone.string()),
          hint.empty() ? "none are installed there" : hint};
}

}  // namespace drover::config
