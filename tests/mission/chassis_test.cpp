// A chassis that takes a twist: over a serial line and over CAN.
#include <array>
#include <bit>
#include <cstdint>
#include <fstream>
#include <optional>
#include <sstream>

#include "mission/support.h"

namespace drover::mission {
namespace {

/// What one packet on the chassis' line asks for, read from the bytes alone.
struct Asked {
  Time time = kNever;  ///< when its last byte was there
  std::uint16_t sequence = 0;
  double vx_mps = 0;
  double wz_radps = 0;
  bool moves() const { return vx_mps != 0 || wz_radps != 0; }
};

struct Line {
  std::vector<Asked> packets;
  std::size_t strange = 0;  ///< bytes that belong to no twist
};

/// A twist: ED DE, sequence, 02, 12 (length), mode 0, v mm/s, w float, sum, BD BC.
std::optional<Asked> read_twist(const std::vector<std::uint8_t>& b, std::size_t at) {
  constexpr std::size_t kSize = 18;
  if (b.size() - at < kSize || b[at] != 0xED || b[at + 1] != 0xDE || b[at + 4] != 0x02 ||
      b[at + 5] != kSize || b[at + 6] != 0 || b[at + 7] != 0 || b[at + 16] != 0xBD ||
      b[at + 17] != 0xBC)
    return std::nullopt;
  const auto word = [&](std::size_t i) {
    return static_cast<std::uint16_t>(b[at + i] | b[at + i + 1] << 8U);
  };
  unsigned sum = 0;
  for (std::size_t i = 0; i < 14; ++i) sum += b[at + i];
  if ((sum & 0xFFFFU) != word(14)) return std::nullopt;
  const auto bits = static_cast<std::uint32_t>(word(10)) | static_cast<std::uint32_t>(word(12))
                                                               << 16U;
  Asked asked;
  asked.sequence = word(2);
  asked.vx_mps = static_cast<std::int16_t>(word(8)) / 1000.0;
  asked.wz_radps = std::bit_cast<float>(bits);
  return asked;
}

/// "(12.345678901) base EDDE...", one line a tick, packets cut anywhere.
Line read_line(const Record& log) {
  std::ifstream file(log.folder / "serial.log");
  std::vector<std::uint8_t> bytes;
  std::vector<Time> times;
  std::string text;
  while (std::getline(file, text)) {
    std::istringstream words(text);
    std::string stamp;
    std::string port;
    std::string digits;
    words >> stamp >> port >> digits;
    const Time time{from_s(std::stod(stamp.substr(1)))};
    for (std::size_t i = 0; i + 1 < digits.size(); i += 2) {
      bytes.push_back(static_cast<std::uint8_t>(std::stoi(digits.substr(i, 2), nullptr, 16)));
      times.push_back(time);
    }
  }
  Line line;
  for (std::size_t at = 0; at < bytes.size();) {
    auto asked = read_twist(bytes, at);
    if (!asked) {
      ++line.strange;
      ++at;
      continue;
    }
    at += 18;
    asked->time = times[at - 1];
    line.packets.push_back(*asked);
  }
  return line;
}

TEST(Gt01, IsDrivenToSuccessCloseToTheTrack) {
  expect_drive_on_a_chassis("gt01");
}

TEST(Gt01, HearsNothingButWholeTwistsAndStandsBeforeAndAfterTheTask) {
  const Record& log = record("gt01");
  const Line line = read_line(log);
  ASSERT_GT(line.packets.size(), 1000U);
  EXPECT_EQ(line.strange, 0U);
  const Time begin = log.answered("start_task_success");
  const Time end = log.first_status("NAV_SUCCESS").time + 200ms;
  for (const Asked& asked : line.packets)
    EXPECT_TRUE(!asked.moves() || (asked.time > begin - 100ms && asked.time < end))
        << "at " << seconds(asked.time);
}

TEST(Gt01, ShowsNoJointToAnybody) {
  for (const auto& status : record("gt01").statuses)
    ASSERT_EQ(status.why.find("wheel"), std::string::npos) << status.why;
}

TEST(Gt01Can, IsDrivenToSuccessCloseToTheTrack) {
  expect_drive_on_a_chassis("gt01_can");
}

/// 0x01: 01 01, then the twist; nothing else has this id.
TEST(Gt01Can, HearsNothingButTwists) {
  const Record& log = record("gt01_can");
  std::size_t told = 0;
  for (const CanLine& line : log.can) {
    if (line.frame.id != 0x01) continue;
    ++told;
    ASSERT_EQ(line.frame.len, 8);
    ASSERT_EQ(line.frame.data[0], 0x01);
    ASSERT_EQ(line.frame.data[1], 0x01);
    ASSERT_EQ(line.frame.data[6] | line.frame.data[7], 0);
  }
  EXPECT_GT(told, 500U);
}

TEST(Gt01Kill, IsBroughtToRestByTheGuardsPackets) {
  const Record& log = record("gt01_kill");
  const Time killed = log.event("signal 9 to droverd");
  const Time back = log.event("start droverd", 2);
  const Line line = read_line(log);
  // Half a packet of the one who died may stand before the guard's first.
  EXPECT_LT(line.strange, 18U);
  Time first = kNever;
  for (const Asked& asked : line.packets) {
    if (asked.time < killed + 10ms || asked.time > back) continue;
    EXPECT_FALSE(asked.moves()) << "at " << seconds(asked.time);
    if (first == kNever) first = asked.time;
  }
  ASSERT_NE(first, kNever) << "nobody spoke";
  figure("the guard's first packet after it went", first - killed);
  EXPECT_LE(first - killed, 100ms);
  tell_way_to_rest(log, killed, back);
  EXPECT_LE(roll(log, killed, back).way_m, 0.35);
  EXPECT_LE(roll(log, killed, back).rest - killed, 800ms);
}

TEST(Gt01Kill, LetsANewStartReachTheGoal) {
  const Record& log = record("gt01_kill");
  expect_new_start_succeeds(log, log.event("start droverd", 2));
}

/// It keeps its last twist, and nobody reaches it: only its power can be taken.
TEST(Gt01Torn, LosesItsPowerAndComesToRest) {
  const Record& log = record("gt01_torn");
  const Time torn = log.event("event torn#1");
  const Time plugged = log.event("event plugged#1");
  const auto relay = log.changes("enable_relay", torn, plugged);
  ASSERT_FALSE(relay.empty()) << "the relay stays closed";
  figure("the relay opens after", relay.front().time - torn);
  tell_way_to_rest(log, torn, plugged);
  EXPECT_LE(relay.front().time - torn, 2500ms);
  // Without power it rolls out.
  EXPECT_LE(roll(log, torn, plugged).way_m, 2.0);
  EXPECT_LE(roll(log, torn, plugged).rest - torn, 4900ms);
}

TEST(Gt01Torn, GoesOnOnlyAfterAResetAndANewStart) {
  const Record& log = record("gt01_torn");
  const auto& error = log.first_status("NAV_ERROR", log.event("event torn#1"));
  EXPECT_LE(error.time - log.event("event torn#1"), 500ms);
  EXPECT_EQ(log.statuses.back().nav, "NAV_SUCCESS");
  const Line line = read_line(log);
  const Time start = next_start(log, log.event("event plugged#1"));
  for (const Asked& asked : line.packets)
    if (asked.time > log.event("event plugged#1") && asked.time < start - 100ms)
      EXPECT_FALSE(asked.moves()) << "at " << seconds(asked.time);
}

}  // namespace
}  // namespace drover::mission
