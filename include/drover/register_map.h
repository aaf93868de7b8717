// A device's registers as data: what stands where, of what type and unit, and what it means.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "drover/measurement.h"

namespace drover {

/// Order of the bytes ABCD of a 32-bit value in its two registers; 16-bit values obey the order of
/// the bytes inside a register.
enum class WordOrder : std::uint8_t { abcd, cdab, badc, dcba };
enum class RegisterType : std::uint8_t { u8_high, u8_low, u16, i16, u32, i32, f32 };

/// What a map may fill; the units are BatterySample's.
enum class BatteryField : std::uint8_t {
  voltage_V,
  current_A,
  soc_percent,
  remaining_Ah,
  temperature_degC,
  mosfet_degC,
  min_cell_V,
  max_cell_V,
  flow,     ///< raw value is an index into `flows`
  charger,  ///< any raw value but 0: a charger is connected
};
inline constexpr std::size_t kBatteryFieldCount = 10;

/// value = raw * scale + offset, unless raw is one of `invalid`. Several entries may fill one
/// field: the hottest, highest or lowest counts where that makes sense, otherwise the first.
struct RegisterField {
  BatteryField field = BatteryField::voltage_V;
  std::uint8_t function = 3;
  std::uint16_t address = 0;
  std::uint16_t count = 1;  ///< neighbours of the same kind, of which the extreme one counts
  /// Register (u16) that tells how many of the neighbours are fitted.
  std::optional<std::uint16_t> count_address;
  RegisterType type = RegisterType::u16;
  WordOrder order = WordOrder::abcd;
  double scale = 1;
  double offset = 0;
  double min = 0;  ///< values outside [min, max] are absurd: not used, and counted
  double max = 0;
  std::vector<std::int64_t> invalid;
  std::vector<BatteryFlow> flows;
};

/// One bit of an alarm register. Its number in BatterySample::alarm_bits is its place in the list.
struct RegisterAlarm {
  std::uint8_t function = 3;
  std::uint16_t address = 0;
  std::uint8_t bit = 0;  ///< 0 to 15, from the least significant
  bool critical = false;
  std::string text;
};
inline constexpr std::size_t kMaxRegisterAlarms = 64;

struct RegisterMap {
  std::string name;
  std::uint8_t unit = 1;    ///< the device's usual address
  int baud = 9600;          ///< its usual speed
  std::uint8_t stride = 1;  ///< addresses from one register to the next
  std::uint16_t max_count = 125;
  std::uint16_t max_hole = 0;  ///< longest gap between fields that the device answers, too
  double gap_s = 0.1;          ///< pause between two requests
  double reply_s = 0.5;        ///< longest wait for a whole answer
  std::vector<RegisterField> fields;
  std::vector<RegisterAlarm> alarms;
};

/// Registers that one value takes.
constexpr std::uint16_t registers_of(RegisterType type) {
  return type == RegisterType::u32 || type == RegisterType::i32 || type == RegisterType::f32 ? 2
                                                                                             : 1;
}

}  // namespace drover
