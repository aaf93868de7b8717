#include "drivers/witmotion/codec.h"

#include <gtest/gtest.h>

#include <vector>

#include "drivers/witmotion/framer.h"

namespace drover::witmotion {
namespace {

using Bytes = std::vector<std::uint8_t>;

template <class T>
T decoded(const Bytes& frame) {
  const auto report = decode(frame);
  EXPECT_TRUE(report);
  const T* value = report ? std::get_if<T>(&*report) : nullptr;
  EXPECT_NE(value, nullptr);
  return value == nullptr ? T{} : *value;
}

TEST(WitmotionCodec, RejectsWrongSumsLengthsHeadersAndTypes) {
  const Bytes good{0x55, 0x53, 0, 0x20, 0, 0, 0, 0x40, 0, 0, 0x08};
  EXPECT_TRUE(decode(good));
  Bytes bad = good;
  bad.back() = 0x09;
  EXPECT_FALSE(decode(bad));
  for (std::size_t size = 0; size < good.size(); ++size)
    EXPECT_FALSE(decode({good.data(), size})) << size;
  bad = good;
  bad.push_back(0);
  EXPECT_FALSE(decode(bad));
  EXPECT_FALSE(decode(Bytes{0x56, 0x53, 0, 0x20, 0, 0, 0, 0x40, 0, 0, 0x09}));
  EXPECT_FALSE(decode(Bytes{0x55, 0x5B, 0, 0x20, 0, 0, 0, 0x40, 0, 0, 0x10}));
}

TEST(WitmotionCodec, ReadsTheClock) {
  const auto t = decoded<Clock>({0x55, 0x50, 0x1a, 6, 0x17, 0x0c, 0x22, 0x38, 0x15, 3, 0x5a});
  EXPECT_EQ(t.year, 2026);
  EXPECT_EQ(t.month, 6);
  EXPECT_EQ(t.day, 23);
  EXPECT_EQ(t.hour, 12);
  EXPECT_EQ(t.minute, 34);
  EXPECT_EQ(t.second, 56);
  EXPECT_EQ(t.millisecond, 789);
}

TEST(WitmotionCodec, ReadsPressureAndTheReceiver) {
  const auto p = decoded<Pressure>({0x55, 0x56, 0xcd, 0x8b, 1, 0, 0x39, 0x30, 0, 0, 0x6d});
  EXPECT_DOUBLE_EQ(p.pressure_Pa, 101325);
  EXPECT_DOUBLE_EQ(p.height_m, 123.45);
  const auto at =
      decoded<GpsPosition>({0x55, 0x57, 0x05, 0xbc, 0x65, 0x43, 0x05, 0xd3, 0xc0, 0x0d, 0xba});
  EXPECT_NEAR(at.longitude_deg, 113.12345683, 1e-8);
  EXPECT_NEAR(at.latitude_deg, 23.12345683, 1e-8);
  const auto v = decoded<GpsMotion>({0x55, 0x58, 0xc8, 1, 0x5a, 0x23, 0x10, 0x0e, 0, 0, 0x11});
  EXPECT_DOUBLE_EQ(v.height_m, 45.6);
  EXPECT_EQ(v.yaw_raw, 9050);
  EXPECT_NEAR(v.speed_mps, 1.0, 1e-12);
  const auto a = decoded<GpsAccuracy>({0x55, 0x5a, 0x12, 0, 0x78, 0, 0x50, 0, 0x5a, 0, 0xe3});
  EXPECT_EQ(a.satellites, 18);
  EXPECT_DOUBLE_EQ(a.pdop, 1.2);
  EXPECT_DOUBLE_EQ(a.hdop, 0.8);
  EXPECT_DOUBLE_EQ(a.vdop, 0.9);
}

TEST(WitmotionCodec, ReadsASouthernAndWesternPlace) {
  // -33 degrees 30.00000 minutes, -70 degrees 15.00000 minutes.
  const auto at =
      decoded<GpsPosition>({0x55, 0x57, 0xa0, 0xf5, 0x2f, 0xd6, 0xc0, 0xd2, 0x26, 0xec, 0xea});
  EXPECT_NEAR(at.longitude_deg, -70.25, 1e-9);
  EXPECT_NEAR(at.latitude_deg, -33.5, 1e-9);
}

TEST(WitmotionCodec, ReadsRegistersAndPorts) {
  const auto r = decoded<Registers>({0x55, 0x5f, 9, 0, 6, 0, 0, 0, 0, 0, 0xc3});
  EXPECT_EQ(r.value, (std::array<std::uint16_t, 4>{9, 6, 0, 0}));
  const auto d = decoded<Ports>({0x55, 0x55, 1, 0, 2, 0, 3, 0, 0xff, 0xff, 0xae});
  EXPECT_EQ(d.raw, (std::array<std::uint16_t, 4>{1, 2, 3, 0xffff}));
}

TEST(WitmotionCodec, WritesTheCommandsOfTheDocument) {
  EXPECT_EQ(write_register(Register::unlock, kUnlock), (Command{0xff, 0xaa, 0x69, 0x88, 0xb5}));
  EXPECT_EQ(write_register(Register::save, kSave), (Command{0xff, 0xaa, 0, 0, 0}));
  EXPECT_EQ(write_register(Register::rate, *rate_code(100)), (Command{0xff, 0xaa, 3, 9, 0}));
  EXPECT_EQ(write_register(Register::baud, *baud_code(115200)), (Command{0xff, 0xaa, 4, 6, 0}));
  EXPECT_EQ(write_register(Register::content,
                           kClock | kAcceleration | kAngularRate | kAngles | kQuaternion),
            (Command{0xff, 0xaa, 2, 0x0f, 2}));
  EXPECT_EQ(read_registers(Register::rate), (Command{0xff, 0xaa, 0x27, 3, 0}));
}

TEST(WitmotionCodec, KnowsNoCodeForWhatTheDeviceCannot) {
  EXPECT_FALSE(rate_code(99));
  EXPECT_FALSE(rate_Hz(0x0D));
  EXPECT_FALSE(baud_code(1000000));
  EXPECT_FALSE(baud_of(0));
  EXPECT_EQ(bandwidth_code(100), 1);
  EXPECT_EQ(bandwidth_code(44), 3);
  EXPECT_EQ(bandwidth_code(1000), 0);
}

std::size_t frames_in(Framer& framer, const Bytes& bytes) {
  std::size_t count = 0;
  for (const std::uint8_t byte : bytes)
    if (framer.push(byte) == Framer::Event::frame) ++count;
  return count;
}

TEST(WitmotionFramer, DropsOneByteAtAMismatchSoThatTheFrameInsideIsFound) {
  Framer framer(Format::standard);
  // A header and a type in front of a whole frame: eleven bytes with a wrong sum.
  EXPECT_EQ(frames_in(framer, {0x55, 0x51, 0x55, 0x53, 0, 0x20, 0, 0, 0, 0x40, 0, 0, 0x08}), 1U);
  EXPECT_EQ(framer.frame()[1], 0x53);
}

TEST(WitmotionFramer, TakesAHeaderInsideTheDataForData) {
  Framer framer(Format::standard);
  EXPECT_EQ(frames_in(framer, {0x55, 0x51, 0x55, 0x51, 0, 8, 0, 0, 0x55, 0x51, 0xfa}), 1U);
}

TEST(WitmotionFramer, WantsASecondHeaderBeforeItBelievesFramesWithoutASum) {
  Framer framer(Format::combined);
  Bytes frame(kCombinedFrameSize, 0);
  frame[0] = 0x55;
  frame[1] = 0x61;
  EXPECT_EQ(frames_in(framer, frame), 0U);
  EXPECT_EQ(frames_in(framer, frame), 1U);
  EXPECT_EQ(frames_in(framer, frame), 1U);
  EXPECT_EQ(frames_in(framer, {0}), 0U);
  EXPECT_EQ(frames_in(framer, frame), 0U);
  EXPECT_EQ(frames_in(framer, frame), 1U);
}

}  // namespace
}  // namespace drover::witmotion
