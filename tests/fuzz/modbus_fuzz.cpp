// Any bytes as the answer of a Modbus device: no crash, no answer that was not asked for, and no
// absurd value of a battery.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <span>
#include <vector>

#include "config/register_map.h"
#include "drivers/modbus_bms/driver.h"
#include "drivers/modbus_bms/entry.h"
#include "drover/checksum.h"
#include "link/modbus_frame.h"

namespace {

using namespace drover;

constexpr std::size_t kMaxInput = 600;
const Time kStart{std::chrono::seconds(100)};

/// Every type, both ends of the word order, neighbours, a count and an alarm.
constexpr std::string_view kMap = R"({
  "name": "fuzz", "source": "none", "max_registers": 24,
  "fields": [
    {"field": "voltage", "address": 0, "scale": 0.1},
    {"field": "current", "address": 1, "type": "i32", "unit": "mA"},
    {"field": "soc", "address": 3, "type": "u8_low"},
    {"field": "remaining", "address": 4, "type": "f32", "word_order": "cdab"},
    {"field": "temperature", "address": 6, "count": 4, "fitted": 10, "offset": -40},
    {"field": "lowest_cell", "address": 11, "count": 4, "unit": "mV", "invalid": [0]},
    {"field": "highest_cell", "address": 11, "count": 4, "unit": "mV", "invalid": [0]},
    {"field": "switch_temperature", "address": 15, "type": "i16", "unit": "K", "scale": 0.1},
    {"field": "state", "address": 16, "states": ["idle", "charging", "discharging"]},
    {"field": "charger", "address": 17, "type": "u8_high"}
  ],
  "alarms": [
    {"address": 18, "bit": 0, "text": "first"},
    {"address": 18, "bit": 15, "level": "critical", "text": "second"}
  ]
})";

void require(bool holds) {
  if (!holds) std::abort();
}
bool inside(double value, double min, double max) {
  return std::isnan(value) || (value >= min && value <= max);
}

void decode(std::span<const std::uint16_t> words) {
  static const RegisterMap map = config::parse_register_map(kMap).map;
  static const Options options(kModbusBmsEntry.options);
  modbus_bms::ModbusBmsDriver driver(modbus_bms::read_settings(options), map);
  require(driver.blocks().size() == 1 && driver.blocks()[0].count == words.size());
  DriverOut out;
  driver.on_registers(0, words, kStart, out);
  require(out.measurements.size() == 1 && out.overflows == 0);
  const auto& s = std::get<BatterySample>(out.measurements[0].value);
  require(inside(s.voltage_V, 1, 1000) && inside(s.current_A, -2000, 2000));
  require(inside(s.soc_percent, 0, 100) && inside(s.remaining_Ah, 0, 10000));
  require(inside(s.temperature_degC, -40, 125) && inside(s.mosfet_degC, -40, 200));
  require(inside(s.min_cell_V, 0.5, 5) && inside(s.max_cell_V, 0.5, 5));
  require(std::isnan(s.min_cell_V) || s.min_cell_V <= s.max_cell_V);
  require((s.alarm == BatteryAlarm::none) == (s.alarm_bits == 0));
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size < 3 || size > kMaxInput) return 0;
  // The first byte: over TCP or not, and whether the checksum at the end is made good.
  const bool tcp = (data[0] & 1U) != 0;
  constexpr std::uint8_t kUnit = 0xD2;
  constexpr std::uint16_t kTransaction = 0x0102;
  constexpr RegisterBlock kBlock{3, 0, 19};
  std::vector<std::uint8_t> bytes(data + 1, data + size);
  if ((data[0] & 2U) != 0 && !tcp) {
    const auto crc = modbus_crc(bytes);
    bytes.push_back(static_cast<std::uint8_t>(crc));
    bytes.push_back(static_cast<std::uint8_t>(crc >> 8U));
  }
  const auto find = [&](std::span<const std::uint8_t> part) {
    return tcp ? link::find_tcp_answer(part, kTransaction, kUnit, kBlock)
               : link::find_rtu_answer(part, kUnit, kBlock);
  };
  const auto found = find(bytes);
  if (found.answer != link::Answer::good) return 0;
  require(found.data >= 3 && found.data + 2 * kBlock.count <= bytes.size());
  require(bytes[found.data - 1] == 2 * kBlock.count && bytes[found.data - 2] == kBlock.function &&
          bytes[found.data - 3] == kUnit);
  // What came behind it changes nothing, and without its last byte it is no answer.
  const std::size_t end = found.data + 2 * kBlock.count + (tcp ? 0 : 2);
  require(find({bytes.data(), end}).data == found.data);
  require(find({bytes.data(), end - 1}).answer != link::Answer::good);
  std::vector<std::uint16_t> words;
  for (std::size_t i = 0; i < kBlock.count; ++i)
    words.push_back(static_cast<std::uint16_t>(bytes[found.data + 2 * i] << 8U |
                                               bytes[found.data + 2 * i + 1]));
  decode(words);
  return 0;
}
