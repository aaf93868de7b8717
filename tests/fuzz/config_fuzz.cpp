// Any bytes as drover.json and as a register map: no crash, every problem with its place in the
// text and a line that cannot be forged, and what is accepted is inside the tables' ranges and is
// accepted again when it is written down and read.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "config/load.h"
#include "config/old_sections.h"
#include "config/register_map.h"
#include "drover/registry.h"
#include "json/located_json.h"
#include "tests/fuzz/config_dump.h"

namespace {

using namespace drover;

constexpr std::size_t kMaxInput = 16384;
const std::string kMapFolder = DROVER_SOURCE_DIR "/config/maps";

void require(bool holds) {
  if (!holds) std::abort();
}

/// The characters of each line.
std::vector<std::size_t> widths(std::string_view text) {
  std::vector<std::size_t> all{0};
  for (const char c : text) {
    if (c == '\n') {
      all.push_back(0);
    } else if ((static_cast<unsigned char>(c) & 0xC0U) != 0x80U) {
      ++all.back();
    }
  }
  return all;
}

bool is_utf8(const std::string& text) {
  json::JsonText quoted;
  quoted.text(text);
  const auto back = json::parse(quoted.str());
  return back.ok() && *back->root.text() == text;
}

void check_problems(std::string_view text, const std::vector<config::Problem>& problems,
                    bool is_object) {
  const auto lines = widths(text);
  for (const auto& problem : problems) {
    require(!problem.message.empty());
    const std::string line = problem.text("f");
    require(line.size() < 2000 && is_utf8(line));
    for (const char c : line) require(static_cast<unsigned char>(c) >= 0x20 && c != 0x7F);
    if (!problem.file.empty()) continue;  // its place is in the register map
    require(problem.line >= 1 && problem.line <= lines.size());
    // An end that came too early is behind the last character.
    require(problem.column >= 1 && problem.column <= lines[problem.line - 1] + 1);
    // The path of the empty key is empty.
    require(!is_object || !problem.path.empty() || problem.message == "is no known key");
  }
}

/// A file of the machine is nothing that an input may name.
bool names_a_path(const json::Node& root) {
  const auto* devices = root.find("devices");
  if (devices == nullptr || devices->object() == nullptr) return false;
  for (const auto& device : *devices->object()) {
    const auto* map = device.node.find("map");
    if (map != nullptr && map->text() != nullptr && map->text()->find('/') != std::string::npos)
      return true;
  }
  return false;
}

void check_config(std::string_view text, bool is_object) {
  const auto loaded = config::load_text(text, kMapFolder);
  check_problems(text, loaded.problems, is_object);
  if (!loaded.new_sections.empty()) {
    // The text in their stead has none of them.
    const auto today = config::in_todays_form(text);
    require(config::load_text(today, kMapFolder, "{}").new_sections.empty());
  }
  if (!loaded.problems.empty()) return;
  const std::string written = fuzz::dump(loaded.config, require);
  const auto again = config::load_text(written, kMapFolder);
  require(again.problems.empty());
  require(fuzz::dump(again.config, require) == written);
}

void check_blocks(std::span<const RegisterBlock> blocks, const RegisterMap& map) {
  require(!blocks.empty());
  for (const RegisterBlock& block : blocks) {
    require(block.function == 3 || block.function == 4);
    require(block.count >= 1 && block.count <= map.max_count);
    require(block.address + (block.count - 1) * map.stride <= 0xFFFF);
  }
}

void check_driver(const RegisterMap& map) {
  const DriverEntry* entry = find_driver("modbus_bms");
  require(entry != nullptr);
  const auto made =
      entry->make(Options(entry->options), {.kind = SlotKind::battery, .registers = &map});
  auto* const driver = made.registers;
  require(driver != nullptr);
  check_blocks(driver->blocks(), map);
  static DriverOut out;
  constexpr std::uint16_t kWords[] = {0x0000, 0x0001, 0x7FC0, 0x8000, 0xFFFF};
  for (const std::uint16_t word : kWords) {
    out.clear();
    for (std::size_t i = 0; i < driver->blocks().size(); ++i) {
      const std::vector<std::uint16_t> words(driver->blocks()[i].count, word);
      driver->on_registers(i, words, Time{std::chrono::seconds(100)}, out);
    }
    require(out.measurements.size() == 1 && out.overflows == 0);
    const auto& s = std::get<BatterySample>(out.measurements[0].value);
    for (const double value : {s.voltage_V, s.current_A, s.soc_percent, s.remaining_Ah,
                               s.temperature_degC, s.mosfet_degC, s.min_cell_V, s.max_cell_V})
      require(!std::isinf(value));
  }
}

void check_map(std::string_view text, bool is_object) {
  const auto loaded = config::parse_register_map(text);
  check_problems(text, loaded.problems, is_object);
  if (!loaded.problems.empty()) return;
  const auto again = config::parse_register_map(text);
  require(again.problems.empty() && again.map.fields.size() == loaded.map.fields.size());
  for (const RegisterField& field : loaded.map.fields)
    require(std::isfinite(field.scale) && std::isfinite(field.offset) && field.scale != 0 &&
            field.min <= field.max);
  check_driver(loaded.map);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size > kMaxInput) return 0;
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  const auto document = json::parse(text);
  const bool is_object = document.ok() && document->root.object() != nullptr;
  if (is_object && names_a_path(document->root)) return 0;
  check_config(text, is_object);
  check_map(text, is_object);
  return 0;
}
