// Registers to a battery's values and back, as a map says.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "drover/driver.h"
#include "drover/register_map.h"

namespace drover::modbus_bms {

/// Registers that stand one after the other, as they were read.
struct Run {
  std::uint8_t function = 3;
  std::uint16_t address = 0;
  std::span<const std::uint16_t> words;
};

struct Decoded {
  BatterySample sample;      ///< absent: not in the runs, not fitted, or absurd
  std::uint32_t absurd = 0;  ///< values outside their range
  Reason reason;             ///< the first absurd value in words
};

/// Fields whose registers are not in `runs` stay absent.
Decoded decode(const RegisterMap& map, std::span<const Run> runs);

/// Alarms in words, what is critical first; empty: none.
Reason alarm_words(const RegisterMap& map, std::uint64_t alarm_bits);

/// The register at `address`; nullptr when it was not read.
const std::uint16_t* find(const RegisterMap& map, std::span<const Run> runs, std::uint8_t function,
                          std::uint16_t address);

/// Raw value of one or two registers; absent when it is a float that is no number.
std::optional<double> raw_value(RegisterType type, WordOrder order, std::uint16_t first,
                                std::uint16_t second);
/// The other way: puts `raw`, clamped to what the type holds, into one or two registers. A byte
/// leaves the other byte of its register as it was.
void put_raw(RegisterType type, WordOrder order, double raw, std::uint16_t& first,
             std::uint16_t& second);

/// "voltage", "state of charge", ...
std::string_view field_text(BatteryField field);
std::string_view field_unit(BatteryField field);

/// What to ask for, in order: the registers that the map declares, merged across the holes that it
/// declares, no longer than the device answers. Nothing else is asked for: real packs refuse a
/// whole request for one register that they do not have.
std::vector<RegisterBlock> plan_blocks(const RegisterMap& map);

}  // namespace drover::modbus_bms
