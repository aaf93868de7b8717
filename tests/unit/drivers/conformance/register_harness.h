// Register drivers: the maps that come with them, and exchanges of Modbus RTU.
#pragma once

#include <algorithm>
#include <filesystem>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "config/register_map.h"
#include "drover/driver.h"

namespace drover::test {

inline RegisterMap read_map(const std::string& name) {
  const auto loaded = config::load_register_map(DROVER_SOURCE_DIR "/config/maps/" + name);
  for (const auto& problem : loaded.problems) throw std::runtime_error(problem.text(""));
  return loaded.map;
}

inline std::vector<std::string> map_names() {
  std::vector<std::string> names;
  for (const auto& file : std::filesystem::directory_iterator(DROVER_SOURCE_DIR "/config/maps"))
    if (!file.path().string().ends_with(".schema.json")) names.push_back(file.path().filename());
  std::sort(names.begin(), names.end());
  return names;
}

/// A read request and its answer.
struct Exchange {
  std::uint8_t function = 3;
  std::uint16_t address = 0;
  std::vector<std::uint16_t> words;
};

inline std::uint16_t crc16(std::span<const std::uint8_t> bytes) {
  unsigned crc = 0xFFFF;
  for (const std::uint8_t byte : bytes) {
    crc ^= byte;
    for (int i = 0; i < 8; ++i) crc = (crc & 1U) != 0 ? crc >> 1U ^ 0xA001U : crc >> 1U;
  }
  return static_cast<std::uint16_t>(crc);
}

/// Throws std::invalid_argument when it is none, or a checksum is wrong.
inline Exchange read_exchange(std::span<const std::uint8_t> bytes) {
  const auto word = [&](std::size_t at) {
    return static_cast<std::uint16_t>(bytes[at] << 8U | bytes[at + 1]);
  };
  if (bytes.size() < 13 || bytes.size() != 13U + 2U * word(4))
    throw std::invalid_argument("request and answer do not belong together");
  for (const auto frame : {bytes.first(8), bytes.subspan(8)}) {
    const auto crc = crc16(frame.first(frame.size() - 2));
    if (frame[frame.size() - 2] != (crc & 0xFF) || frame[frame.size() - 1] != crc >> 8U)
      throw std::invalid_argument("wrong checksum");
  }
  if (bytes[8] != bytes[0] || bytes[9] != bytes[1] || bytes[10] != 2 * word(4))
    throw std::invalid_argument("the answer is to something else");
  Exchange exchange{bytes[1], word(2), {}};
  for (std::size_t at = 11; at + 2 < bytes.size(); at += 2) exchange.words.push_back(word(at));
  return exchange;
}

/// The map with only what lies inside the exchange's registers, read in one go.
inline RegisterMap map_inside(const RegisterMap& map, const Exchange& exchange) {
  const auto inside = [&](std::uint8_t function, int address, int registers) {
    const auto end = exchange.address + static_cast<int>(exchange.words.size()) * map.stride;
    return function == exchange.function && address >= exchange.address &&
           address + registers * map.stride <= end;
  };
  RegisterMap part = map;
  part.max_hole = part.max_count = 125;
  std::erase_if(part.fields, [&](const RegisterField& field) {
    return !inside(field.function, field.address, field.count * registers_of(field.type)) ||
           (field.count_address && !inside(field.function, *field.count_address, 1));
  });
  std::erase_if(part.alarms, [&](const RegisterAlarm& alarm) {
    return !inside(alarm.function, alarm.address, 1);
  });
  return part;
}

/// Gives the driver the registers it asks for, from the exchange.
inline void answer(RegisterFace& driver, int stride, const Exchange& exchange, Time now,
                   DriverOut& out) {
  const auto blocks = driver.blocks();
  const std::span<const std::uint16_t> words(exchange.words);
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    const auto ahead = static_cast<std::size_t>((blocks[i].address - exchange.address) / stride);
    driver.on_registers(i, words.subspan(ahead, blocks[i].count), now, out);
  }
}

}  // namespace drover::test
