#include "config/register_conflicts.h"

#include <algorithm>
#include <cstdio>
#include <optional>

namespace drover::config {
namespace {

constexpr int kRegister_B = 2;

struct Bytes {
  int begin;
  int end;
};

/// In bytes, so that the halves of a register are two places.
int place_of(const RegisterField& field, int stride) {
  return field.address * kRegister_B / stride;
}

Bytes bytes_of(const RegisterField& field, int neighbour, int stride) {
  const int size_B = registers_of(field.type) * kRegister_B;
  const int begin = place_of(field, stride) + neighbour * size_B;
  if (field.type == RegisterType::u8_high) return {begin, begin + 1};
  if (field.type == RegisterType::u8_low) return {begin + 1, begin + kRegister_B};
  return {begin, begin + size_B};
}

/// The first register of `later` in which the other stands, too; as an address of the map.
std::optional<int> common_register(const RegisterField& earlier, const RegisterField& later,
                                   int stride) {
  if (earlier.function != later.function) return std::nullopt;
  for (int i = 0; i < later.count; ++i) {
    const Bytes own = bytes_of(later, i, stride);
    for (int j = 0; j < earlier.count; ++j) {
      const Bytes other = bytes_of(earlier, j, stride);
      const int common = std::max(own.begin, other.begin);
      if (common >= std::min(own.end, other.end)) continue;
      const int into_B = (common - place_of(later, stride)) / kRegister_B * kRegister_B;
      return later.address + into_B * stride / kRegister_B;
    }
  }
  return std::nullopt;
}

/// The lowest and the highest are found among the same cells, and a state may tell of the charger.
bool may_share(const RegisterField& one, const RegisterField& other) {
  const auto are = [&](BatteryField a, BatteryField b) {
    return (one.field == a && other.field == b) || (one.field == b && other.field == a);
  };
  if (one.type != other.type || one.order != other.order) return false;
  return are(BatteryField::min_cell_V, BatteryField::max_cell_V) ||
         are(BatteryField::flow, BatteryField::charger);
}

std::string entry(const char* list, std::size_t index) {
  return std::string(list) + "[" + std::to_string(index) + "]";
}

void fields(const MapFile& file, const RegisterMap& map, std::vector<MapFinding>& into) {
  for (std::size_t later = 1; later < map.fields.size(); ++later) {
    for (std::size_t earlier = 0; earlier < later; ++earlier) {
      if (may_share(map.fields[earlier], map.fields[later])) continue;
      const auto common = common_register(map.fields[earlier], map.fields[later], map.stride);
      if (!common) continue;
      const MapField& first = file.fields[earlier];
      into.push_back({"fields", later, "address",
                      "\"" + file.fields[later].field + "\" takes register " +
                          std::to_string(*common) + ", which is a part of \"" + first.field +
                          "\" (" + entry("fields", earlier) + ": " + first.type + " at " +
                          std::to_string(first.address) + ")",
                      ""});
      break;
    }
  }
}

void alarms(const RegisterMap& map, std::vector<MapFinding>& into) {
  const auto is_same = [](const RegisterAlarm& one, const RegisterAlarm& other) {
    return one.function == other.function && one.address == other.address && one.bit == other.bit;
  };
  for (std::size_t later = 1; later < map.alarms.size(); ++later) {
    const RegisterAlarm& alarm = map.alarms[later];
    const auto first = std::find_if(map.alarms.begin(), map.alarms.end(),
                                    [&](const auto& each) { return is_same(each, alarm); });
    const auto earlier = static_cast<std::size_t>(first - map.alarms.begin());
    if (earlier == later) continue;
    into.push_back({"alarms", later, "bit",
                    "\"" + alarm.text + "\" is bit " + std::to_string(alarm.bit) + " of register " +
                        std::to_string(alarm.address) + ", which is \"" + first->text + "\" (" +
                        entry("alarms", earlier) + ") already",
                    ""});
  }
}

constexpr int kFirstInput = 30001;
constexpr int kFirstHolding = 40001;
constexpr int kLast = 49999;

}  // namespace

std::vector<MapFinding> register_conflicts(const MapFile& file, const RegisterMap& map) {
  std::vector<MapFinding> found;
  fields(file, map, found);
  alarms(map, found);
  return found;
}

bool is_as_in_sheets(int address) {
  return address >= kFirstInput && address <= kLast;
}

MapFinding as_in_sheets(const char* list, std::size_t index, int address, std::size_t others) {
  const bool holding = address >= kFirstHolding;
  const auto number = std::to_string(address);
  char on_the_wire[8];
  std::snprintf(on_the_wire, sizeof on_the_wire, "0x%04X", static_cast<unsigned>(address) & 0xFFFF);
  const std::string alike = others == 0   ? ""
                            : others == 1 ? ", and 1 other is alike"
                                          : ", and " + std::to_string(others) + " others are alike";
  return {list, index, "address",
          "is " + number + alike + ": a map counts from 0, as on the wire; what a sheet calls " +
              number + " is most often register " +
              std::to_string(address - (holding ? kFirstHolding : kFirstInput)) + " of function " +
              (holding ? "3" : "4"),
          "of a device that really has register " + number + ": \"" + on_the_wire + "\""};
}

}  // namespace drover::config
