// Epochs, time, sigmas and health of the NMEA 0183 driver.
#include "drivers/nmea0183/driver.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

#include "drivers/nmea0183/entry.h"
#include "unit/drivers/nmea0183/lines.h"

namespace drover::nmea0183 {
namespace {

using namespace std::chrono_literals;
using test::line;

Options defaults() {
  return Options(kNmea0183Entry.options);
}
Time at(Duration since_start) {
  return Time{1000s + since_start};
}

std::string utc(int tenths) {
  const std::string seconds = std::to_string(tenths / 10);
  return "1036" + std::string(2 - seconds.size(), '0') + seconds + "." +
         std::to_string(tenths % 10) + "0";
}
std::string gga(int tenths, char quality = '4') {
  return line("GNGGA," + utc(tenths) + ",5327.03942,N,00214.42462,W," + quality +
              ",20,0.6,56.0,M,48.5,M,1.0,0001");
}
std::string rmc(int tenths) {
  return line("GNRMC," + utc(tenths) + ",A,5327.03942,N,00214.42462,W,1.000,90.0,060326,,,R,V");
}
std::string gst(int tenths, const std::string& north = "0.011", const std::string& east = "0.012") {
  return line("GNGST," + utc(tenths) + ",,,,," + north + "," + east + ",0.020");
}
const std::string kVtg = line("GNVTG,90.0,T,,M,2.000,N,3.704,K,R");
const std::string kHdt = line("GNHDT,244.28,T");

class NmeaDriver : public testing::Test {
 protected:
  void feed(const std::string& text, Time first_byte) {
    out.clear();
    driver.on_bytes(test::bytes(text), first_byte, out);
  }
  template <class T>
  std::vector<Measurement> reported() const {
    std::vector<Measurement> found;
    for (const auto& m : out.measurements)
      if (std::holds_alternative<T>(m.value)) found.push_back(m);
    return found;
  }
  GnssPosition position() const {
    const auto found = reported<GnssPosition>();
    if (found.size() != 1) {
      ADD_FAILURE() << found.size() << " positions";
      return {};
    }
    return std::get<GnssPosition>(found[0].value);
  }
  std::string why(Time now) const { return std::string(driver.health(now).reason.view()); }

