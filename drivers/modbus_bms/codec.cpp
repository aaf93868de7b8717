// Registers to a battery's values and back, as a map says.
#include "drivers/modbus_bms/codec.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace drover::modbus_bms {
namespace {

std::uint16_t swapped(std::uint16_t word) {
  return static_cast<std::uint16_t>(word << 8U | word >> 8U);
}
bool bytes_swapped(WordOrder order) {
  return order == WordOrder::badc || order == WordOrder::dcba;
}
bool words_swapped(WordOrder order) {
  return order == WordOrder::cdab || order == WordOrder::dcba;
}

/// The value of the field among its neighbours, or of a second entry for the same field.
double combined(BatteryField field, double old, double value) {
  if (std::isnan(old)) return value;
  switch (field) {
    case BatteryField::temperature_degC:
    case BatteryField::mosfet_degC:
    case BatteryField::max_cell_V: return std::max(old, value);
    case BatteryField::min_cell_V: return std::min(old, value);
    default: return old;
  }
}

double* number_of(BatterySample& sample, BatteryField field) {
  switch (field) {
    case BatteryField::voltage_V: return &sample.voltage_V;
    case BatteryField::current_A: return &sample.current_A;
    case BatteryField::soc_percent: return &sample.soc_percent;
    case BatteryField::remaining_Ah: return &sample.remaining_Ah;
    case BatteryField::temperature_degC: return &sample.temperature_degC;
    case BatteryField::mosfet_degC: return &sample.mosfet_degC;
    case BatteryField::min_cell_V: return &sample.min_cell_V;
    case BatteryField::max_cell_V: return &sample.max_cell_V;
    case BatteryField::flow:
    case BatteryField::charger: break;
  }
  return nullptr;
}

class Decoder {
 public:
  Decoder(const RegisterMap& map, std::span<const Run> runs, Decoded& out)
      : map_(map), runs_(runs), out_(out) {}

  void field(const RegisterField& field) {
    std::uint32_t count = field.count;
    if (field.count_address) {
      const std::uint16_t* fitted = find(map_, runs_, field.function, *field.count_address);
      if (fitted == nullptr) return;
      if (*fitted > field.count) return absurd(field, *fitted, "fitted");
      count = *fitted;
    }
    const auto step = static_cast<std::uint32_t>(registers_of(field.type) * map_.stride);
    for (std::uint32_t i = 0; i < count; ++i) {
      const auto raw = raw_at(field, field.address + i * step);
      if (raw) take(field, *raw);
    }
  }

  void alarms() {
    for (std::size_t i = 0; i < map_.alarms.size() && i < kMaxRegisterAlarms; ++i) {
      const RegisterAlarm& alarm = map_.alarms[i];
      const std::uint16_t* word = find(map_, runs_, alarm.function, alarm.address);
      if (word == nullptr || (*word >> alarm.bit & 1U) == 0) continue;
      const BatteryAlarm says = alarm.critical ? BatteryAlarm::critical : BatteryAlarm::warning;
      out_.sample.alarm = std::max(out_.sample.alarm, says);
      out_.sample.alarm_bits |= std::uint64_t{1} << i;
    }
  }

 private:
  std::optional<double> raw_at(const RegisterField& field, std::uint32_t address) const {
    if (address > 0xFFFF) return std::nullopt;
    const auto* first = find(map_, runs_, field.function, static_cast<std::uint16_t>(address));
    if (first == nullptr) return std::nullopt;
    std::uint16_t second = 0;
    if (registers_of(field.type) == 2) {
      const std::uint32_t next = address + map_.stride;
      const auto* word = next > 0xFFFF
                             ? nullptr
                             : find(map_, runs_, field.function, static_cast<std::uint16_t>(next));
      if (word == nullptr) return std::nullopt;
      second = *word;
    }
    return raw_value(field.type, field.order, *first, second);
  }

  void take(const RegisterField& field, double raw) {
    for (const std::int64_t invalid : field.invalid)
      if (raw == static_cast<double>(invalid)) return;
    BatterySample& sample = out_.sample;
    if (field.field == BatteryField::charger) {
      sample.charger_connected = sample.charger_connected || raw != 0;
    } else if (field.field == BatteryField::flow) {
      if (raw < 0 || raw >= static_cast<double>(field.flows.size()))
        return absurd(field, raw, field_unit(field.field));
      sample.flow = field.flows[static_cast<std::size_t>(raw)];
    } else {
      const double value = raw * field.scale + field.offset;
      if (!(value >= field.min && value <= field.max))
        return absurd(field, value, field_unit(field.field));
      double& number = *number_of(sample, field.field);
      number = combined(field.field, number, value);
    }
  }

  void absurd(const RegisterField& field, double value, std::string_view unit) {
    if (out_.absurd++ > 0) return;
    const auto name = field_text(field.field);
    out_.reason.format("%.*s of %.6g%s%.*s cannot be", static_cast<int>(name.size()), name.data(),
                       value, unit.empty() ? "" : " ", static_cast<int>(unit.size()), unit.data());
  }

