#include <gtest/gtest.h>

#include <thread>

#include "drover/angle.h"
#include "drover/can_frame.h"
#include "drover/command.h"
#include "drover/driver.h"
#include "drover/event.h"
#include "drover/fixed_text.h"
#include "drover/registry.h"
#include "drover/result.h"
#include "drover/snapshot.h"
#include "drover/triple_buffer.h"

namespace drover {

TEST(FixedText, IsCutAtACharacterNotInsideOneAndSaysSo) {
  FixedText<8> text("园区园");  // characters of three bytes
  EXPECT_EQ(text.view(), "园…");
  text = FixedText<8>("园ab园");
  EXPECT_EQ(text.view(), "园ab园") << "it fits";
  text = FixedText<8>("园abc园");
  EXPECT_EQ(text.view(), "园ab…");
  text = FixedText<8>("123456789");
  EXPECT_EQ(text.view(), "12345…");
}

TEST(FixedText, AppendsAsMuchAsFits) {
  FixedText<8> text("abc");
  text.append("de");
  EXPECT_EQ(text, "abcde");
  text.append("");
  text.append("fgh");
  EXPECT_EQ(text, "abcdefgh");
}

TEST(FixedText, TakesNothingMoreBehindItsCut) {
  FixedText<8> text("abcdef");
  text.append("园");  // it needs three bytes, and two are left
  EXPECT_EQ(text, "abcde…");
  text.append("");
  text.append("1");
  text.append("1234");
  EXPECT_EQ(text, "abcde…");
  FixedText<8> shorter("园区");
  shorter.append("园");
  EXPECT_EQ(shorter, "园…") << "two bytes are left, and nothing goes into them";
  shorter.append("a");
  EXPECT_EQ(shorter, "园…");
  shorter.assign("a");
  shorter.append("b");
  EXPECT_EQ(shorter, "ab");
}

TEST(FixedText, FormatsWithinItsSize) {
  FixedText<8> text;
  text.format("%s %d", "abc", 1234);
  EXPECT_EQ(text.view(), "abc 1234");
  text.format("%s %d", "abc", 123456);
  EXPECT_EQ(text.view(), "abc 1…");
  text.format("%s", "abcd园区");
  EXPECT_EQ(text.view(), "abcd…") << "whole characters";
}

/// In the sentence that an operator reads, however long what it is made of.
TEST(FixedText, TellsOfAReasonThatItIsCut) {
  for (std::size_t size = 0; size < 400; ++size) {
    const std::string all(size, 'x');
    const Reason reason(all);
    EXPECT_LE(reason.view().size(), Reason::capacity());
    EXPECT_EQ(reason.view() == all, size <= Reason::capacity());
    EXPECT_EQ(reason.view().ends_with("…"), size > Reason::capacity());
  }
}

TEST(Angle, CompassNorthIsYawNinetyDegrees) {
  EXPECT_NEAR(yaw_rad_from_compass_deg(0.0), kPi / 2, 1e-12);
  EXPECT_NEAR(yaw_rad_from_compass_deg(90.0), 0.0, 1e-12);
  EXPECT_NEAR(compass_deg_from_yaw_rad(kPi), 270.0, 1e-9);
  EXPECT_NEAR(wrap_rad(3 * kPi), -kPi, 1e-9);
  EXPECT_EQ(wrap_deg(360.0), 0.0);
}

TEST(DriverOut, CountsWhatDoesNotFit) {
  DriverOut out;
  for (int i = 0; i < 40; ++i) out.send(make_frame(1));
  EXPECT_EQ(out.frames.size(), 32U);
  EXPECT_EQ(out.overflows, 8U);
}

TEST(TripleBuffer, ReaderSeesWholeValuesOnly) {
  struct Pair {
    int a = 0;
    int b = 0;
  };
  TripleBuffer<Pair> buffer;
  std::thread writer([&] {
    for (int i = 1; i <= 100000; ++i) {
      buffer.back() = {i, -i};
      buffer.publish();
    }
  });
  int last = 0;
  while (last < 100000) {
    const auto& pair = buffer.latest();
    ASSERT_EQ(pair.a, -pair.b);
    ASSERT_GE(pair.a, last);
    last = pair.a;
  }
  writer.join();
}

}  // namespace drover