  Nmea0183Driver driver{defaults()};
  DriverOut out;
};

TEST_F(NmeaDriver, ReportsNothingForDamagedSentencesAndCountsThem) {
  feed("$GNHDT,244.28,T*14\r\n" + line("GNHDT,400.0,T") + "$GNGGA,1036" + kHdt, at(0ms));
  EXPECT_EQ(out.measurements.size(), 1U);
  EXPECT_EQ(driver.health(at(0ms)).bad, 3U);
  EXPECT_EQ(driver.health(at(0ms)).good, 1U);
}

TEST_F(NmeaDriver, ReportsNoFixForNullIslandAndSaysWhy) {
  feed(line("GNGGA,103607.00,0000.00000,N,00000.00000,E,4,06,5.88,0.0,M,0.0,M,,"), at(0ms));
  EXPECT_EQ(position().quality, FixQuality::none);
  EXPECT_TRUE(std::isnan(position().latitude_deg));
  EXPECT_EQ(why(at(10ms)), "position 0, 0 is not believed");
}

TEST_F(NmeaDriver, ReportsNoHeadingForAnEmptyOne) {
  feed(line("GNHDT,,T") + line("GNTHS,,V"), at(0ms));
  EXPECT_TRUE(out.measurements.empty());
}

TEST_F(NmeaDriver, ReportsNoSpeedForAnInvalidOne) {
  feed(line("GNVTG,90.0,T,,M,2.000,N,3.704,K,N") +
           line("GNRMC,103600.00,V,,,,,2.000,90.0,060326,,,N,V"),
       at(0ms));
  EXPECT_TRUE(out.measurements.empty());
}

TEST_F(NmeaDriver, LeavesOutTheCourseAtLowSpeed) {
  feed(line("GNVTG,124.888,T,,M,0.148,N,0.274,K,D"), at(0ms));
  ASSERT_EQ(reported<GnssVelocity>().size(), 1U);
  const auto velocity = std::get<GnssVelocity>(reported<GnssVelocity>()[0].value);
  EXPECT_NEAR(velocity.speed_mps, 0.0761, 1e-4);
  EXPECT_TRUE(std::isnan(velocity.course_deg));
}

TEST_F(NmeaDriver, RefusesAStaleTimeThatNoEpochCanMeet) {
  EXPECT_THROW(Nmea0183Driver(defaults().set("stale_s", 0.1)), std::runtime_error);
  EXPECT_THROW(Nmea0183Driver(defaults().set("rate_Hz", 1.0)), std::runtime_error);
  EXPECT_NO_THROW(Nmea0183Driver(defaults().set("rate_Hz", 1.0).set("stale_s", 3.0)));
}

TEST_F(NmeaDriver, ReportsThePositionBeforeTheRestOfTheEpochIsIn) {
  feed(gga(0), at(0ms));
  EXPECT_EQ(position().quality, FixQuality::rtk_fixed);
}

TEST_F(NmeaDriver, GivesOneInstantToAnEpochInOneBurst) {
  feed(gga(0) + rmc(0) + kVtg + gst(0) + kHdt, at(0ms));
  ASSERT_EQ(out.measurements.size(), 3U);  // one speed: RMC's came first
  for (const auto& m : out.measurements) EXPECT_EQ(m.time, at(0ms) - 80ms);
  for (const auto& m : out.measurements) EXPECT_EQ(m.received, at(0ms));
}

TEST_F(NmeaDriver, GivesOneInstantToAnEpochInManyChunks) {
  feed(gga(0), at(0ms));
  const Time time = out.measurements[0].time;
  feed(kVtg, at(8ms));
  EXPECT_EQ(out.measurements[0].time, time);
  EXPECT_EQ(out.measurements[0].received, at(8ms));
  feed(kHdt, at(40ms));  // some receivers think longer about the heading
  EXPECT_EQ(out.measurements[0].time, time);
}

TEST_F(NmeaDriver, PlacesASecondEpochInOneChunkByTheLinesPace) {
  const std::string first = gga(0);
  feed(first + gga(1), at(0ms));
  ASSERT_EQ(reported<GnssPosition>().size(), 2U);
  // 10 bits a byte at 115200 bit/s.
  const double expected_s = static_cast<double>(first.size()) * 10 / 115200;
  EXPECT_NEAR(to_s(out.measurements[1].time - out.measurements[0].time), expected_s, 1e-6);
}

TEST_F(NmeaDriver, FreesALateEpochFromItsDelay) {
  feed(gga(0), at(0ms));
  feed(gga(1), at(150ms));
  EXPECT_NEAR(to_s(out.measurements[0].time - at(20ms)), 0, 100e-6);
  EXPECT_EQ(out.measurements[0].received, at(150ms));
}

TEST_F(NmeaDriver, BeginsAnEpochWithAHeadingThatComesBeforeItsPosition) {
  feed(kHdt + gga(0) + kVtg, at(0ms));
  feed(kHdt, at(100ms));
  EXPECT_EQ(out.measurements[0].time, at(20ms));
  feed(gga(1), at(102ms));
  EXPECT_LE(out.measurements[0].time, at(20ms) + 60us);
  EXPECT_GE(out.measurements[0].time, at(20ms));
}

TEST_F(NmeaDriver, DoesNotJoinAHeadingToAnEpochOfLongAgo) {
  feed(gga(0), at(0ms));
  feed(kHdt, at(90ms));  // its own GGA was lost
  EXPECT_EQ(out.measurements[0].time, at(10ms));
}

TEST_F(NmeaDriver, TakesTheSpeedOfRmcOnlyWhereThereIsNoVtg) {
  feed(rmc(0), at(0ms));
  EXPECT_EQ(reported<GnssVelocity>().size(), 1U);
  feed(kVtg, at(5ms));  // the same epoch
  EXPECT_EQ(reported<GnssVelocity>().size(), 0U);
  feed(rmc(1), at(100ms));
  EXPECT_EQ(reported<GnssVelocity>().size(), 0U);
  feed(kVtg, at(105ms));
  EXPECT_EQ(reported<GnssVelocity>().size(), 1U);
}

TEST_F(NmeaDriver, ReportsOneHeadingWhereBothSentencesAreSent) {
  int headings = 0;
  for (int i = 0; i < 10; ++i) {
    feed(gga(i) + kHdt + line("GNTHS,244.28,A"), at(i * 100ms));
    headings += static_cast<int>(reported<GnssHeading>().size());
  }
  EXPECT_EQ(headings, 10);
}

TEST_F(NmeaDriver, UsesTheSigmasOfTheSameEpochWhenTheyComeFirst) {
  feed(gst(0) + gga(0), at(0ms));
  EXPECT_EQ(position().sigma_north_m, 0.011);
  EXPECT_EQ(position().sigma_up_m, 0.020);
  EXPECT_EQ(position().sigma_east_m, 0.012);
}

TEST_F(NmeaDriver, UsesTheSigmasOfTheEpochBeforeWhenTheyComeLast) {
  feed(gga(0), at(0ms));
  EXPECT_TRUE(std::isnan(position().sigma_east_m));
  feed(gst(0), at(20ms));
  feed(gga(1), at(100ms));
  EXPECT_EQ(position().sigma_east_m, 0.012);
}

TEST_F(NmeaDriver, DoesNotGiveAFixedSolutionsSigmasToASingleOne) {
  feed(gga(0) + gst(0), at(0ms));
  feed(gga(1, '1'), at(100ms));
  EXPECT_EQ(position().quality, FixQuality::single);
  EXPECT_TRUE(std::isnan(position().sigma_east_m));
}

TEST_F(NmeaDriver, ForgetsSigmasAfterASecond) {
  feed(gga(0) + gst(0), at(0ms));
  feed(gga(11), at(1100ms));
  EXPECT_TRUE(std::isnan(position().sigma_east_m));
}

TEST_F(NmeaDriver, GoesStaleWhenTheReceiversTimeStandsStill) {
  feed(gga(0), at(0ms));
  for (int i = 1; i <= 5; ++i) {
    feed(gga(0) + kVtg + kHdt, at(i * 100ms));
    EXPECT_TRUE(reported<GnssPosition>().empty());
  }
  EXPECT_EQ(driver.health(at(500ms)).state, SourceState::stale);
  EXPECT_EQ(why(at(500ms)), "the receiver's time does not advance");
}

TEST_F(NmeaDriver, GoesStaleWhenPositionsAreOldWhenTheyCome) {
  for (int i = 0; i < 10; ++i) feed(gga(i), at(i * 100ms));
  for (int i = 10; i < 20; ++i) feed(gga(i), at(i * 100ms + 1s));
  EXPECT_NEAR(to_s(at(1820ms) - out.measurements[0].time), 0, 0.002);
  EXPECT_EQ(driver.health(at(2900ms)).state, SourceState::stale);
  EXPECT_EQ(why(at(2900ms)), "positions are 1.0 s old when they come");
}

TEST_F(NmeaDriver, KeepsItsCourseThroughALeapSecondAndMidnight) {
  const std::string rest = ",5327.03942,N,00214.42462,W,4,20,0.6,56.0,M,48.5,M,1.0,0001";
  const std::vector<std::string> times = {"235959.80", "235959.90", "235960.00", "235960.10",
                                          "235960.20", "000000.00", "000000.10", "000000.20"};
  Time now = at(0ms);
  for (const auto& time : times) {
    feed(line("GNGGA," + time + rest), now);
    ASSERT_EQ(out.measurements.size(), 1U) << time;
    EXPECT_NEAR(to_s(now - out.measurements[0].time), 0.08, 0.001) << time;
    EXPECT_EQ(driver.health(now).state, SourceState::fresh);
    now += 100ms;
  }
}

TEST_F(NmeaDriver, SaysThatThereIsNoDataYet) {
  EXPECT_EQ(driver.health(at(10s)).state, SourceState::never_heard);
  EXPECT_EQ(why(at(10s)), "no data from the receiver");
}

TEST_F(NmeaDriver, AsksForTheBaudWhenBytesMakeNoSentenceForTwoSeconds) {
  for (int i = 0; i <= 21; ++i) feed(std::string(8, '\x80'), at(i * 100ms));
  EXPECT_EQ(why(at(1990ms)), "bytes but no good sentence");
  EXPECT_EQ(why(at(2100ms)), "bytes but no sentence: baud, or another device?");
  EXPECT_EQ(driver.health(at(2100ms)).state, SourceState::never_heard);
}

TEST_F(NmeaDriver, GoesStaleInSilenceAndSaysForHowLong) {
  feed(gga(0), at(0ms));
  EXPECT_EQ(driver.health(at(300ms)).state, SourceState::fresh);
  EXPECT_EQ(driver.health(at(301ms)).state, SourceState::stale);
  EXPECT_EQ(why(at(2500ms)), "receiver silent for 2.5 s");
}

TEST_F(NmeaDriver, SaysThatPositionSentencesAreMissing) {
  feed(kHdt, at(0ms));
  EXPECT_EQ(driver.health(at(0ms)).state, SourceState::fresh);
  EXPECT_EQ(why(at(0ms)), "no position sentence (GGA) yet");
  feed(gga(0), at(100ms));
  for (int i = 2; i < 10; ++i) feed(kHdt, at(i * 100ms));
  EXPECT_EQ(driver.health(at(950ms)).state, SourceState::stale);
  EXPECT_EQ(why(at(950ms)), "no position sentence (GGA)");
}

TEST_F(NmeaDriver, SaysThatThePaceIsNotTheExpectedOne) {
  for (int i = 0; i < 5; ++i) feed(gga(i * 10), at(i * 1s));
  EXPECT_EQ(why(at(4s)), "positions come at 1.0 Hz, 10.0 Hz expected");
}

TEST_F(NmeaDriver, SaysThatTheHeadingWasLost) {
  feed(gga(0) + kHdt, at(0ms));
  for (int i = 1; i < 15; ++i) feed(gga(i) + line("GNHDT,,T"), at(i * 100ms));
  EXPECT_EQ(why(at(1400ms)), "the receiver gives no heading any more");
}

TEST_F(NmeaDriver, SaysThatTheDateIsNotToBeTrusted) {
  feed(gga(0) + line("GNRMC,103600.00,A,,,,,1.000,90.0,230906,,,R,V"), at(0ms));
  EXPECT_EQ(why(at(1ms)), "the receiver's date is in the past (week rollover?)");
  feed(gga(1) + line("GNRMC,103600.10,A,,,,,1.000,90.0,320126,,,R,V"), at(100ms));
  EXPECT_EQ(why(at(101ms)), "the receiver's date does not exist");
}

TEST_F(NmeaDriver, IsSilentAboutAReceiverThatIsWell) {
  for (int i = 0; i < 20; ++i) feed(gga(i) + rmc(i) + kVtg + gst(i) + kHdt, at(i * 100ms));
  EXPECT_EQ(why(at(1950ms)), "");
  EXPECT_EQ(driver.health(at(1950ms)).bad, 0U);
  EXPECT_EQ(driver.health(at(1950ms)).good, 100U);
}

TEST_F(NmeaDriver, ForgetsAHalfSentenceWhenTheLinkComesBack) {
  feed("$GNHDT,244.2", at(0ms));
  driver.on_link_up(at(1s));
  feed("8,T*13\r\n", at(1s));
  EXPECT_TRUE(out.measurements.empty());
}

TEST_F(NmeaDriver, PlacesTimeAnewWhenTheLinkComesBack) {
  feed(gga(0), at(0ms));
  driver.on_link_up(at(1s));
  feed(gga(1), at(2s));
  EXPECT_EQ(out.measurements[0].time, at(2s) - 80ms);
}

TEST_F(NmeaDriver, CountsWhatDoesNotFit) {
  std::string many;
  for (int i = 0; i < 70; ++i) many += gga(i);
  feed(many, at(0ms));
  EXPECT_EQ(out.measurements.size(), 64U);
  EXPECT_EQ(out.overflows, 6U);
}

TEST_F(NmeaDriver, GivesTheSameMeasurementsForAnyChunking) {
  std::string text = "\xB5\x62noise" + kHdt + "$GNGGA,10";
  for (int i = 0; i < 4; ++i) text += gga(i) + rmc(i) + kVtg + gst(i) + kHdt + "$X*00\r\n";
  feed(text, at(0ms));
  const DriverOut whole = out;
  const Duration byte_time = from_s(10.0 / 115200);
  for (const std::size_t chunk : {1U, 2U, 3U, 7U, 64U, 100U}) {
    Nmea0183Driver other{defaults()};
    DriverOut pieces;
    for (std::size_t i = 0; i < text.size(); i += chunk)
      other.on_bytes(test::bytes(std::string_view(text).substr(i, chunk)),
                     at(0ms) + static_cast<int>(i) * byte_time, pieces);
    ASSERT_EQ(pieces.measurements.size(), whole.measurements.size()) << chunk;
    for (std::size_t i = 0; i < whole.measurements.size(); ++i) {
      EXPECT_EQ(pieces.measurements[i].time, whole.measurements[i].time) << chunk;
      EXPECT_EQ(pieces.measurements[i].value.index(), whole.measurements[i].value.index());
    }
    EXPECT_EQ(other.health(at(1s)).bad, driver.health(at(1s)).bad) << chunk;
  }
}

}  // namespace
}  // namespace drover::nmea0183