  const RegisterMap& map_;
  std::span<const Run> runs_;
  Decoded& out_;
};

}  // namespace

Reason alarm_words(const RegisterMap& map, std::uint64_t alarm_bits) {
  Reason words;
  for (const bool critical : {true, false}) {
    for (std::size_t i = 0; i < map.alarms.size() && i < kMaxRegisterAlarms; ++i) {
      const RegisterAlarm& alarm = map.alarms[i];
      if (alarm.critical != critical || (alarm_bits >> i & 1U) == 0) continue;
      if (!words.empty()) words.append(", ");
      words.append(alarm.text);
    }
  }
  return words;
}

const std::uint16_t* find(const RegisterMap& map, std::span<const Run> runs, std::uint8_t function,
                          std::uint16_t address) {
  for (const Run& run : runs) {
    if (run.function != function || address < run.address) continue;
    const auto ahead = static_cast<std::uint16_t>(address - run.address);
    if (ahead % map.stride != 0 || ahead / map.stride >= run.words.size()) continue;
    return &run.words[ahead / map.stride];
  }
  return nullptr;
}

Decoded decode(const RegisterMap& map, std::span<const Run> runs) {
  Decoded decoded;
  Decoder decoder(map, runs, decoded);
  for (const RegisterField& field : map.fields) decoder.field(field);
  decoder.alarms();
  return decoded;
}

std::optional<double> raw_value(RegisterType type, WordOrder order, std::uint16_t first,
                                std::uint16_t second) {
  if (bytes_swapped(order)) {
    first = swapped(first);
    second = swapped(second);
  }
  if (words_swapped(order) && registers_of(type) == 2) std::swap(first, second);
  const std::uint32_t both = std::uint32_t{first} << 16U | second;
  switch (type) {
    case RegisterType::u8_high: return first >> 8U;
    case RegisterType::u8_low: return first & 0xFFU;
    case RegisterType::u16: return first;
    case RegisterType::i16: return static_cast<std::int16_t>(first);
    case RegisterType::u32: return both;
    case RegisterType::i32: return static_cast<std::int32_t>(both);
    case RegisterType::f32: {
      const double value = std::bit_cast<float>(both);
      return std::isfinite(value) ? std::optional(value) : std::nullopt;
    }
  }
  return std::nullopt;
}

void put_raw(RegisterType type, WordOrder order, double raw, std::uint16_t& first,
             std::uint16_t& second) {
  const auto whole = [raw](double min, double max) {
    return static_cast<std::int64_t>(std::llround(std::clamp(raw, min, max)));
  };
  std::uint16_t high = bytes_swapped(order) ? swapped(first) : first;
  std::uint16_t low = 0;
  std::uint32_t both = 0;
  switch (type) {
    case RegisterType::u8_high:
      high = static_cast<std::uint16_t>((high & 0xFF) | whole(0, 255) << 8U);
      break;
    case RegisterType::u8_low:
      high = static_cast<std::uint16_t>((high & 0xFF00) | whole(0, 255));
      break;
    case RegisterType::u16: high = static_cast<std::uint16_t>(whole(0, 65535)); break;
    case RegisterType::i16: high = static_cast<std::uint16_t>(whole(-32768, 32767)); break;
    case RegisterType::u32: both = static_cast<std::uint32_t>(whole(0, 4294967295.0)); break;
    case RegisterType::i32:
      both = static_cast<std::uint32_t>(whole(-2147483648.0, 2147483647.0));
      break;
    case RegisterType::f32: both = std::bit_cast<std::uint32_t>(static_cast<float>(raw)); break;
  }
  if (registers_of(type) == 2) {
    high = static_cast<std::uint16_t>(both >> 16U);
    low = static_cast<std::uint16_t>(both);
    if (words_swapped(order)) std::swap(high, low);
    second = bytes_swapped(order) ? swapped(low) : low;
  }
  first = bytes_swapped(order) ? swapped(high) : high;
}

std::string_view field_text(BatteryField field) {
  switch (field) {
    case BatteryField::voltage_V: return "voltage";
    case BatteryField::current_A: return "current";
    case BatteryField::soc_percent: return "state of charge";
    case BatteryField::remaining_Ah: return "remaining charge";
    case BatteryField::temperature_degC: return "cell temperature";
    case BatteryField::mosfet_degC: return "switch temperature";
    case BatteryField::min_cell_V: return "lowest cell";
    case BatteryField::max_cell_V: return "highest cell";
    case BatteryField::flow: return "state";
    case BatteryField::charger: return "charger";
  }
  return "value";
}

std::string_view field_unit(BatteryField field) {
  switch (field) {
    case BatteryField::voltage_V:
    case BatteryField::min_cell_V:
    case BatteryField::max_cell_V: return "V";
    case BatteryField::current_A: return "A";
    case BatteryField::soc_percent: return "%";
    case BatteryField::remaining_Ah: return "Ah";
    case BatteryField::temperature_degC:
    case BatteryField::mosfet_degC: return "C";
    case BatteryField::flow:
    case BatteryField::charger: return "";
  }
  return "";
}

}  // namespace drover::modbus_bms
