#include "drover/bytes.h"

#include <gtest/gtest.h>

#include <array>

namespace drover {
namespace {

constexpr std::array<std::uint8_t, 8> kBytes{0x01, 0x02, 0xFE, 0xFF, 0x00, 0x00, 0xC0, 0x3F};

TEST(Bytes, AreNumbersInEitherOrder) {
  EXPECT_EQ(load_le<std::uint16_t>(kBytes), 0x0201);
  EXPECT_EQ(load_be<std::uint16_t>(kBytes), 0x0102);
  EXPECT_EQ(load_le<std::uint32_t>(kBytes), 0xFFFE0201U);
  EXPECT_EQ(load_be<std::uint32_t>(kBytes), 0x0102FEFFU);
  EXPECT_EQ(load_le<std::uint64_t>(kBytes), 0x3FC00000FFFE0201U);
}

TEST(Bytes, AreSignedWhereTheTypeIs) {
  EXPECT_EQ(load_le<std::int16_t>(kBytes, 2), -2);
  EXPECT_EQ(load_be<std::int16_t>(kBytes, 2), -257);
  EXPECT_EQ(load_le<std::int8_t>(kBytes, 3), -1);
}

TEST(Bytes, AreFloats) {
  EXPECT_EQ(load_le_float(kBytes, 4), 1.5F);
}

TEST(Bytes, AreStoredAsTheyAreLoaded) {
  std::array<std::uint8_t, 6> bytes{};
  store_le<std::int16_t>(bytes, 0, -2);
  store_le<std::uint32_t>(bytes, 2, 0x12345678U);
  EXPECT_EQ(bytes, (std::array<std::uint8_t, 6>{0xFE, 0xFF, 0x78, 0x56, 0x34, 0x12}));
  EXPECT_EQ(low_byte(0x1234), 0x34);
  EXPECT_EQ(high_byte(0x1234), 0x12);
}

}  // namespace
}  // namespace drover
