// Frames of DAMIAO motors to the bit. The vectors were computed from the documented layouts, by
// another packer than the driver's.
#include "drivers/damiao/codec.h"

#include <gtest/gtest.h>

#include <limits>
#include <random>

#include "drivers/damiao/rules.h"
#include "support/describe.h"

namespace drover::damiao {
namespace {

constexpr Ranges kDm4310{12.5, 30, 10};
constexpr Ranges kDm8009{12.5, 45, 54};
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

TEST(DamiaoCodec, PacksWhatTheVectorsSay) {
  EXPECT_EQ(encode_mit(1, {}, kDm4310),
            make_frame(1, {0x7F, 0xFF, 0x7F, 0xF0, 0x00, 0x00, 0x07, 0xFF}));
  EXPECT_EQ(encode_mit(1, {1.0, 0, 20, 0.5, 0}, kDm4310),
            make_frame(1, {0x8A, 0x3C, 0x7F, 0xF0, 0xA3, 0x19, 0x97, 0xFF}));
  EXPECT_EQ(encode_mit(1, {0, 3.0, 0, 1.0, 0}, kDm4310),
            make_frame(1, {0x7F, 0xFF, 0x8C, 0xC0, 0x00, 0x33, 0x37, 0xFF}));
  EXPECT_EQ(encode_mit(1, {-12.5, -30, 0, 0, -10}, kDm4310),
            make_frame(1, {0, 0, 0, 0, 0, 0, 0, 0}));
  EXPECT_EQ(encode_mit(1, {0, 0, 0, 0, 5.4}, kDm8009),
            make_frame(1, {0x7F, 0xFF, 0x7F, 0xF0, 0x00, 0x00, 0x08, 0xCC}));
  // AK80-9 and AK10-9 of CubeMars have the same layout.
  EXPECT_EQ(encode_mit(1, {1.0, 2.0, 50, 1.0, -3.0}, {12.5, 50, 18}),
            make_frame(1, {0x8A, 0x3C, 0x85, 0x11, 0x99, 0x33, 0x36, 0xAA}));
  EXPECT_EQ(encode_mit(1, {0, 5, 0, 2, 10}, {12.5, 50, 65}),
            make_frame(1, {0x7F, 0xFF, 0x8C, 0xC0, 0x00, 0x66, 0x69, 0x3A}));
  EXPECT_EQ(encode_mit(1, {3.14159, 0, 100, 2, 0}, {12.5, 8, 144}),
            make_frame(1, {0xA0, 0x2A, 0x7F, 0xF3, 0x33, 0x66, 0x67, 0xFF}));
}

TEST(DamiaoCodec, AsksForRegistersAsTheVectorsSay) {
  EXPECT_EQ(encode_read(1, reg::kTimeout), make_frame(0x7FF, {1, 0, 0x33, 9, 0, 0, 0, 0}));
  EXPECT_EQ(encode_write(1, reg::kTimeout, 2000),
            make_frame(0x7FF, {1, 0, 0x55, 9, 0xD0, 0x07, 0, 0}));
  EXPECT_EQ(encode_read(1, reg::kPMax), make_frame(0x7FF, {1, 0, 0x33, 0x15, 0, 0, 0, 0}));
  EXPECT_EQ(encode_request(1), make_frame(0x7FF, {1, 0, 0xCC, 0, 0, 0, 0, 0}));
  const auto reply = decode_reply(make_frame(0x11, {1, 0, 0x33, 0x15, 0, 0, 0x48, 0x41}), 1);
  ASSERT_TRUE(reply);
  EXPECT_EQ(reply->rid, reg::kPMax);
  EXPECT_EQ(reply->as_float(), 12.5F);
}

TEST(DamiaoCodec, ReadsAFeedback) {
  const auto feedback = decode_feedback(
      make_frame(0x11, {0x11, 0x8A, 0x3C, 0x88, 0x86, 0xCC, 0x23, 0x1E}), 1, kDm4310);
  ASSERT_TRUE(feedback);
  EXPECT_TRUE(feedback->enabled());
  EXPECT_NEAR(feedback->motion.position_rad, 0.99966, 1e-5);
  EXPECT_NEAR(feedback->motion.velocity_radps, 2.0, 1e-3);
  EXPECT_NEAR(feedback->motion.torque_Nm, -1.5018, 1e-4);
  EXPECT_EQ(feedback->mos_degC, 35);
  EXPECT_EQ(feedback->rotor_degC, 30);
}

/// Five fields at their ends would be the frames that enable it or set its zero.
TEST(DamiaoCodec, NeverPacksASpecialFrame) {
  const double inf = std::numeric_limits<double>::infinity();
  for (const double end : {1e3, 1e9, inf}) {
    for (int torque = 0xFF0; torque <= 0xFFF; ++torque) {
      const double torque_Nm = -10 + (torque + 0.5) * 20 / 4095.0;
      const CanFrame frame = encode_mit(1, {end, end, end, end, torque_Nm}, kDm4310);
      EXPECT_FALSE(decode_special(frame, 1)) << test::describe(frame);
      EXPECT_TRUE(decode_mit_raw(frame, 1));
    }
  }
}

TEST(DamiaoCodec, StandsAtTheEndOfARangeAndNeverWraps) {
  for (const double sign : {1.0, -1.0}) {
    const double far = sign * 1e6;
    const auto raw = decode_mit_raw(encode_mit(1, {far, far, far, far, far}, kDm4310), 1);
    ASSERT_TRUE(raw);
    EXPECT_EQ(raw->position, sign > 0 ? 0xFFFF : 0);
    EXPECT_EQ(raw->velocity, sign > 0 ? 0xFFF : 0);
    EXPECT_EQ(raw->torque, sign > 0 ? 0xFFF : 0);
    EXPECT_EQ(raw->stiffness, sign > 0 ? 0xFFE : 0);
    EXPECT_EQ(raw->damping, sign > 0 ? 0xFFE : 0);
  }
  EXPECT_EQ(encode_mit(1, {kNan, kNan, kNan, kNan, kNan}, kDm4310), encode_mit(1, {}, kDm4310));
}

TEST(DamiaoCodec, GivesBackWithinAStepWhatItPacked) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> share(-1, 1);
  for (int i = 0; i < 2000; ++i) {
    const MitCommand in{12.5 * share(random), 30 * share(random), 250 * (share(random) + 1),
                        2.5 * (share(random) + 1), 10 * share(random)};
    const auto raw = decode_mit_raw(encode_mit(7, in, kDm4310), 7);
    ASSERT_TRUE(raw);
    const MitCommand out = scale(*raw, kDm4310);
    EXPECT_NEAR(out.position_rad, in.position_rad, 25 / 65535.0);
    // Beside the middle half a step more: there it reads zero.
    EXPECT_NEAR(out.velocity_radps, in.velocity_radps, 1.5 * 60 / 4095.0);
    EXPECT_NEAR(out.stiffness_Nmprad, in.stiffness_Nmprad, 2 * 500 / 4095.0);
    EXPECT_NEAR(out.damping_Nmsprad, in.damping_Nmsprad, 2 * 5 / 4095.0);
    EXPECT_NEAR(out.torque_Nm, in.torque_Nm, 1.5 * 20 / 4095.0);
  }
}

FrameEffect effect_of(const CanFrame& frame) {
  static const Settings settings = [] {
    Options options(option_table());
    options.set("id", 1.0).set("model", std::string("DM4310"));
    return read_settings(options);
  }();
  return effect(frame, settings);
}

TEST(DamiaoRules, KnowWhatEachFrameDoes) {
  EXPECT_EQ(effect_of(encode_special(1, Special::enable)), FrameEffect::harmless);
  EXPECT_EQ(effect_of(encode_special(1, Special::clear_error)), FrameEffect::harmless);
  EXPECT_EQ(effect_of(encode_special(1, Special::disable)), FrameEffect::stop);
  EXPECT_EQ(effect_of(encode_mit(1, {0, 0, 0, 1, 0}, kDm4310)), FrameEffect::stop);
  EXPECT_EQ(effect_of(encode_mit(1, {3, 0, 0, 1, 0}, kDm4310)), FrameEffect::stop);
  EXPECT_EQ(effect_of(encode_mit(1, {0, 0.1, 0, 1, 0}, kDm4310)), FrameEffect::motion);
  EXPECT_EQ(effect_of(encode_mit(1, {0, 0, 1, 1, 0}, kDm4310)), FrameEffect::motion);
  EXPECT_EQ(effect_of(encode_mit(1, {0, 0, 0, 1, 0.1}, kDm4310)), FrameEffect::motion);
  EXPECT_EQ(effect_of(encode_read(1, reg::kPMax)), FrameEffect::harmless);
  EXPECT_EQ(effect_of(encode_request(1)), FrameEffect::harmless);
  EXPECT_EQ(effect_of(encode_write(1, reg::kTimeout, 2000)), FrameEffect::harmless);
}

TEST(DamiaoRules, ForbidWhatChangesTheMotorForGood) {
  constexpr auto kForbidden = FrameEffect::forbidden;
  EXPECT_EQ(effect_of(encode_special(1, Special::set_zero)), kForbidden);
  EXPECT_EQ(effect_of(make_frame(0x7FF, {1, 0, 0xAA, 0, 0, 0, 0, 0})), kForbidden) << "to flash";
  for (unsigned rid = 0; rid <= 255; ++rid) {
    if (rid == reg::kTimeout) continue;
    EXPECT_EQ(effect_of(encode_write(1, static_cast<std::uint8_t>(rid), 2000)), kForbidden) << rid;
  }
  EXPECT_EQ(effect_of(encode_write(1, reg::kTimeout, 0)), kForbidden) << "none is not configured";
  EXPECT_EQ(effect_of(encode_request(2)), kForbidden) << "another motor's";
  EXPECT_EQ(effect_of(encode_special(2, Special::enable)), kForbidden);
  for (const std::uint32_t id : {0x101U, 0x201U, 0x301U})
    EXPECT_EQ(effect_of(make_frame(id, {0, 0, 0, 0, 0, 0, 0, 0})), kForbidden) << "other modes";
}

}  // namespace
}  // namespace drover::damiao
