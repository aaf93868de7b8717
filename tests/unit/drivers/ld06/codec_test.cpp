#include "drivers/ld06/codec.h"

#include <gtest/gtest.h>

#include <string>

#include "drivers/ld06/framer.h"
#include "drivers/ld06/settings.h"
#include "support/golden.h"

namespace drover::ld06 {
namespace {

std::string list(const Slice& slice, const auto& value) {
  std::string text;
  for (const Beam& beam : slice.beams)
    text += (text.empty() ? "" : ",") + std::to_string(value(beam));
  return text;
}

std::string say(const Slice& slice) {
  std::ostringstream text;
  text << "packet speed_degps=" << slice.speed_degps << " from_deg=" << slice.start_cdeg / 100.0
       << " to_deg=" << slice.end_cdeg / 100.0 << " stamp_ms=" << slice.stamp_ms
       << " mm=" << list(slice, [](const Beam& beam) { return beam.range_mm; })
       << " intensity=" << list(slice, [](const Beam& beam) { return beam.intensity; });
  return text.str();
}

/// The words of support/golden.h, for packets.
std::string outcome(std::span<const std::uint8_t> bytes) {
  Framer framer;
  std::string text;
  bool bad = false;
  for (const std::uint8_t byte : bytes) {
    const Framer::Event event = framer.push(byte);
    bad |= event == Framer::Event::dropped;
    if (event != Framer::Event::packet) continue;
    const auto slice = decode(framer.packet());
    if (slice) text += say(*slice);
    bad |= !slice;
  }
  if (text.empty()) return bad ? "bad" : "ignored";
  return bad ? text + " and bad" : text;
}

/// No line of the registry yet: what the reader of golden files has to know.
std::vector<test::GoldenFile> goldens() {
  DriverEntry entry;
  entry.name = entry.folder = "ld06";
  entry.options = option_table();
  return test::read_goldens(DROVER_SOURCE_DIR, entry);
}

TEST(Ld06Codec, ReadsTheGoldenBytesAsTheirFileSays) {
  std::size_t cases = 0;
  for (const test::GoldenFile& file : goldens()) {
    EXPECT_TRUE(file.has_source && file.has_provenance) << file.path;
    for (const test::GoldenCase& one : file.cases) {
      EXPECT_EQ(outcome(one.bytes), one.expected) << file.path.string() << ":" << one.line;
      ++cases;
    }
  }
  EXPECT_GE(cases, 10U);
}

TEST(Ld06Codec, WritesWhatItReads) {
  for (const test::GoldenFile& file : goldens()) {
    for (const test::GoldenCase& one : file.cases) {
      const auto slice = decode(one.bytes);
      if (!slice) continue;
      const auto again = encode(*slice);
      EXPECT_EQ(std::vector<std::uint8_t>(again.begin(), again.end()), one.bytes) << one.line;
    }
  }
}

TEST(Ld06Codec, RefusesEveryTruncationAndEveryChangedBit) {
  Slice slice;
  slice.speed_degps = 3600;
  slice.end_cdeg = 880;
  const auto bytes = encode(slice);
  ASSERT_TRUE(decode(bytes));
  for (std::size_t size = 0; size < bytes.size(); ++size)
    EXPECT_EQ(decode({bytes.data(), size}).error(), Fault::length);
  for (std::size_t bit = 0; bit < bytes.size() * 8; ++bit) {
    auto changed = bytes;
    changed[bit / 8] = static_cast<std::uint8_t>(changed[bit / 8] ^ (1U << bit % 8));
    EXPECT_FALSE(decode(changed)) << bit;
  }
}

TEST(Ld06Codec, SaysWhyItRefuses) {
  const auto fault_of = [](int start_cdeg, int end_cdeg, int stamp_ms) {
    Slice slice;
    slice.start_cdeg = static_cast<std::uint16_t>(start_cdeg);
    slice.end_cdeg = static_cast<std::uint16_t>(end_cdeg);
    slice.stamp_ms = static_cast<std::uint16_t>(stamp_ms);
    return decode(encode(slice)).error();
  };
  EXPECT_EQ(fault_of(36000, 880, 0), Fault::angle);
  EXPECT_EQ(fault_of(0, 65535, 0), Fault::angle);
  EXPECT_EQ(fault_of(0, 3001, 0), Fault::span);
  EXPECT_EQ(fault_of(880, 0, 0), Fault::span) << "backwards is nearly a turn";
  EXPECT_EQ(fault_of(0, 880, 30001), Fault::stamp);
}

TEST(Ld06Framer, LosesOnlyThePacketThatWasCut) {
  Slice slice;
  slice.speed_degps = 3600;
  slice.end_cdeg = 880;
  for (Beam& beam : slice.beams) beam.range_mm = 0x2C54;  // the header, twelve times
  const auto bytes = encode(slice);
  for (std::size_t cut = 0; cut < bytes.size(); ++cut) {
    Framer framer;
    int found = 0;
    const auto push = [&](std::size_t size) {
      for (std::size_t i = 0; i < size; ++i)
        found += framer.push(bytes[i]) == Framer::Event::packet ? 1 : 0;
    };
    push(cut);
    // The cut one may swallow what looks like its own rest, and not more.
    for (int i = 0; i < 4; ++i) push(bytes.size());
    EXPECT_GE(found, 3) << cut;
  }
}

}  // namespace
}  // namespace drover::ld06
