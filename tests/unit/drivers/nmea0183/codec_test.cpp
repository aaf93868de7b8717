// Decoding of single sentences: first what must not be believed, then real sentences.
#include "drivers/nmea0183/codec.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace drover::nmea0183 {
namespace {

using namespace std::chrono_literals;

template <class T>
T decoded(std::string_view body) {
  const auto sentence = decode(body);
  if (!sentence || !std::holds_alternative<T>(*sentence)) {
    ADD_FAILURE() << "not decoded as expected: " << body;
    return T{};
  }
  return std::get<T>(*sentence);
}

void expect_no_fix(const Gga& gga, Oddity oddity) {
  EXPECT_EQ(gga.position.quality, FixQuality::none);
  EXPECT_TRUE(std::isnan(gga.position.latitude_deg));
  EXPECT_TRUE(std::isnan(gga.position.longitude_deg));
  EXPECT_EQ(gga.oddity, oddity);
}

TEST(NmeaGga, RejectsSentencesWithFieldsOutOfRange) {
  for (const auto* body : {
           "GNGGA,103607.00,5360.00000,N,00214.42462,W,4,06,5.88,56.0,M,48.5,M,,",
           "GNGGA,103607.00,9100.00000,N,00214.42462,W,4,06,5.88,56.0,M,48.5,M,,",
           "GNGGA,246007.00,5327.03942,N,00214.42462,W,4,06,5.88,56.0,M,48.5,M,,",
           "GNGGA,103607.00,nan,N,00214.42462,W,4,06,5.88,inf,M,48.5,M,,",
           "GNGGA,103607.00,5327.03942,N,00214.42462,W,4,06,5.88,inf,M,48.5,M,,",
           "GNGGA,103607.00,5327.03942,X,00214.42462,W,4,06,5.88,56.0,M,48.5,M,,",
           "GNGGA,103607.00,5327.03942,N,-0214.41467,W,4,06,5.88,56.0,M,48.5,M,,",
           "GNGGA,103607.00,5327.03942,N,18014.42462,W,4,06,5.88,56.0,M,48.5,M,,",
           "GNGGA,103607.00,5327.03942,N,00214.42462,W,4x,06,5.88,56.0,M,48.5,M,,",
           "GNGGA,103607.00,5327.03942,N,00214.42462,W,44,06,5.88,56.0,M,48.5,M,,",
           "GNGGA,103607.00,5327.03942,N,00214.42462,W,-4,06,5.88,56.0,M,48.5,M,,",
           "GNGGA,103607.00,5327.03942,N,00214.42462,W,4,06,5.88,56.0,f,48.5,M,,",
           "GNGGA,103607.00,5327.03942,N,00214.42462,W,4,06,5.88,56.0,M,1e3,M,,",
           "GNGGA,103607.00,5327.03942,N,00214.42462,W,4,06,5.88,56.0,M,48.5,M,-1,",
           "GNGGA,103607.00,5327.03942,N,00214.42462,W,4,06,0x5,56.0,M,48.5,M,,",
       }) {
    const auto sentence = decode(body);
    ASSERT_FALSE(sentence.ok()) << body;
    EXPECT_EQ(sentence.error(), Defect::malformed) << body;
  }
}

TEST(NmeaGga, RejectsASentenceThatEndsBeforeItsQuality) {
  const auto sentence = decode("GNGGA,103607.00,5327.03942,N,00214.42462,W");
  ASSERT_FALSE(sentence.ok());
  EXPECT_EQ(sentence.error(), Defect::too_short);
}

TEST(NmeaGga, TakesAFixWithoutAPositionForNone) {
  expect_no_fix(decoded<Gga>("GNGGA,103607.00,,,,,4,06,5.88,56.0,M,48.5,M,,"),
                Oddity::position_missing);
}

TEST(NmeaGga, DoesNotBelieveNullIsland) {
  expect_no_fix(decoded<Gga>("GNGGA,103607.00,0000.00000,N,00000.00000,E,4,06,5.88,0.0,M,0.0,M,,"),
                Oddity::null_island);
  expect_no_fix(decoded<Gga>("GNGGA,103607.00,0000.00000,S,00000.00000,W,1,06,5.88,0.0,M,0.0,M,,"),
                Oddity::null_island);
}

TEST(NmeaGga, DoesNotBelieveAFixWithUnknownHdop) {
  expect_no_fix(
      decoded<Gga>("GNGGA,103607.00,5327.03942,N,00214.42462,W,4,06,99.9,56.0,M,48.5,M,,"),
      Oddity::absurd_hdop);
}

TEST(NmeaGga, TakesUnknownQualityForSingleAndNeverForRtk) {
  const auto gga =
      decoded<Gga>("GNGGA,103607.00,5327.03942,N,00214.42462,W,9,06,5.88,56.0,M,48.5,M,,");
  EXPECT_EQ(gga.position.quality, FixQuality::single);
  EXPECT_EQ(gga.oddity, Oddity::unknown_quality);
}

TEST(NmeaGga, HidesThePositionOfAReceiverWithoutFix) {
  expect_no_fix(
      decoded<Gga>("GNGGA,103607.00,5327.03942,N,00214.42462,W,0,00,99.99,56.0,M,48.5,M,,"),
      Oddity::none);
}

TEST(NmeaGga, IgnoresTheSecondAntenna) {
  EXPECT_TRUE(std::holds_alternative<Other>(*decode("GNGGAH,085947.90,,,,,0,00,9999.0,,,,,,")));
  EXPECT_TRUE(std::holds_alternative<Other>(*decode("GNTHS2,45.20,A")));
  EXPECT_TRUE(std::holds_alternative<Other>(
      *decode("GNGSTH,055543.00,0.45,0.01,0.01,127.6430,0.010,0.010,0.019")));
}

TEST(NmeaGga, IgnoresMakersSentencesThatEndInGga) {
  EXPECT_TRUE(std::holds_alternative<Other>(*decode("PXGGA,1,2,3,4,5,6,7")));
}

TEST(NmeaGga, ReadsADifferentialFix) {
  const auto gga = decoded<Gga>(
      "GNGGA,132819.60,4134.49795459,N,09345.03431408,W,2,10,0.9,278.161,M,-31.442,M,6.6,0133");
  EXPECT_EQ(gga.utc, 13h + 28min + 19s + 600ms);
  EXPECT_NEAR(gga.position.latitude_deg, 41.5749659098, 5e-11);
  EXPECT_NEAR(gga.position.longitude_deg, -93.7505719013, 5e-11);
  EXPECT_EQ(gga.position.quality, FixQuality::dgps);
  EXPECT_EQ(gga.position.satellites, 10);
  EXPECT_EQ(gga.position.hdop, 0.9);
  EXPECT_EQ(gga.position.altitude_msl_m, 278.161);
  EXPECT_EQ(gga.position.undulation_m, -31.442);
  EXPECT_EQ(gga.position.correction_age_s, 6.6);
  EXPECT_TRUE(std::isnan(gga.position.sigma_east_m));
}

TEST(NmeaGga, ReadsRtkFloatAndFixed) {
  const auto floating = decoded<Gga>(
      "GNGGA,091510.00,5057.25505246,N,00653.73013267,E,5,24,0.6,48.3615,M,46.9156,M,1.0,0");
  EXPECT_EQ(floating.position.quality, FixQuality::rtk_float);
  EXPECT_EQ(floating.position.correction_age_s, 1.0);
  const auto fixed = decoded<Gga>(
      "GNGGA,123519.00,4250.000000,N,07630.000000,W,4,20,0.7,100.000,M,-30.000,M,0.8,0001");
  EXPECT_EQ(fixed.position.quality, FixQuality::rtk_fixed);
  EXPECT_NEAR(fixed.position.latitude_deg, 42.8333333333, 5e-11);
  EXPECT_EQ(fixed.position.longitude_deg, -76.5);
}

TEST(NmeaGga, ReadsTheAgeOfOldCorrections) {
  const auto gga =
      decoded<Gga>("GNGGA,103607.00,5327.03942,N,00214.42462,W,4,30,0.60,56.0,M,48.5,M,61.0,0001");
  EXPECT_EQ(gga.position.quality, FixQuality::rtk_fixed);
  EXPECT_EQ(gga.position.correction_age_s, 61.0);
}

TEST(NmeaGga, ReadsAReceiverWithoutFix) {
  const auto gga = decoded<Gga>("GNGGA,085947.90,,,,,0,00,9999.0,,,,,,");
  expect_no_fix(gga, Oddity::none);
  EXPECT_EQ(gga.utc, 8h + 59min + 47s + 900ms);
  EXPECT_TRUE(std::isnan(gga.position.hdop));
}

TEST(NmeaGga, TakesMissingFieldsAtTheEndForUnknown) {
  const auto gga = decoded<Gga>("GNGGA,103607.00,5327.03942,N,00214.42462,W,4,06,5.88,56.0,M");
  EXPECT_EQ(gga.position.quality, FixQuality::rtk_fixed);
  EXPECT_EQ(gga.position.altitude_msl_m, 56.0);
  EXPECT_TRUE(std::isnan(gga.position.undulation_m));
  EXPECT_TRUE(std::isnan(gga.position.correction_age_s));
}

TEST(NmeaRmc, TakesStatusVWithNumbersForInvalid) {
  const auto rmc = decoded<Rmc>("GNRMC,103607.00,V,5327.03942,N,00214.42462,W,0.046,,060321,,,N,V");
  EXPECT_FALSE(rmc.valid);
  EXPECT_TRUE(std::isnan(rmc.velocity.speed_mps));
  EXPECT_FALSE(decoded<Rmc>("GPRMC,235959.00,V,0000.0000,N,00000.0000,E,,,250910,,,N").valid);
}

TEST(NmeaRmc, TakesModeNForInvalid) {
  EXPECT_FALSE(
      decoded<Rmc>("GNRMC,103607.00,A,5327.03942,N,00214.42462,W,0.046,,060321,,,N,V").valid);
}

TEST(NmeaRmc, RejectsAnUnknownStatusAndNegativeSpeed) {
  EXPECT_FALSE(decode("GNRMC,103607.00,B,5327.03942,N,00214.42462,W,0.046,,060321,,,A").ok());
  EXPECT_FALSE(decode("GNRMC,103607.00,A,5327.03942,N,00214.42462,W,-0.04,,060321,,,A").ok());
  EXPECT_FALSE(decode("GNRMC,103607.00,A,9127.03942,N,00214.42462,W,0.046,,060321,,,A").ok());
  EXPECT_FALSE(decode("GNRMC,103607.00,A").ok());
}

TEST(NmeaRmc, RejectsOnlyTheDateWhenOnlyTheDateIsWrong) {
  for (const auto* date : {"320121", "310421", "290221", "001221", "011321", "0112", "01122a"}) {
    const auto rmc = decoded<Rmc>("GNRMC,103607.00,A,5327.03942,N,00214.42462,W,0.046,," +
                                  std::string(date) + ",,,A,V");
    EXPECT_TRUE(rmc.valid) << date;
    EXPECT_EQ(rmc.oddity, Oddity::bad_date) << date;
    EXPECT_EQ(rmc.year, 0) << date;
  }
}

TEST(NmeaRmc, FlagsADateFromBeforeThisProgram) {
  const auto rmc = decoded<Rmc>("GNRMC,103607.00,A,5327.03942,N,00214.42462,W,0.046,,230906,,,A,V");
  EXPECT_EQ(rmc.oddity, Oddity::old_date);
  EXPECT_EQ(rmc.year, 2006);
  EXPECT_EQ(decoded<Rmc>("GNRMC,103607.00,A,,,,,0.046,,070287,,,A,V").year, 1987);
}

TEST(NmeaRmc, TakesNavStatusVForNotProvided) {
  const auto rmc = decoded<Rmc>("GNRMC,103607.00,A,5327.03942,N,10214.42462,W,0.046,,060326,,,A,V");
  EXPECT_TRUE(rmc.valid);
  EXPECT_TRUE(std::isnan(rmc.velocity.course_deg));
  EXPECT_EQ(rmc.oddity, Oddity::none);
}

TEST(NmeaRmc, ReadsSpeedCourseAndDate) {
  const auto rmc = decoded<Rmc>(
      "GNRMC,132819.60,A,4134.49795459,N,09345.03431408,W,0.148,124.888,180320,11.5985,E,D");
  EXPECT_NEAR(rmc.velocity.speed_mps, 0.076138, 5e-7);
  EXPECT_EQ(rmc.velocity.course_deg, 124.888);
  EXPECT_EQ(rmc.year, 2020);
  EXPECT_EQ(rmc.month, 3);
  EXPECT_EQ(rmc.day, 18);
  EXPECT_EQ(decoded<Rmc>("GNRMC,235960.00,A,5327.03942,N,00214.42462,W,0.046,,311216,,,A,V").utc,
            24h);
}

TEST(NmeaVtg, TakesModeNForNoSpeed) {
  EXPECT_TRUE(std::isnan(decoded<Vtg>("GNVTG,1.0,T,,M,2.0,N,3.7,K,N").velocity.speed_mps));
}

TEST(NmeaVtg, RejectsWrongUnits) {
  EXPECT_FALSE(decode("GNVTG,1.0,M,,M,2.0,N,3.7,K,A").ok());
  EXPECT_FALSE(decode("GNVTG,1.0,T,,M,2.0,K,3.7,N,A").ok());
  EXPECT_FALSE(decode("GNVTG,1.0,T").ok());
}

TEST(NmeaVtg, ReadsKnotsAndKilometresPerHour) {
  const auto vtg = decoded<Vtg>("GPVTG,220.86,T,,M,2.550,N,4.724,K,A");
  EXPECT_EQ(vtg.velocity.course_deg, 220.86);
  EXPECT_NEAR(vtg.velocity.speed_mps, 1.31183, 5e-6);
  EXPECT_NEAR(decoded<Vtg>("GPVTG,220.86,T,,M,,N,4.724,K,A").velocity.speed_mps, 1.31222, 5e-6);
  EXPECT_TRUE(std::isnan(decoded<Vtg>("GNVTG,,T,,M,0.046,N,0.085,K,A").velocity.course_deg));
}

TEST(NmeaVtg, ReadsTheOldFormWithoutLetters) {
  const auto vtg = decoded<Vtg>("GPVTG,220.86,219.0,2.550,4.724");
  EXPECT_EQ(vtg.velocity.course_deg, 220.86);
  EXPECT_NEAR(vtg.velocity.speed_mps, 1.31183, 5e-6);
}

TEST(NmeaGst, TakesZeroAndEmptySigmasForUnknown) {
  const auto gst = decoded<Gst>("GNGST,181141.00,46,,,,0.000,,5.3");
  EXPECT_TRUE(std::isnan(gst.sigma_north_m));
  EXPECT_TRUE(std::isnan(gst.sigma_east_m));
  EXPECT_FALSE(decode("GNGST,181141.00,46,,,,-4.7,1.9,5.3").ok());
  EXPECT_FALSE(decode("GNGST,181141.00,46,,,,4.7,1.9").ok());
}

TEST(NmeaGst, ReadsSigmasOfLatitudeAndLongitudeNotOfTheEllipse) {
  const auto gst = decoded<Gst>("GNGST,193334.00,142,3.2,2.1,68,0.93,1.2,2.3");
  EXPECT_EQ(gst.utc, 19h + 33min + 34s);
  EXPECT_EQ(gst.sigma_north_m, 0.93);
  EXPECT_EQ(gst.sigma_east_m, 1.2);
  EXPECT_EQ(gst.sigma_up_m, 2.3);
  EXPECT_EQ(decoded<Gst>("GNGST,181141.00,235111,,,,4.7,1.9,5.3").sigma_east_m, 1.9);
}

TEST(NmeaHeading, IsNeverZeroWhenItIsAbsent) {
  EXPECT_TRUE(std::isnan(decoded<Heading>("GNHDT,,T").heading_deg));
  EXPECT_TRUE(std::isnan(decoded<Heading>("GPTHS,,V").heading_deg));
  EXPECT_TRUE(std::isnan(decoded<Heading>("GNTHS,,A").heading_deg));
}

TEST(NmeaHeading, IsNotTakenFromEstimatesSimulatorsOrInvalidRecords) {
  for (const auto* body : {"GNTHS,45.20,E", "GNTHS,45.20,M", "GNTHS,45.20,S", "GNTHS,0.00,V"})
    EXPECT_TRUE(std::isnan(decoded<Heading>(body).heading_deg)) << body;
}

TEST(NmeaHeading, RejectsMagneticAndImpossibleHeadings) {
  EXPECT_FALSE(decode("GNHDT,244.28,M").ok());
  EXPECT_FALSE(decode("GNHDT,244.28").ok());
  EXPECT_FALSE(decode("GNHDT,360.01,T").ok());
  EXPECT_FALSE(decode("GNHDT,-1.0,T").ok());
  EXPECT_FALSE(decode("GNHDT,nan,T").ok());
}

TEST(NmeaHeading, ReadsHdtAndThs) {
  EXPECT_EQ(decoded<Heading>("GNHDT,244.28,T").heading_deg, 244.28);
  EXPECT_EQ(decoded<Heading>("GNTHS,179.0284,A").heading_deg, 179.0284);
  EXPECT_EQ(decoded<Heading>("HEHDT,360.00,T").heading_deg, 0.0);
}

TEST(NmeaCodec, LeavesOtherSentencesAlone) {
  for (const auto* body :
       {"", ",", "GN", "GNGGA2,1", "GNGSA,A,3,23,24,20,12,,,,,,,,,9.62,5.88,7.62,1",
        "GPGSV,3,2,11,17,32,064,16,19,33,094,,20,20,251,31,21,04,354,,1", "SNRSTAT,1", "GYOACC"}) {
    const auto sentence = decode(body);
    ASSERT_TRUE(sentence.ok()) << body;
    EXPECT_TRUE(std::holds_alternative<Other>(*sentence)) << body;
  }
}

}  // namespace
}  // namespace drover::nmea0183
