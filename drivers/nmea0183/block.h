// Many bytes of text looked at in one step: most of a stream has no mark in it.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>

namespace drover::nmea0183 {

/// Sixteen bytes, of which compilers know how to compare all at once (GCC and clang, on every
/// machine). A comparison gives -1 in each byte of which it is true. Bytes above 0x7F are negative.
using Block = signed char __attribute__((vector_size(16)));
inline constexpr std::size_t kBlock = sizeof(Block);

inline Block load_block(const void* text) {
  Block block;
  std::memcpy(&block, text, kBlock);
  return block;
}

/// -1 in the first `count` bytes, 0 to 16, and 0 in the others.
inline Block first_of_block(std::size_t count) {
  static constexpr auto kOnes = [] {
    std::array<signed char, 2 * kBlock> ones{};
    for (std::size_t i = 0; i < kBlock; ++i) ones[i] = -1;
    return ones;
  }();
  return load_block(&kOnes[kBlock - count]);
}

/// Eight bytes; the first is the lowest, whatever the machine.
inline std::uint64_t load_eight(const void* text) {
  std::uint64_t eight = 0;
  std::memcpy(&eight, text, sizeof eight);
  return std::endian::native == std::endian::big ? __builtin_bswap64(eight) : eight;
}

inline std::array<std::uint64_t, 2> halves_of(Block block) {
  std::array<unsigned char, kBlock> bytes{};
  std::memcpy(bytes.data(), &block, kBlock);
  return {load_eight(bytes.data()), load_eight(&bytes[kBlock / 2])};
}

/// How many bytes come before the first that is -1, all others being 0; 16: none is.
inline std::size_t before_first(Block marks) {
  const auto [low, high] = halves_of(marks);
  if (low != 0) return static_cast<std::size_t>(std::countr_zero(low)) / 8;
  return 8 + static_cast<std::size_t>(std::countr_zero(high)) / 8;
}

/// Calls `use` with the place of each byte that is -1, in their order.
template <class Use>
void each_mark(Block marks, const Use& use) {
  std::size_t begin = 0;
  for (std::uint64_t half : halves_of(marks)) {
    constexpr std::uint64_t kLowestBits = 0x0101010101010101;
    for (half &= kLowestBits; half != 0; half &= half - 1)
      use(begin + static_cast<std::size_t>(std::countr_zero(half)) / 8);
    begin += kBlock / 2;
  }
}

/// XOR of all sixteen.
inline std::uint8_t folded(Block block) {
  const auto [low, high] = halves_of(block);
  std::uint64_t sum = low ^ high;
  for (const unsigned shift : {32U, 16U, 8U}) sum ^= sum >> shift;
  return static_cast<std::uint8_t>(sum);
}

}  // namespace drover::nmea0183
