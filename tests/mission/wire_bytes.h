// What the readers of CANopen frames on the wire share. It shares nothing with a driver on purpose.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <iterator>

#include "drover/can_frame.h"

namespace drover::mission {

/// `size` bytes from `at` on, the lowest first.
inline std::uint32_t number(const CanFrame& frame, std::size_t at, std::size_t size) {
  std::uint32_t value = 0;
  for (std::size_t i = size; i > 0; --i) value = value << 8U | frame.data[at + i - 1];
  return value;
}

template <class List>
bool has(const List& list, std::uint32_t value) {
  return std::find(std::begin(list), std::end(list), value) != std::end(list);
}

}  // namespace drover::mission
