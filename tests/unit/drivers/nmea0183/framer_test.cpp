// The framer finds whole sentences and nothing else.
#include "drivers/nmea0183/framer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>
#include <span>
#include <string>
#include <vector>

#include "unit/drivers/nmea0183/lines.h"

namespace drover::nmea0183 {
namespace {

using test::line;
using testing::ElementsAre;
using testing::IsEmpty;

struct Framed {
  std::vector<std::string> bodies;
  int dropped = 0;
  int foreign = 0;
};

Framed frame(std::string_view text) {
  Framer framer;
  Framed result;
  for (const std::uint8_t byte : test::bytes(text)) {
    const auto event = framer.push(byte);
    if (event == Framer::Event::sentence) result.bodies.emplace_back(framer.body());
    result.dropped += event == Framer::Event::dropped ? 1 : 0;
    result.foreign += event == Framer::Event::foreign ? 1 : 0;
  }
  return result;
}

const std::string kHdt = "$GNHDT,244.28,T*13\r\n";

TEST(NmeaFramer, RejectsABadChecksum) {
  const auto framed = frame("$GNGLL,5327.04319,S,00214.41396,E,223232.00,A,A*22\r\n");
  EXPECT_THAT(framed.bodies, IsEmpty());
  EXPECT_EQ(framed.dropped, 1);
}

TEST(NmeaFramer, RejectsALineWithoutChecksum) {
  EXPECT_EQ(frame("$GNHDT,244.28,T\r\n").dropped, 1);
  EXPECT_EQ(frame("$GNHDT,244.28,T*\r\n").dropped, 1);
  EXPECT_EQ(frame("$GNHDT,244.28,T*1\r\n").dropped, 1);
  EXPECT_EQ(frame("$GNHDT,244.28,T*133\r\n").dropped, 1);
  EXPECT_EQ(frame("$GNHDT,244.28,T*1G\r\n").dropped, 1);
}

TEST(NmeaFramer, RejectsControlAndHighBytesInsideASentence) {
  for (const char odd : {'\0', '\x01', '\x7F', '\xFF', '\t'}) {
    std::string body = "GNHDT,244.28,T";
    body[5] = odd;
    const auto framed = frame(line(body) + kHdt);
    EXPECT_THAT(framed.bodies, ElementsAre("GNHDT,244.28,T")) << int(odd);
    EXPECT_EQ(framed.dropped, 1) << int(odd);
  }
}

TEST(NmeaFramer, StartsAgainAtADollarInsideACutLine) {
  const auto framed = frame("$GNGGA,103607.00,5327.0" + kHdt);
  EXPECT_THAT(framed.bodies, ElementsAre("GNHDT,244.28,T"));
  EXPECT_EQ(framed.dropped, 1);
}

TEST(NmeaFramer, StartsAgainAtADollarInsideAChecksum) {
  EXPECT_THAT(frame("$GNHDT,1.0,T*1" + kHdt).bodies, ElementsAre("GNHDT,244.28,T"));
  EXPECT_THAT(frame("$GNHDT,1.0,T*" + kHdt).bodies, ElementsAre("GNHDT,244.28,T"));
}

TEST(NmeaFramer, DropsALineThatAHashCuts) {
  const auto framed = frame("$GNHDT,1.#BESTNAVA,97,GPS;x*3e3517dd\r\n" + kHdt);
  EXPECT_THAT(framed.bodies, ElementsAre("GNHDT,244.28,T"));
  EXPECT_EQ(framed.dropped, 1);
}

TEST(NmeaFramer, CountsALineWithoutEndOnceAndFindsTheNext) {
  const auto framed = frame("$" + std::string(65536, 'A') + "\r\n" + kHdt);
  EXPECT_THAT(framed.bodies, ElementsAre("GNHDT,244.28,T"));
  EXPECT_EQ(framed.dropped, 1);
}

TEST(NmeaFramer, TakesABodyAsLongAsItsBufferAndNoLonger) {
  EXPECT_EQ(frame(line(std::string(Framer::kMaxBody, 'A'))).bodies.size(), 1U);
  EXPECT_EQ(frame(line(std::string(Framer::kMaxBody + 1, 'A'))).dropped, 1);
}

TEST(NmeaFramer, LeavesLinesWithA32BitCheckToOthers) {
  const auto framed = frame("$KSXT,1,2*3e3517dd\r\n");
  EXPECT_THAT(framed.bodies, IsEmpty());
  EXPECT_EQ(framed.dropped, 0);
  EXPECT_EQ(framed.foreign, 1);
}

TEST(NmeaFramer, CountsNoRepliesOfAReceiverAsDamaged) {
  const auto framed = frame(
      "$command,VERSION,response: OK*04\r\n"
      "$CONFIG,COM3,CONFIG COM3 115200*23\r\n");
  EXPECT_EQ(framed.foreign, 2);
  EXPECT_EQ(framed.dropped, 0);
}

TEST(NmeaFramer, RefusesASumWithTheDollarForOtherSentences) {
  const std::string body = "GNHDT,244.28,T";  // 13 without the dollar, 37 with it
  EXPECT_EQ(frame("$" + body + "*37\r\n").dropped, 1);
}

TEST(NmeaFramer, IgnoresWhatLiesBetweenSentences) {
  const auto framed = frame("\xB5\x62\x01\x07 text\r\n\r\n" + kHdt + "\xD3" + kHdt);
  EXPECT_EQ(framed.bodies.size(), 2U);
  EXPECT_EQ(framed.dropped, 0);
}

TEST(NmeaFramer, AcceptsLineFeedAloneReturnAloneAndLowerCase) {
  EXPECT_EQ(frame("$GNHDT,244.28,T*13\n").bodies.size(), 1U);
  EXPECT_EQ(frame("$GNHDT,244.28,T*13\r").bodies.size(), 1U);
  EXPECT_EQ(
      frame("$GNRMC,103607.00,A,5327.03942,N,10214.42462,W,0.046,,060321,,,A,V*0e\n").bodies.size(),
      1U);
}

/// What `text` gives when the framer may take the dull bytes at once, in chunks of `chunk`.
Framed frame_at_once(std::string_view text, std::size_t chunk) {
  Framer framer;
  Framed result;
  const auto bytes = test::bytes(text);
  for (std::size_t begin = 0; begin < bytes.size(); begin += chunk) {
    auto rest = std::span(bytes).subspan(begin, std::min(chunk, bytes.size() - begin));
    while (true) {
      rest = rest.subspan(framer.take_dull(rest));
      if (rest.empty()) break;
      const auto event = framer.push(rest.front());
      rest = rest.subspan(1);
      if (event == Framer::Event::sentence) result.bodies.emplace_back(framer.body());
      result.dropped += event == Framer::Event::dropped ? 1 : 0;
      result.foreign += event == Framer::Event::foreign ? 1 : 0;
    }
  }
  return result;
}

TEST(NmeaFramer, FindsTheSameWhetherItTakesBytesAtOnceOrOneByOne) {
  std::mt19937 random(1);
  const std::string_view pieces[] = {
      "$GNHDT,244.28,T*13\r\n", "$GPGGA,1,2*", "\r\n", "#",  "$",   "*", "command,", "13", "\x80",
      "text between",           "$A*41\n",     "*4",   "1G", "aF\n"};
  for (int i = 0; i < 2000; ++i) {
    std::string text;
    for (auto count = random() % 12; count > 0; --count)
      text += pieces[random() % std::size(pieces)];
    if (random() % 50 == 0) text.insert(text.size() / 2, std::string(Framer::kMaxBody, 'x'));
    const auto expected = frame(text);
    for (const std::size_t chunk : {std::size_t{1}, std::size_t{7}, std::size_t{4096}}) {
      const auto framed = frame_at_once(text, chunk);
      ASSERT_EQ(framed.bodies, expected.bodies) << text;
      ASSERT_EQ(framed.dropped, expected.dropped) << text;
      ASSERT_EQ(framed.foreign, expected.foreign) << text;
    }
  }
}

/// Sixteen bytes are looked at in one step: a mark is found at each place in them.
TEST(NmeaFramer, StopsAtEachMarkWhereverItStands) {
  for (std::size_t before = 0; before <= 40; ++before) {
    for (const int mark :
         std::vector<int>{'$', '*', '#', '\r', '\n', 0, 0x1F, 0x7F, 0x80, 0xA4, 0xFF}) {
      Framer framer;
      framer.push('$');
      std::string text;
      for (std::size_t i = 0; i < before; ++i)
        text += static_cast<char>(i % 3 == 0 ? ' ' : i % 3 == 1 ? '~' : '%');
      text += static_cast<char>(mark);
      text += "5,6,7,8,9,0,1,2,3,4";
      ASSERT_EQ(framer.take_dull(test::bytes(text)), before) << mark;
    }
  }
}

TEST(NmeaFramer, AddsUpTheSameWhereverALineIsCut) {
  std::string text = "GNGGA,";
  while (text.size() < 60) text += static_cast<char>(' ' + text.size() * 7 % 90);
  std::erase_if(text, [](char c) { return c == '$' || c == '*' || c == '#'; });
  const std::string whole_line = line(text);
  const auto whole = test::bytes(whole_line);
  for (std::size_t cut = 1; cut < whole.size(); ++cut) {
    Framer framer;
    int found = 0;
    for (const auto part : {std::span(whole).first(cut), std::span(whole).subspan(cut)}) {
      for (std::size_t at = 0; at < part.size();) {
        at += framer.take_dull(part.subspan(at));
        if (at == part.size()) break;
        if (framer.push(part[at++]) == Framer::Event::sentence) ++found;
      }
    }
    ASSERT_EQ(found, 1) << "cut at " << cut;
    ASSERT_EQ(framer.body(), text);
  }
}

TEST(NmeaFramer, ForgetsALineThatHadBegun) {
  Framer framer;
  for (const std::uint8_t byte : test::bytes("$GNHDT,244.28,T*1")) framer.push(byte);
  framer.reset();
  EXPECT_EQ(framer.push('3'), Framer::Event::none);
  EXPECT_EQ(framer.push('\n'), Framer::Event::none);
}

}  // namespace
}  // namespace drover::nmea0183
