// Frames of CubeMars motors to the bit. The vectors were computed from the documented layouts, by
// another packer than the driver's.
#include "drivers/cubemars_mit/codec.h"

#include <gtest/gtest.h>

#include "drivers/cubemars_mit/driver.h"
#include "drivers/cubemars_mit/entry.h"
#include "unit/drivers/conformance/harness.h"

namespace drover::cubemars_mit {
namespace {

constexpr Ranges kAk80{12.5, 50, 18};
constexpr Ranges kAk10{12.5, 50, 65};

TEST(CubemarsCodec, PacksWhatTheVectorsSay) {
  EXPECT_EQ(mit::encode_mit(1, {1.0, 2.0, 50, 1.0, -3.0}, kAk80),
            make_frame(1, {0x8A, 0x3C, 0x85, 0x11, 0x99, 0x33, 0x36, 0xAA}));
  EXPECT_EQ(mit::encode_mit(1, {0, 5, 0, 2, 10}, kAk10),
            make_frame(1, {0x7F, 0xFF, 0x8C, 0xC0, 0x00, 0x66, 0x69, 0x3A}));
  EXPECT_EQ(encode_special(1, Special::enable),
            make_frame(1, {0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFC}));
}

TEST(CubemarsCodec, ReadsAnAnswerOfEightBytesAndOfSix) {
  CanFrame frame = make_frame(1, {0x01, 0x8A, 0x3C, 0x85, 0x16, 0xAA, 0x21, 0x02});
  const auto whole = decode_feedback(frame, 1, kAk80);
  ASSERT_TRUE(whole);
  EXPECT_NEAR(whole->motion.position_rad, 0.99966, 1e-5);
  EXPECT_NEAR(whole->motion.velocity_radps, 1.9902, 1e-4);
  EXPECT_NEAR(whole->motion.torque_Nm, -3.0022, 1e-4);
  EXPECT_EQ(whole->degC, 33);
  EXPECT_EQ(whole->error, 2);
  frame.len = 6;
  const auto six = decode_feedback(frame, 1, kAk80);
  ASSERT_TRUE(six);
  EXPECT_EQ(six->motion.position_rad, whole->motion.position_rad);
  EXPECT_NE(six->degC, six->degC) << "not told";
  EXPECT_FALSE(six->failed()) << "not told";
  for (const int len : {0, 5, 7}) {
    frame.len = static_cast<std::uint8_t>(len);
    EXPECT_FALSE(decode_feedback(frame, 1, kAk80)) << len;
  }
}

TEST(CubemarsCodec, GivesBackWhatItPacked) {
  const Feedback told{{-3, 7, 11}, -20, 4};
  const auto read = decode_feedback(encode_feedback(0, 9, told, kAk80), 9, kAk80);
  ASSERT_TRUE(read);
  EXPECT_NEAR(read->motion.position_rad, -3, 25 / 65535.0);
  EXPECT_NEAR(read->motion.velocity_radps, 7, 100 / 4095.0);
  EXPECT_NEAR(read->motion.torque_Nm, 11, 36 / 4095.0);
  EXPECT_EQ(read->degC, -20);
  EXPECT_EQ(read->error, 4);
}

FrameEffect effect_of(const CanFrame& frame) {
  Options options = test::example_options(kCubemarsMitEntry);
  options.set("id", 1.0).set("model", std::string("AK80-9"));
  const CubemarsDriver driver(read_settings(options), 0);
  return driver.effect(frame, Time{}).kind;
}

TEST(CubemarsRules, KnowWhatEachFrameDoes) {
  EXPECT_EQ(effect_of(encode_special(1, Special::enable)), FrameEffect::harmless);
  EXPECT_EQ(effect_of(encode_special(1, Special::disable)), FrameEffect::harmless)
      << "the question to one that was never heard";
  EXPECT_EQ(effect_of(encode_special(1, Special::set_zero)), FrameEffect::forbidden);
  EXPECT_EQ(effect_of(encode_special(1, Special::clear_error)), FrameEffect::forbidden)
      << "to this motor it is a set point with all at its ends";
  EXPECT_EQ(effect_of(mit::encode_mit(1, {0, 0, 0, 1, 0}, kAk80)), FrameEffect::stop);
  EXPECT_EQ(effect_of(mit::encode_mit(1, {0, 1, 0, 1, 0}, kAk80)), FrameEffect::motion);
  EXPECT_EQ(effect_of(mit::encode_mit(1, {0, 0, 1, 1, 0}, kAk80)), FrameEffect::motion);
  EXPECT_EQ(effect_of(mit::encode_mit(2, {0, 0, 0, 1, 0}, kAk80)), FrameEffect::forbidden);
}

/// Answers come under the id of its commands: one that reads like damping is no stop of anybody's.
TEST(CubemarsRules, CallNoAnswerAStop) {
  const CanFrame answer = make_frame(1, {0x01, 0x00, 0x7F, 0xF0, 0x00, 0x00, 0x08, 0x00});
  ASSERT_TRUE(decode_feedback(answer, 1, kAk80));
  ASSERT_EQ(mit::effect(answer, 1), FrameEffect::stop);
  EXPECT_EQ(effect_of(answer), FrameEffect::forbidden);
}

}  // namespace
}  // namespace drover::cubemars_mit
