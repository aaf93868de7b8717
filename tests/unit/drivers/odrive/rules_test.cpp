// What the driver promises about its frames, options and silence.
#include "drivers/odrive/rules.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <string>

#include "drivers/odrive/driver.h"
#include "support/describe.h"

namespace drover::odrive {
namespace {

using std::chrono::milliseconds;
using test::parse_frame;

Options options() {
  return Options(option_table()).set("node", 3.0).set("poll_s", 0.0);
}

TEST(OdriveRules, ForbidWhatMustNeverLeave) {
  const Settings settings = read_settings(options());
  for (const char* text : {"067#00000000",
                           "067#02000000",
                           "067#03000000",
                           "067#07000000",
                           "067#0B000000",
                           "067#0801000000000000",
                           "06B#0100000001000000",
                           "06B#0300000005000000",
                           "06B#0200000008000000",
                           "076#01",
                           "076#02",
                           "076#00",
                           "066#05",
                           "079#00000000",
                           "070#",
                           "07F#",
                           "078#01",
                           "062#",
                           "064#01830100B6F39D3F",
                           "064#00830100",
                           "06C#0000000000000000",
                           "06E#00000000",
                           "7F6#00",
                           "7E6#",
                           "061#R",
                           "06D#00000000"})
    EXPECT_EQ(effect(parse_frame(text), settings), FrameEffect::forbidden) << text;
}

TEST(OdriveRules, TellStopFromMotion) {
  const Settings settings = read_settings(options());
  EXPECT_EQ(effect(parse_frame("06D#0000000000000000"), settings), FrameEffect::stop);
  EXPECT_EQ(effect(parse_frame("06D#0000008000000000"), settings), FrameEffect::stop);  // -0
  EXPECT_EQ(effect(parse_frame("06D#0000004000000000"), settings), FrameEffect::motion);
  EXPECT_EQ(effect(parse_frame("06D#000000000000003F"), settings), FrameEffect::motion);
  EXPECT_EQ(effect(parse_frame("06D#0000C07F00000000"), settings), FrameEffect::motion);
  EXPECT_EQ(effect(parse_frame("067#01000000"), settings), FrameEffect::stop);
  EXPECT_EQ(effect(parse_frame("067#08000000"), settings), FrameEffect::harmless);
}

TEST(OdriveOptions, AreRefusedWithTheirName) {
  const auto refused = [](const Options& values) -> std::string {
    try {
      read_settings(values);
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return "accepted";
  };
  EXPECT_NE(refused(options().set("node", 63.0)).find("node"), std::string::npos);
  EXPECT_NE(refused(options().set("gear_ratio", 0.0)).find("gear_ratio"), std::string::npos);
  EXPECT_NE(refused(options().set("gear_ratio", std::nan(""))).find("gear_ratio"),
            std::string::npos);
  EXPECT_NE(refused(options().set("firmware", std::string("0.4"))).find("firmware"),
            std::string::npos);
  EXPECT_NE(refused(options().set("watchdog_timeout_s", 0.1).set("watchdog_enable_endpoint", 5.0))
                .find("together"),
            std::string::npos);
  EXPECT_NE(refused(options().set("watchdog_timeout_s", 0.005)).find("watchdog_timeout_s"),
            std::string::npos);
  EXPECT_NE(refused(options()
                        .set("firmware", std::string("0.5.6"))
                        .set("watchdog_timeout_s", 0.1)
                        .set("watchdog_enable_endpoint", 5.0)
                        .set("watchdog_timeout_endpoint", 6.0))
                .find("0.5.6"),
            std::string::npos);
  EXPECT_EQ(refused(options()), "accepted");
}

TEST(OdriveSilence, IsToldHonestly) {
  const OdriveDriver none(read_settings(options()), 0);
  EXPECT_FALSE(none.silence().stops);
  EXPECT_NE(none.silence().text.find("for ever"), std::string::npos);
  const OdriveDriver saved(read_settings(options().set("watchdog_timeout_s", 0.1)), 0);
  EXPECT_TRUE(saved.silence().stops);
  EXPECT_EQ(saved.silence().after, milliseconds(100));
  EXPECT_NE(saved.silence().text.find("saved in the drive"), std::string::npos);
}

}  // namespace
}  // namespace drover::odrive
