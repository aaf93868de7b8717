// The grammar of single fields.
#include "drivers/nmea0183/fields.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <charconv>
#include <clocale>
#include <cmath>
#include <random>
#include <string>

namespace drover::nmea0183 {
namespace {

using namespace std::chrono_literals;

TEST(NmeaFields, RefuseWhatIsNoPlainDecimal) {
  for (const auto* text : {"",    "-",    ".",        "nan",  "NAN",
                           "inf", "-inf", "infinity", "0x10", "1e5",
                           "1E5", "+1",   " 1",       "1 ",   "1.2.3",
                           "--1", "1-",   "1,5",      "٣",    "123456789012345678901"})
    EXPECT_FALSE(parse_decimal(text).has_value()) << text;
}

TEST(NmeaFields, ReadPlainDecimals) {
  EXPECT_EQ(parse_decimal("5327.03942"), 5327.03942);
  EXPECT_EQ(parse_decimal("-21.3"), -21.3);
  EXPECT_EQ(parse_decimal(".5"), 0.5);
  EXPECT_EQ(parse_decimal("5."), 5.0);
  EXPECT_EQ(parse_decimal("007"), 7.0);
}

// The standard library's reading is the nearest double; ours must be the same to the bit.
TEST(NmeaFields, ReadDecimalsAsTheStandardLibraryDoes) {
  std::mt19937 random(1);
  for (int i = 0; i < 200000; ++i) {
    std::string text = random() % 4 == 0 ? "-" : "";
    const auto digits = 1 + random() % 18;
    const auto point = random() % (digits + 2);
    for (std::size_t digit = 0; digit < digits; ++digit) {
      if (digit == point) text += '.';
      text += static_cast<char>('0' + random() % 10);
    }
    double expected = 0;
    std::from_chars(text.data(), text.data() + text.size(), expected, std::chars_format::fixed);
    const auto read = parse_decimal(text);
    ASSERT_TRUE(read) << text;
    ASSERT_EQ(std::bit_cast<std::uint64_t>(*read), std::bit_cast<std::uint64_t>(expected)) << text;
  }
}

TEST(NmeaFields, ReadDecimalsInADecimalCommaLocale) {
  const std::string before = std::setlocale(LC_ALL, nullptr);
  if (std::setlocale(LC_ALL, "de_DE.UTF-8") == nullptr) GTEST_SKIP() << "no de_DE locale here";
  EXPECT_EQ(parse_decimal("5327.03942"), 5327.03942);
  std::setlocale(LC_ALL, before.c_str());
}

TEST(NmeaFields, RefuseWrongAngles) {
  for (const auto* text :
       {"5360.0,N", "9100.0,N", "9000.00001,N", "-5327.0,N", "5327.0,X", "5327.0,", "5327.0,NN",
        "327.0,N", "05327.0,N", "53.27,N", "5327.0e1,N", "nan,N", "5327.0,E", "53 7.0,N", ",X"}) {
    FieldReader fields(text);
    EXPECT_TRUE(std::isnan(fields.latitude_deg(0))) << text;
    EXPECT_FALSE(fields.ok()) << text;
  }
  FieldReader east("18000.00001,E");
  EXPECT_TRUE(std::isnan(east.longitude_deg(0)));
  EXPECT_FALSE(east.ok());
}

TEST(NmeaFields, ReadAngles) {
  FieldReader fields("4134.49795459,N,09345.03431408,W");
  EXPECT_NEAR(fields.latitude_deg(0), 41.5749659098, 5e-11);
  EXPECT_NEAR(fields.longitude_deg(2), -93.7505719013, 5e-11);
  EXPECT_TRUE(fields.ok());
  FieldReader limits("9000.00000,S,18000,E");
  EXPECT_EQ(limits.latitude_deg(0), -90.0);
  EXPECT_EQ(limits.longitude_deg(2), 180.0);
  EXPECT_TRUE(limits.ok());
}

TEST(NmeaFields, TakeEmptyForUnknownAndNotForZero) {
  FieldReader fields("GNGGA,,,,,");
  EXPECT_TRUE(std::isnan(fields.decimal(1, 0, 1)));
  EXPECT_TRUE(std::isnan(fields.latitude_deg(2)));
  EXPECT_FALSE(fields.integer(4, 9).has_value());
  EXPECT_FALSE(fields.time_of_day(1).has_value());
  EXPECT_TRUE(std::isnan(fields.decimal(99, 0, 1)));
  EXPECT_TRUE(fields.ok());
}

TEST(NmeaFields, RefuseTimesThatNoClockShows) {
  for (const auto* text : {"240000", "236000", "103660", "235961", "123460.00", "10360", "1036070",
                           "10:36:07", "103607.0x", "103607.1234567890", "-10360"}) {
    FieldReader fields(text);
    EXPECT_FALSE(fields.time_of_day(0).has_value()) << text;
    EXPECT_FALSE(fields.ok()) << text;
  }
}

TEST(NmeaFields, ReadTimesAndTheLeapSecond) {
  EXPECT_EQ(FieldReader("132819.60").time_of_day(0), 13h + 28min + 19s + 600ms);
  EXPECT_EQ(FieldReader("094737").time_of_day(0), 9h + 47min + 37s);
  EXPECT_EQ(FieldReader("094737.").time_of_day(0), 9h + 47min + 37s);
  EXPECT_EQ(FieldReader("000000.123456789").time_of_day(0), 123456789ns);
  EXPECT_EQ(FieldReader("235960.00").time_of_day(0), 24h);
}

TEST(NmeaFields, WrapDirectionsThatWereRoundedUp) {
  EXPECT_EQ(FieldReader("360.00").direction_deg(0), 0.0);
  EXPECT_EQ(FieldReader("359.99").direction_deg(0), 359.99);
  FieldReader beyond("360.01");
  EXPECT_TRUE(std::isnan(beyond.direction_deg(0)));
  EXPECT_FALSE(beyond.ok());
}

TEST(NmeaFields, AreFoundWhereverTheirCommasStand) {
  std::mt19937 random(3);
  for (int i = 0; i < 3000; ++i) {
    std::string body;
    for (auto count = random() % 70; count > 0; --count)
      body += random() % 4 == 0 ? ',' : random() % 9 == 0 ? '\xAC' : 'x';
    const FieldReader fields(body);
    std::size_t begin = 0;
    for (std::size_t field = 0; field < fields.size(); ++field) {
      const std::size_t end = std::min(body.find(',', begin), body.size());
      ASSERT_EQ(fields.text(field), body.substr(begin, end - begin)) << body << ' ' << field;
      begin = end + 1;
    }
    ASSERT_TRUE(fields.size() == 32 || begin == body.size() + 1) << body;
  }
}

TEST(NmeaFields, ReadEightDecimalsAtOnceOnlyWhereAllAreDigits) {
  EXPECT_EQ(parse_decimal("0.12345678"), 0.12345678);
  EXPECT_EQ(parse_decimal("59.99999999"), 59.99999999);
  EXPECT_EQ(parse_decimal("1.0000000000000001"), 1.0000000000000001);
  EXPECT_EQ(parse_decimal("-0.00000001"), -0.00000001);
  for (int place = 2; place < 10; ++place)
    for (const char wrong : {'/', ':', '.', ' ', '-', '\x00', '\x80', '\xB0', '\xFF', 'e'}) {
      std::string text = "0.12345678";
      text[static_cast<std::size_t>(place)] = wrong;
      EXPECT_FALSE(parse_decimal(text)) << text;
    }
}

TEST(NmeaFields, IgnoreFieldsBeyondTheirNumber) {
  std::string many;
  for (int i = 0; i < 100; ++i) many += "1,";
  FieldReader fields(many);
  EXPECT_EQ(fields.size(), 32U);
  EXPECT_EQ(fields.text(31), "1");
  EXPECT_EQ(fields.text(32), "");
}

}  // namespace
}  // namespace drover::nmea0183
