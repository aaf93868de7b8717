#include "mission/wire_cubemars_mit.h"

#include <algorithm>

namespace drover::mission::cubemars_mit {

std::string forbidden(const CanFrame& frame) {
  if (frame.extended || frame.remote || frame.fd || frame.len != 8)
    return "no frame of eight bytes with eleven bits of id";
  if (frame.id < 1 || frame.id > 3) return "an id of nobody on this bus";
  const auto* const seven = frame.data.begin() + 7;
  if (std::any_of(frame.data.begin(), seven, [](std::uint8_t byte) { return byte != 0xFF; }))
    return "";  // a set point, or an answer
  return *seven == 0xFC || *seven == 0xFD ? "" : "moves a motor's zero";
}

}  // namespace drover::mission::cubemars_mit
