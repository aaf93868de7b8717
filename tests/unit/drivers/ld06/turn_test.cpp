#include "drivers/ld06/turn.h"

#include <gtest/gtest.h>

namespace drover::ld06 {
namespace {

using namespace std::chrono_literals;

/// Twelve beams that begin with beam `first` of 450 of a turn; ranges are their numbers.
Slice slice_at(int first, int stamp_ms, int speed_degps = 3600) {
  Slice slice;
  slice.speed_degps = static_cast<std::uint16_t>(speed_degps);
  slice.start_cdeg = static_cast<std::uint16_t>(first % 450 * 80);
  slice.end_cdeg = static_cast<std::uint16_t>((first + 11) % 450 * 80);
  slice.stamp_ms = static_cast<std::uint16_t>(stamp_ms % 30000);
  for (int i = 0; i < 12; ++i)
    slice.beams[static_cast<std::size_t>(i)] = {
        static_cast<std::uint16_t>(1000 + (first + i) % 450), 100};
  return slice;
}

/// Packets as the device sends them; those of which `lost` says so do not arrive.
struct Stream {
  explicit Stream(bool upside_down = false) : turns(upside_down) {}
  void run(
      int packets, const std::function<bool(int)>& lost = [](int) { return false; }) {
    for (int i = 0; i < packets; ++i, ++sent) {
      const Time at{10s + sent * 2666667ns};
      if (lost(sent)) continue;
      if (turns.add(slice_at(sent * 12, sent * 8 / 3), at)) ended.push_back(turns.turn());
    }
  }
  TurnAssembler turns;
  int sent = 5;
  std::vector<Scan> ended;
};

TEST(Ld06Turn, TellsWholeTurnsFromZeroToZero) {
  Stream stream;
  stream.run(150);
  ASSERT_EQ(stream.ended.size(), 3U) << "the first began somewhere";
  for (const Scan& turn : stream.ended) {
    ASSERT_EQ(turn.points.size(), 450U);
    EXPECT_DOUBLE_EQ(turn.turn_Hz, 10);
    EXPECT_NEAR(to_s(turn.end - turn.begin), 449 / 4500.0, 1e-4);
    for (std::size_t i = 0; i < 450; ++i)
      EXPECT_NEAR(turn.points[i].range_m, 1 + 0.001 * static_cast<double>(i), 1e-9);
  }
  EXPECT_NEAR(to_s(stream.ended[1].begin - stream.ended[0].begin), 0.1, 1e-4);
}

TEST(Ld06Turn, CountsCounterClockwiseSeenFromAbove) {
  Stream upright;
  upright.run(120);
  Stream hanging(true);
  hanging.run(120);
  ASSERT_FALSE(upright.ended.empty() || hanging.ended.empty());
  // A quarter of a turn clockwise is the sensor's right when it stands, its left when it hangs.
  const std::size_t quarter = 112;
  EXPECT_NEAR(upright.ended[0].points[quarter].bearing_rad, to_rad(-89.6), 1e-9);
  EXPECT_NEAR(hanging.ended[0].points[quarter].bearing_rad, to_rad(89.6), 1e-9);
  for (const Scan* turn : {upright.ended.data(), hanging.ended.data()})
    for (const ScanPoint& point : turn->points) {
      EXPECT_GE(point.bearing_rad, -kPi);
      EXPECT_LT(point.bearing_rad, kPi);
    }
}

TEST(Ld06Turn, HasAHoleWhereAPacketWasLost) {
  Stream stream;
  stream.run(150, [](int packet) { return packet == 60; });
  ASSERT_EQ(stream.ended.size(), 3U);
  EXPECT_EQ(stream.ended[0].points.size(), 438U);
  EXPECT_EQ(stream.ended[1].points.size(), 450U);
}

TEST(Ld06Turn, IsNeverPutTogetherFromTwo) {
  Stream stream;
  // Nearly a turn is lost, and a little more than one: the angles of the second go on as if nothing
  // were missing.
  stream.run(300, [](int packet) {
    return (packet >= 69 && packet < 100) || (packet >= 171 && packet < 214);
  });
  for (const Scan& turn : stream.ended) {
    EXPECT_LT(to_s(turn.end - turn.begin), 0.101);
    EXPECT_EQ(turn.points.size(), 450U);
  }
  EXPECT_EQ(stream.ended.size(), 3U);
}

TEST(Ld06Turn, IsDroppedWhenTheDevicesClockWentRoundInItsMidst) {
  // Silent for just as long as its clock needs, and the motor ran on: 300 turns later all fits.
  Stream stream;
  stream.run(60);
  stream.run(11250, [](int) { return true; });
  stream.run(100);
  ASSERT_EQ(stream.ended.size(), 2U);
  for (const Scan& turn : stream.ended) EXPECT_LT(to_s(turn.end - turn.begin), 0.101);
}

TEST(Ld06Turn, KeepsNoMoreThanATurnOfAMotorThatStands) {
  TurnAssembler turns(false);
  int ended = 0;
  for (int i = 0; i < 1000; ++i) {
    Slice slice = slice_at(i < 40 ? i * 12 : 480, i * 8 / 3, 0);
    if (i >= 40) slice.end_cdeg = slice.start_cdeg;
    ended += turns.add(slice, Time{10s + i * 2666667ns}) ? 1 : 0;
  }
  EXPECT_EQ(ended, 0);
}

}  // namespace
}  // namespace drover::ld06
