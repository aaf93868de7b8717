// Sentences that the simulated receiver writes, at the edges of their fields.
#include "drivers/nmea0183/compose.h"

#include <gtest/gtest.h>

#include <array>
#include <string>

namespace drover::nmea0183 {
namespace {

using namespace std::chrono_literals;

std::string composed(const Solution& solution) {
  std::array<char, kMaxEpochBytes> buffer{};
  return std::string(buffer.data(), compose(solution, "GN", buffer));
}

Solution full() {
  Solution s;
  s.utc_of_day = 23h + 59min + 59s + 900ms;
  s.position = {.latitude_deg = -89.99999999999,
                .longitude_deg = -179.99999999999,
                .altitude_msl_m = -12345.6789,
                .undulation_m = -100.1234,
                .quality = FixQuality::rtk_float,
                .satellites = 99,
                .hdop = 99.9,
                .correction_age_s = 9999.9,
                .sigma_east_m = 123.456,
                .sigma_north_m = 123.456};
  s.sigma_up_m = 123.456;
  s.velocity = {199.999, 359.9999};
  s.heading = {359.9999};
  return s;
}

TEST(NmeaCompose, WritesNothingThatDoesNotFit) {
  std::array<char, 100> small{};
  EXPECT_EQ(compose(full(), "GN", small), 0U);
}

TEST(NmeaCompose, FitsTheLongestEpoch) {
  EXPECT_GT(composed(full()).size(), 250U);
}

TEST(NmeaCompose, NeverWritesSixtyMinutesOrThreeHundredSixtyDegrees) {
  const std::string text = composed(full());
  EXPECT_NE(text.find(",9000.00000000,S,18000.00000000,W,"), std::string::npos) << text;
  EXPECT_NE(text.find("HDT,0.000,T"), std::string::npos) << text;
  EXPECT_EQ(text.find("360"), std::string::npos) << text;
}

TEST(NmeaCompose, LeavesUnknownFieldsEmpty) {
  const std::string text = composed(Solution{});
  EXPECT_TRUE(text.starts_with("$GNGGA,000000.00,,,,,0,00,,,M,,M,,*")) << text;
  EXPECT_NE(text.find("$GNRMC,000000.00,V,,,,,,,010126,,,N,V*"), std::string::npos) << text;
  EXPECT_NE(text.find("$GNHDT,,T*05\r\n"), std::string::npos) << text;
}

}  // namespace
}  // namespace drover::nmea0183
