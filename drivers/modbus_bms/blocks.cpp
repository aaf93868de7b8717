// Which registers to ask for in one go.
#include <algorithm>
#include <tuple>

#include "drivers/modbus_bms/codec.h"

namespace drover::modbus_bms {
namespace {

/// One value's registers: never split over two requests.
struct Piece {
  std::uint8_t function = 3;
  std::uint32_t address = 0;
  std::uint32_t registers = 1;
  friend bool operator<(const Piece& a, const Piece& b) {
    return std::tie(a.function, a.address) < std::tie(b.function, b.address);
  }
};

std::vector<Piece> pieces_of(const RegisterMap& map) {
  std::vector<Piece> pieces;
  for (const RegisterField& field : map.fields) {
    const std::uint32_t registers = registers_of(field.type);
    for (std::uint32_t i = 0; i < field.count; ++i)
      pieces.push_back({field.function, field.address + i * registers * map.stride, registers});
    if (field.count_address) pieces.push_back({field.function, *field.count_address, 1});
  }
  for (const RegisterAlarm& alarm : map.alarms)
    pieces.push_back({alarm.function, alarm.address, 1});
  std::sort(pieces.begin(), pieces.end());
  return pieces;
}

}  // namespace

std::vector<RegisterBlock> plan_blocks(const RegisterMap& map) {
  std::vector<RegisterBlock> blocks;
  for (const Piece& piece : pieces_of(map)) {
    if (!blocks.empty() && blocks.back().function == piece.function) {
      RegisterBlock& block = blocks.back();
      const std::uint32_t ahead = piece.address - block.address;
      const std::uint32_t from = ahead / map.stride;
      const std::uint32_t count = std::max<std::uint32_t>(block.count, from + piece.registers);
      const bool near = from <= static_cast<std::uint32_t>(block.count) + map.max_hole;
      if (ahead % map.stride == 0 && near && count <= map.max_count) {
        block.count = static_cast<std::uint16_t>(count);
        continue;
      }
    }
    blocks.push_back({piece.function, static_cast<std::uint16_t>(piece.address),
                      static_cast<std::uint16_t>(piece.registers)});
  }
  return blocks;
}

}  // namespace drover::modbus_bms
