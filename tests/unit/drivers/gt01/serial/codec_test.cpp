#include "drivers/gt01/serial/codec.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "drivers/gt01/serial/framer.h"

namespace drover::gt01::serial {
namespace {

using Bytes = std::vector<std::uint8_t>;

// The maker's examples.
const Bytes kTwist{0xED, 0xDE, 0, 0, 0x02, 0x12, 0, 0, 0xC8, 0, 0, 0, 0, 0, 0xA7, 0x02, 0xBD, 0xBC};
const Bytes kWheels{0xED, 0xDE, 0, 0, 0x02, 0x12, 1,    0,    0xC8,
                    0,    0xC1, 0, 0, 0,    0x69, 0x03, 0xBD, 0xBC};
const Bytes kStop{0xED, 0xDE, 0, 0, 0x03, 0x0C, 1, 0, 0xDB, 0x01, 0xBD, 0xBC};
const Bytes kChassis{0xED, 0xDE, 0,    0, 0x89, 0x12, 0xD5, 0x02, 0xF4, 0x01,
                     0xAA, 0,    0x1E, 0, 0xE8, 0x03, 0xE5, 0x05, 0xBD, 0xBC};

Bytes of(const Packet& packet) {
  return {packet.begin(), packet.end()};
}

/// `data` as a packet of this id, as the documents describe one.
Bytes whole(std::uint8_t id, const Bytes& data) {
  Bytes bytes{0xED, 0xDE, 7, 0, id, static_cast<std::uint8_t>(data.size() + 10)};
  bytes.insert(bytes.end(), data.begin(), data.end());
  unsigned sum = 0;
  for (const auto byte : bytes) sum += byte;
  for (const unsigned byte : {sum & 0xFFU, sum >> 8U, 0xBDU, 0xBCU})
    bytes.push_back(static_cast<std::uint8_t>(byte));
  return bytes;
}

const Bytes kUploadData{0xFE, 0x01, 0x08, 0x04, 0, 0xC8, 0,    0x9C, 0xFF,
                        0xC8, 0,    0xC1, 0,    1, 0,    0xFF, 0xFF};

TEST(Gt01Serial, WritesTheMakersExamples) {
  EXPECT_EQ(of(motion(0, {0.2, 0})), kTwist);
  EXPECT_EQ(of(estop(0, true)), kStop);
}

TEST(Gt01Serial, CountsItsPacketsInTheirSequence) {
  EXPECT_EQ(of(motion(0x1234, {0, 0}))[2], 0x34);
  EXPECT_EQ(of(motion(0x1234, {0, 0}))[3], 0x12);
}

TEST(Gt01Serial, ReadsBackWhatItAsks) {
  const auto asked = asked_twist(of(motion(3, {-0.35, 0.125})));
  ASSERT_TRUE(asked);
  EXPECT_DOUBLE_EQ(asked->vx_mps, -0.35);
  EXPECT_DOUBLE_EQ(asked->wz_radps, 0.125);
  EXPECT_FALSE(asked_twist(kWheels)) << "wheel speeds are no twist";
  EXPECT_FALSE(asked_twist(kStop));
}

TEST(Gt01Serial, AsksForRestWhereItIsGivenNoNumberAndForTheMostWhereForTooMuch) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(of(motion(0, {nan, nan})), of(motion(0, {0, 0})));
  EXPECT_DOUBLE_EQ(asked_twist(of(motion(0, {1e9, 0})))->vx_mps, 32.767);
  EXPECT_DOUBLE_EQ(asked_twist(of(motion(0, {-1e9, 0})))->vx_mps, -32.767);
}

TEST(Gt01Serial, ReadsTheUploadWithAStateOfDockingOfOneByteOrTwo) {
  Bytes wide = kUploadData;
  wide.insert(wide.begin() + 5, 0);
  for (const auto& data : {kUploadData, wide}) {
    const auto report = decode(whole(0x81, data));
    ASSERT_TRUE(report && std::holds_alternative<Upload>(*report));
    const auto& upload = std::get<Upload>(*report);
    EXPECT_DOUBLE_EQ(upload.voltage_V, 51.0);
    EXPECT_EQ(upload.status, status::kRemoteOffline | status::kFrontBumper);
    EXPECT_DOUBLE_EQ(upload.twist.vx_mps, 0.2);
    EXPECT_DOUBLE_EQ(upload.twist.wz_radps, -0.1);
    EXPECT_EQ(upload.wheels_mps, (std::array<double, 4>{0.2, 0.193, 0.001, -0.001}));
  }
}

TEST(Gt01Serial, ReadsTheChassisWhoseExampleStatesTwoBytesTooFew) {
  const auto report = decode(kChassis);
  ASSERT_TRUE(report && std::holds_alternative<Chassis>(*report));
  const auto& chassis = std::get<Chassis>(*report);
  EXPECT_DOUBLE_EQ(chassis.track_m, 0.725);
  EXPECT_DOUBLE_EQ(chassis.wheelbase_m, 0.5);
  EXPECT_DOUBLE_EQ(chassis.wheel_diameter_m, 0.17);
  EXPECT_EQ(chassis.gear_ratio, 30);
  EXPECT_EQ(chassis.encoder_lines, 1000);
}

TEST(Gt01Serial, TakesNoPacketOfWhichOneByteIsAnother) {
  const Bytes good = whole(0x81, kUploadData);
  ASSERT_TRUE(decode(good));
  for (std::size_t i = 0; i < good.size(); ++i) {
    Bytes bad = good;
    bad[i] ^= 0x04U;
    EXPECT_FALSE(decode(bad)) << i;
  }
  for (std::size_t size = 0; size < good.size(); ++size)
    EXPECT_FALSE(decode({good.data(), size})) << size;
}

TEST(Gt01Serial, FindsEveryPacketInAnyChunksBetweenNoise) {
  Bytes stream{0xED, 0x00, 0xED, 0xED, 0xDE, 0, 0};
  const Bytes good = whole(0x81, kUploadData);
  for (int i = 0; i < 3; ++i) {
    stream.insert(stream.end(), good.begin(), good.end());
    stream.insert(stream.end(), kChassis.begin(), kChassis.end());
    stream.insert(stream.end(), {0xBD, 0xBC, 0xED});
  }
  std::mt19937 random(1);
  for (int run = 0; run < 200; ++run) {
    Framer framer;
    int uploads = 0;
    int chassis = 0;
    for (std::size_t at = 0; at < stream.size();) {
      const std::size_t size = std::min<std::size_t>(1 + random() % 40, stream.size() - at);
      framer.push(
          {stream.data() + at, size},
          [&](std::span<const std::uint8_t> packet) {
            const auto report = decode(packet);
            ASSERT_TRUE(report);
            uploads += std::holds_alternative<Upload>(*report) ? 1 : 0;
            chassis += std::holds_alternative<Chassis>(*report) ? 1 : 0;
          },
          [] {});
      at += size;
    }
    EXPECT_EQ(uploads, 3);
    EXPECT_EQ(chassis, 3);
  }
}

TEST(Gt01Serial, StandsAnyBytes) {
  std::mt19937 random(2);
  Framer framer;
  Bytes bytes(100000);
  for (auto& byte : bytes) byte = random() % 3 == 0 ? 0xED : static_cast<std::uint8_t>(random());
  std::size_t dropped = 0;
  framer.push(
      bytes, [](std::span<const std::uint8_t>) {}, [&] { ++dropped; });
  EXPECT_GT(dropped, 0U);
  framer.reset();
  int found = 0;
  framer.push(
      kChassis, [&](std::span<const std::uint8_t>) { ++found; }, [] {});
  EXPECT_EQ(found, 1);
}

}  // namespace
}  // namespace drover::gt01::serial
