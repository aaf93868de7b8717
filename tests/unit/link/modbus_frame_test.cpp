#include "link/modbus_frame.h"

#include <gtest/gtest.h>

#include <vector>

#include "drover/checksum.h"

namespace drover::link {
namespace {

using Bytes = std::vector<std::uint8_t>;

constexpr RegisterBlock kBlock{3, 0x28, 3};
constexpr std::uint8_t kUnit = 0xD2;

/// Voltage, current and state of charge of a Daly pack.
Bytes good_answer() {
  return {0xD2, 0x03, 0x06, 0x02, 0x12, 0x74, 0xD7, 0x03, 0x60, 0xBA, 0xB1};
}
Bytes request() {
  const auto frame = rtu_read_request(kUnit, kBlock);
  return {frame.begin(), frame.end()};
}
Bytes sealed(Bytes frame) {
  const auto crc = modbus_crc(frame);
  frame.push_back(static_cast<std::uint8_t>(crc));
  frame.push_back(static_cast<std::uint8_t>(crc >> 8U));
  return frame;
}
Bytes joined(std::initializer_list<Bytes> parts) {
  Bytes all;
  for (const Bytes& part : parts) all.insert(all.end(), part.begin(), part.end());
  return all;
}
FoundAnswer find(const Bytes& bytes) {
  return find_rtu_answer(bytes, kUnit, kBlock);
}

TEST(ModbusRtu, AsksAsTheDeviceKnowsIt) {
  EXPECT_EQ(request(), (Bytes{0xD2, 0x03, 0x00, 0x28, 0x00, 0x03, 0x96, 0x60}));
}

TEST(ModbusRtu, FindsTheAnswer) {
  const auto found = find(good_answer());
  EXPECT_EQ(found.answer, Answer::good);
  EXPECT_EQ(found.data, 3U);
}

TEST(ModbusRtu, BelievesNoAnswerWithAnyBitTurned) {
  for (std::size_t bit = 0; bit < 8 * good_answer().size(); ++bit) {
    Bytes bytes = good_answer();
    bytes[bit / 8] ^= static_cast<std::uint8_t>(1U << bit % 8);
    EXPECT_NE(find(bytes).answer, Answer::good) << bit;
    EXPECT_NE(find(bytes).answer, Answer::exception) << bit;
  }
}

TEST(ModbusRtu, WaitsForTheWholeAnswer) {
  EXPECT_EQ(find({}).answer, Answer::nothing);
  for (std::size_t size = 1; size < good_answer().size(); ++size) {
    const Bytes all = good_answer();
    EXPECT_EQ(find(Bytes(all.begin(), all.begin() + static_cast<long>(size))).answer,
              Answer::incomplete);
  }
}

TEST(ModbusRtu, KnowsAnotherUnitsAnswer) {
  EXPECT_EQ(find(sealed({0xD3, 0x03, 0x06, 2, 0x12, 0x74, 0xD7, 3, 0x60})).answer,
            Answer::wrong_unit);
}

TEST(ModbusRtu, BelievesNoAnswerOfAnotherLengthOrFunction) {
  EXPECT_NE(find(sealed({0xD2, 0x03, 0x04, 2, 0x12, 0x74, 0xD7})).answer, Answer::good);
  EXPECT_NE(find(sealed({0xD2, 0x04, 0x06, 2, 0x12, 0x74, 0xD7, 3, 0x60})).answer, Answer::good);
}

TEST(ModbusRtu, TakesNoEchoForAnAnswer) {
  const auto alone = find(request());
  EXPECT_EQ(alone.answer, Answer::nothing);
  EXPECT_EQ(alone.echoes, 1U);
  const auto both = find(joined({request(), good_answer()}));
  EXPECT_EQ(both.answer, Answer::good);
  EXPECT_EQ(both.data, 11U);
}

TEST(ModbusRtu, FindsTheAnswerBehindNoise) {
  const Bytes noise(300, 0x55);
  EXPECT_EQ(find(joined({{0x00, 0xFF, 0xD2}, good_answer()})).answer, Answer::good);
  EXPECT_EQ(find(joined({noise, good_answer()})).answer, Answer::good);
  EXPECT_NE(find(noise).answer, Answer::good);
}

TEST(ModbusRtu, ReadsTheException) {
  const auto found = find(sealed({0xD2, 0x83, 0x02}));
  EXPECT_EQ(found.answer, Answer::exception);
  EXPECT_EQ(found.exception, 2);
  EXPECT_EQ(find({0xD2, 0x83, 0x02, 0, 0}).answer, Answer::damaged);
}

constexpr RegisterBlock kTcpBlock{3, 0, 2};

FoundAnswer find_tcp(const Bytes& bytes) {
  return find_tcp_answer(bytes, 1, 1, kTcpBlock);
}

TEST(ModbusTcp, AsksAndFindsAsTheStandardSays) {
  const auto frame = tcp_read_request(1, 1, kTcpBlock);
  EXPECT_EQ(Bytes(frame.begin(), frame.end()), (Bytes{0, 1, 0, 0, 0, 6, 1, 3, 0, 0, 0, 2}));
  const auto found = find_tcp({0, 1, 0, 0, 0, 7, 1, 3, 4, 9, 0x0A, 0, 0});
  EXPECT_EQ(found.answer, Answer::good);
  EXPECT_EQ(found.data, 9U);
}

TEST(ModbusTcp, SkipsALateAnswerToAnotherRequest) {
  const Bytes late{0, 0, 0, 0, 0, 7, 1, 3, 4, 7, 7, 7, 7};
  EXPECT_EQ(find_tcp(late).answer, Answer::incomplete);
  const auto found = find_tcp(joined({late, {0, 1, 0, 0, 0, 7, 1, 3, 4, 9, 0x0A, 0, 0}}));
  EXPECT_EQ(found.answer, Answer::good);
  EXPECT_EQ(found.data, 22U);
}

TEST(ModbusTcp, RefusesAnotherUnitProtocolLengthOrFunction) {
  EXPECT_EQ(find_tcp({0, 1, 0, 0, 0, 7, 2, 3, 4, 9, 9, 0, 0}).answer, Answer::wrong_unit);
  EXPECT_EQ(find_tcp({0, 1, 0, 1, 0, 7, 1, 3, 4, 9, 9, 0, 0}).answer, Answer::damaged);
  EXPECT_EQ(find_tcp({0, 1, 0, 0, 0, 5, 1, 3, 2, 9, 9}).answer, Answer::damaged);
  EXPECT_EQ(find_tcp({0, 1, 0, 0, 0, 7, 1, 4, 4, 9, 9, 0, 0}).answer, Answer::damaged);
  EXPECT_EQ(find_tcp({0, 1, 0, 0, 0xFF, 7}).answer, Answer::incomplete);
  const auto refused = find_tcp({0, 1, 0, 0, 0, 3, 1, 0x83, 0x0B});
  EXPECT_EQ(refused.answer, Answer::exception);
  EXPECT_EQ(refused.exception, 11);
}

}  // namespace
}  // namespace drover::link
