// The keys of a register map file: name, range and meaning of each, in one table per object.
//
// As fields.h: the same tables read a map and write its JSON schema. A visitor has address and
// numbers besides.
#pragma once

#include <string>
#include <vector>

#include "config/fields_engine.h"
#include "drover/register_map.h"

namespace drover::config {

/// One value as it stands in the file.
struct MapField {
  std::string field;
  int address = 0;
  int function = 0;
  int count = 1;
  int fitted = -1;
  std::string type = "u16";
  std::string word_order = "abcd";
  double scale = 1;
  double offset = 0;
  std::string unit;
  std::vector<double> range;
  std::vector<double> invalid;
  std::vector<std::string> states;
};

struct MapAlarm {
  int address = 0;
  int function = 0;
  int bit = 0;
  std::string level = "warning";
  std::string text;
};

struct MapFile {
  std::string name;
  std::string source;
  int unit = 1;
  int baud = 9600;
  int function = 3;
  int stride = 1;
  int max_registers = 125;
  int max_hole = 0;
  double gap_s = 0.1;
  double reply_s = 0.5;
  std::vector<MapField> fields;
  std::vector<MapAlarm> alarms;
};

inline const std::vector<std::string> kMapFields{
    "voltage",     "current",      "soc",   "remaining", "temperature", "switch_temperature",
    "lowest_cell", "highest_cell", "state", "charger"};
inline const std::vector<std::string> kMapTypes{"u8_high", "u8_low", "u16", "i16",
                                                "u32",     "i32",    "f32"};
inline const std::vector<std::string> kMapOrders{"abcd", "cdab", "badc", "dcba"};
inline const std::vector<std::string> kMapUnits{"",  "V",  "mV",  "A",    "mA",
                                                "%", "Ah", "mAh", "degC", "K"};
inline constexpr std::size_t kMostMapFields = 64;

template <class V>
void visit(V& v, MapField& c) {
  v.choice(
      "field", c.field, kMapFields,
      "what it means; several entries may fill one field. current: positive while the pack charges "
      "(of a device that counts the other way: its option current_sign); charger: any raw value "
      "but 0 means that a charger is connected",
      Presence::required);
  v.address("address", c.address, "register, as sent on the wire (from 0): 40 or \"0x28\"",
            Presence::required);
  v.integer("function", c.function, Range{0, 4}, "3 holding or 4 input registers; 0: the map's");
  v.integer("count", c.count, Range{1, 64},
            "neighbours of the same kind: the hottest, highest or lowest counts");
  v.address("fitted", c.fitted, "register that tells how many of the neighbours are there");
  v.choice("type", c.type, kMapTypes, "u8_high and u8_low are the halves of a register");
  v.choice("word_order", c.word_order, kMapOrders,
           "of a 32-bit value whose bytes are abcd; abcd: high register and high byte first");
  v.number("scale", c.scale, Range{-1e6, 1e6}, "value = raw * scale + offset");
  v.number("offset", c.offset, Range{-1e6, 1e6}, "in the unit");
  v.choice("unit", c.unit, kMapUnits, "of the value; empty: V, A, %, Ah or degC by the field");
  v.numbers("range", c.range, Count{2, 2}, Range{-1e6, 1e6},
            "[lowest, highest] that can be true, in V, A, %, Ah or degC; others are not used");
  v.numbers("invalid", c.invalid, Count{1, 8}, Range{-2147483648.0, 4294967295.0},
            "raw values that mean: not there");
  v.names("states", c.states, Count{1, 16},
          "field state only: idle, charging, discharging or unknown by raw value from 0");
}

template <class V>
void visit(V& v, MapAlarm& c) {
  v.address("address", c.address, "register, as sent on the wire", Presence::required);
  v.integer("function", c.function, Range{0, 4}, "3 holding or 4 input registers; 0: the map's");
  v.integer("bit", c.bit, Range{0, 15}, "from the least significant", Presence::required);
  v.choice("level", c.level, {"warning", "critical"},
           "critical: the pack will switch off, or has; a task ends");
  v.text("text", c.text, "what an operator reads", Presence::required);
}

template <class V>
void visit(V& v, MapFile& c) {
  v.text("name", c.name, "the device", Presence::required);
  v.text("source", c.source, "where the addresses come from", Presence::required);
  v.integer("unit", c.unit, Range{1, 247}, "its usual Modbus unit");
  v.integer("baud", c.baud, Range{1200, 921600}, "its usual baud rate");
  v.integer("function", c.function, Range{3, 4}, "3 holding or 4 input registers");
  v.integer("stride", c.stride, Range{1, 2},
            "addresses from one register to the next; 2 where addresses count bytes");
  v.integer("max_registers", c.max_registers, Range{2, 125}, "most in one request");
  v.integer("max_hole", c.max_hole, Range{0, 124},
            "longest gap between fields whose registers the device answers, too: it is read along");
  v.number("gap_s", c.gap_s, Range{0.005, 2}, "pause before a request");
  v.number("reply_s", c.reply_s, Range{0.05, 1}, "longest wait for a whole answer");
  v.list("fields", c.fields, Count{1, kMostMapFields}, "values", Presence::required);
  v.list("alarms", c.alarms, Count{0, kMaxRegisterAlarms}, "alarm bits");
}

}  // namespace drover::config
