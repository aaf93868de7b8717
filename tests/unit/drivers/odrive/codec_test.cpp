#include "drivers/odrive/codec.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "drivers/odrive/errors.h"
#include "support/describe.h"

namespace drover::odrive {
namespace {

using test::describe;
using test::parse_frame;

TEST(OdriveCodec, RejectsAHeartbeatOfAnyOtherLength) {
  CanFrame frame = parse_frame("061#0000000008000100");
  for (std::uint8_t len = 0; len < 64; ++len) {
    frame.len = len;
    EXPECT_EQ(decode_heartbeat(frame, Firmware::v0_6).has_value(), len == 8) << int{len};
  }
}

TEST(OdriveCodec, RejectsAQuestionTakenForItsAnswer) {
  CanFrame frame = parse_frame("069#00004841000050C0");
  frame.remote = true;
  EXPECT_FALSE(decode_floats(frame));
  EXPECT_FALSE(decode_heartbeat(frame, Firmware::v0_6));
  EXPECT_FALSE(decode_error_0_6(frame));
  EXPECT_FALSE(decode_motor_error_0_5(frame));
  EXPECT_FALSE(decode_u32_error_0_5(frame));
  EXPECT_FALSE(decode_tx_sdo(frame));
}

TEST(OdriveCodec, RejectsAParameterReplyThatIsShortOrIsAnotherOpcode) {
  EXPECT_FALSE(decode_tx_sdo(parse_frame("065#008301")));
  EXPECT_FALSE(decode_tx_sdo(parse_frame("065#01830100B6F39D3F")));
}

TEST(OdriveCodec, NeverBelongsToAnotherNodeOrAnotherKindOfFrame) {
  CanFrame frame = parse_frame("061#0000000008000100");
  EXPECT_TRUE(belongs_to(frame, 3));
  EXPECT_FALSE(belongs_to(frame, 2));
  frame.extended = true;
  EXPECT_FALSE(belongs_to(frame, 3));
  frame.extended = false;
  frame.fd = true;
  EXPECT_FALSE(belongs_to(frame, 3));
  frame.fd = false;
  frame.error = true;
  EXPECT_FALSE(belongs_to(frame, 3));
}

TEST(OdriveCodec, SendsZeroForWhatIsNotANumber) {
  constexpr double kInf = std::numeric_limits<double>::infinity();
  for (const double value : {std::nan(""), kInf, -kInf})
    EXPECT_EQ(describe(encode_set_input_vel(3, value, value)), "06D#0000000000000000");
}

TEST(OdriveCodec, KeepsAHugeVelocityAFloat) {
  const CanFrame frame = encode_set_input_vel(3, 1e300, -1e300);
  EXPECT_EQ(read_float(frame, 0), std::numeric_limits<float>::max());
  EXPECT_EQ(read_float(frame, 4), -std::numeric_limits<float>::max());
}

// Values of odriverobotics/ODrive, tools/odrive/tests/can_test.py.
TEST(OdriveCodec, EncodesTheVelocityOfTheMakersTest) {
  EXPECT_EQ(describe(encode_set_input_vel(0, -10.5, 0.1234)), "00D#000028C124B9FC3D");
}

TEST(OdriveCodec, EncodesCommandsAsDocumented) {
  EXPECT_EQ(describe(encode_set_input_vel(3, 2.0)), "06D#0000004000000000");
  EXPECT_EQ(describe(encode_set_axis_state(3, kStateClosedLoop)), "067#08000000");
  EXPECT_EQ(describe(encode_set_axis_state(3, kStateIdle)), "067#01000000");
  EXPECT_EQ(describe(encode_clear_errors(3)), "078#00");
  EXPECT_EQ(describe(encode_set_controller_mode(3, kControlVelocity, kInputPassthrough)),
            "06B#0200000001000000");
  EXPECT_EQ(describe(encode_poll(3, cmd::kTemperature)), "075#R");
}

TEST(OdriveCodec, EncodesParameterAccessAsDocumented) {
  EXPECT_EQ(describe(encode_sdo_write_float(0, 0x0183, 1.234F)), "004#01830100B6F39D3F");
  EXPECT_EQ(describe(encode_sdo_read(0, 0x0183)), "004#00830100");
  EXPECT_EQ(describe(encode_sdo_write_bool(0, 0x0183, true)), "004#0183010001");
  const auto value = decode_tx_sdo(parse_frame("005#00830100B6F39D3F"));
  ASSERT_TRUE(value);
  EXPECT_EQ(value->endpoint, 0x0183);
  EXPECT_EQ(value->size, 4);
  EXPECT_FLOAT_EQ(value->as_float(), 1.234F);
}

TEST(OdriveCodec, ReadsTheTwoHeartbeatLayoutsApart) {
  // The same bytes: in 0.6 a procedure result and "trajectory done", in 0.5.6 three error flags.
  const CanFrame frame = parse_frame("061#0000000001030101");
  const auto newer = decode_heartbeat(frame, Firmware::v0_6);
  ASSERT_TRUE(newer);
  EXPECT_EQ(newer->procedure_result, 3);
  EXPECT_TRUE(newer->trajectory_done);
  EXPECT_FALSE(newer->failed());
  const auto older = decode_heartbeat(frame, Firmware::v0_5_6);
  ASSERT_TRUE(older);
  EXPECT_TRUE(older->motor_error && older->encoder_error && older->controller_error);
  EXPECT_FALSE(older->trajectory_done);
  EXPECT_TRUE(older->failed());
}

TEST(OdriveCodec, HeartbeatsSurviveARoundTrip) {
  for (const Firmware firmware : {Firmware::v0_6, Firmware::v0_5_6}) {
    for (unsigned bits = 0; bits < 16; ++bits) {
      Heartbeat in;
      in.error = 0x01020304;
      in.state = 8;
      in.trajectory_done = (bits & 1U) != 0;
      if (firmware == Firmware::v0_6) {
        in.procedure_result = static_cast<std::uint8_t>(bits);
      } else {
        in.motor_error = (bits & 2U) != 0;
        in.encoder_error = (bits & 4U) != 0;
        in.controller_error = (bits & 8U) != 0;
      }
      const CanFrame frame = encode_heartbeat(5, in, firmware);
      const auto out = decode_heartbeat(frame, firmware);
      ASSERT_TRUE(out);
      EXPECT_EQ(out->error, in.error);
      EXPECT_EQ(encode_heartbeat(5, *out, firmware), frame);
    }
  }
}

TEST(OdriveErrors, GiveNoTextForNoError) {
  EXPECT_TRUE(error_text({}, Firmware::v0_6).empty());
  EXPECT_TRUE(error_text({}, Firmware::v0_5_6).empty());
}

TEST(OdriveErrors, MeanDifferentThingsInTheTwoFamilies) {
  EXPECT_EQ(error_text({.axis = 0x800}, Firmware::v0_5_6), "watchdog expired");
  EXPECT_EQ(error_text({.axis = 0x800}, Firmware::v0_6), "bus over regeneration current");
}

TEST(OdriveErrors, NameEveryBitOrShowIt) {
  for (const Firmware firmware : {Firmware::v0_6, Firmware::v0_5_6})
    for (unsigned bit = 0; bit < 32; ++bit)
      EXPECT_FALSE(error_text({.axis = 1U << bit}, firmware).empty()) << bit;
  for (unsigned bit = 0; bit < 64; ++bit)
    EXPECT_FALSE(error_text({.motor = 1ULL << bit}, Firmware::v0_5_6).empty()) << bit;
}

TEST(OdriveErrors, AreCutAndNotOverrunWhenAllBitsAreSet) {
  const ErrorReport all{.axis = ~0U, .motor = ~0ULL, .encoder = ~0U, .controller = ~0U};
  EXPECT_LE(error_text(all, Firmware::v0_5_6).view().size(), 160U);
  EXPECT_GT(error_text(all, Firmware::v0_6).view().size(), 100U);
}

TEST(OdriveErrors, ProcedureResultsBeyondTheTableAreStillSomething) {
  EXPECT_EQ(procedure_text(0), "");
  EXPECT_EQ(procedure_text(14), "not calibrated");
  EXPECT_EQ(procedure_text(255), "unknown procedure result");
}

}  // namespace
}  // namespace drover::odrive
