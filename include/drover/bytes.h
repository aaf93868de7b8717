// Numbers in bytes, in either order. Callers have checked that the bytes are there.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <type_traits>

namespace drover {

static_assert(sizeof(float) == 4 && std::numeric_limits<float>::is_iec559);

/// The number of type T whose first byte is `bytes[at]`, lowest byte first.
template <std::integral T>
constexpr T load_le(std::span<const std::uint8_t> bytes, std::size_t at = 0) {
  std::array<std::uint8_t, sizeof(T)> own{};
  std::copy_n(bytes.subspan(at, sizeof(T)).data(), sizeof(T), own.data());
  if constexpr (std::endian::native == std::endian::big) std::reverse(own.begin(), own.end());
  return std::bit_cast<T>(own);
}

/// Highest byte first.
template <std::integral T>
constexpr T load_be(std::span<const std::uint8_t> bytes, std::size_t at = 0) {
  std::make_unsigned_t<T> value = 0;
  for (std::size_t i = 0; i < sizeof(T); ++i)
    value = static_cast<std::make_unsigned_t<T>>(static_cast<std::uint64_t>(value) << 8U |
                                                 bytes[at + i]);
  return static_cast<T>(value);
}

/// IEEE 754, lowest byte first.
constexpr float load_le_float(std::span<const std::uint8_t> bytes, std::size_t at = 0) {
  return std::bit_cast<float>(load_le<std::uint32_t>(bytes, at));
}

/// Lowest byte first, from `bytes[at]` on.
template <std::integral T>
constexpr void store_le(std::span<std::uint8_t> bytes, std::size_t at, T value) {
  const auto bits = static_cast<std::uint64_t>(static_cast<std::make_unsigned_t<T>>(value));
  for (std::size_t i = 0; i < sizeof(T); ++i)
    bytes[at + i] = static_cast<std::uint8_t>(bits >> (8 * i));
}

/// A word's bytes by their place in the number.
constexpr std::uint8_t low_byte(std::uint16_t word) {
  return static_cast<std::uint8_t>(word & 0xFFU);
}
constexpr std::uint8_t high_byte(std::uint16_t word) {
  return static_cast<std::uint8_t>(word >> 8U);
}

}  // namespace drover
