// A device's registers as data: what stands where, of what type and unit, and what it means.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace drover {

/// Order of the bytes ABCD of a 32-bit value in its two registers.
enum class WordOrder : std::uint8_t { abcd, cdab, badc, dcba };
enum class RegisterType : std::uint8_t { u8_high, u8_low, u16, i16, u32, i32, f32 };

/// Numbers that a map may fill; the units are BatterySample's.
enum class BatteryField : std::uint8_t {
  voltage_V,
  current_A,
  soc_percent,
  remaining_Ah,
  temperature_degC,
  min_cell_V,
  max_cell_V,
  flow,
  charger,
  alarms,
};

/// value = raw * scale + offset, unless raw is one of `invalid`.
struct RegisterField {
  BatteryField field = BatteryField::voltage_V;
  std::uint16_t address = 0;
  std::uint16_t count = 1;  ///< neighbours of the same kind, of which the extreme one counts
  RegisterType type = RegisterType::u16;
  WordOrder order = WordOrder::abcd;
  double scale = 1;
  double offset = 0;
  double min = 0;  ///< values outside [min, max] are absurd: not used, and counted
  double max = 0;
  std::vector<std::int64_t> invalid;
};

/// One bit of an alarm word.
struct RegisterAlarm {
  std::uint16_t address = 0;
  std::uint8_t bit = 0;
  bool critical = false;
  std::string text;
};

struct RegisterMap {
  std::string name;
  std::uint8_t function = 3;
  std::uint8_t stride = 1;  ///< addresses from one register to the next
  std::uint16_t max_count = 125;
  double gap_s = 0.1;    ///< pause between two requests
  double reply_s = 0.5;  ///< longest wait for a whole answer
  std::vector<RegisterField> fields;
  std::vector<RegisterAlarm> alarms;
};

}  // namespace drover
