// The simulated receiver, read by the driver: truth in, measurements out.
#include "drivers/nmea0183/twin.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

#include "drivers/nmea0183/driver.h"
#include "drivers/nmea0183/entry.h"
#include "drover/angle.h"
#include "unit/drivers/nmea0183/lines.h"

namespace drover::nmea0183 {
namespace {

using namespace std::chrono_literals;

constexpr double kLatitude_deg = 31.2;
constexpr double kLongitude_deg = 121.5;
constexpr double kMetresPerDegree_east = 95283;  // at that latitude
constexpr double kMetresPerDegree_north = 110873;

Options twin_defaults() {
  return Options(kNmea0183Entry.twin_options);
}

/// A robot that drives north at `speed_mps` from the start.
class NmeaTwin : public testing::Test {
 protected:
  static constexpr Duration kTick = 5ms;

  void run(Duration length) {
    for (const Time end = now + length; now < end; now += kTick) {
      GnssTruth truth;
      truth.latitude_deg = kLatitude_deg + north_m(now) / kMetresPerDegree_north;
      truth.longitude_deg = kLongitude_deg;
      truth.altitude_m = 10;
      truth.heading_deg = 359.9;
      truth.speed_mps = speed_mps;
      truth.course_deg = 0;
      std::array<char, 4096> buffer{};
      const auto size = twin.on_tick(now, truth, buffer);
      text.append(buffer.data(), size);
      out.clear();
      driver.on_bytes(test::bytes({buffer.data(), size}), now, out);
      for (const auto& m : out.measurements) measurements.push_back(m);
    }
  }
  double north_m(Time t) const { return speed_mps * to_s(t - start); }
  void restart() {
    text.clear();
    measurements.clear();
  }
  template <class T>
  std::vector<std::pair<Measurement, T>> all() const {
    std::vector<std::pair<Measurement, T>> found;
    for (const auto& m : measurements)
      if (const auto* value = std::get_if<T>(&m.value)) found.emplace_back(m, *value);
    return found;
  }
  double east_error_m(const GnssPosition& p) const {
    return (p.longitude_deg - kLongitude_deg) * kMetresPerDegree_east;
  }
  double north_error_m(const Measurement& m, const GnssPosition& p) const {
    return (p.latitude_deg - kLatitude_deg) * kMetresPerDegree_north - north_m(m.time);
  }
  /// Root mean square of the east error.
  double east_rms_m() const {
    double sum = 0;
    const auto positions = all<GnssPosition>();
    for (const auto& [m, p] : positions) sum += east_error_m(p) * east_error_m(p);
    return std::sqrt(sum / static_cast<double>(positions.size()));
  }

  const Time start{50s};
  Time now = start;
  double speed_mps = 0.5;
  Options options = twin_defaults();
  Nmea0183Twin twin{options, 7};
  Nmea0183Driver driver{Options(kNmea0183Entry.options)};
  DriverOut out;
  std::string text;
  std::vector<Measurement> measurements;
};

TEST_F(NmeaTwin, RefusesUnknownStatesAndWrongNumbers) {
  for (const auto* name : {"",
                           "fixed",
                           "lag:",
                           "lag:-1",
                           "lag:2001",
                           "lag:nan",
                           "jump",
                           "jump:x",
                           "rate:0",
                           "rate:100",
                           "bad_checksum:0.5",
                           "nothing:1",
                           ":",
                           "fix:1",
                           "jump:1:",
                           "jump:1:90:2",
                           "jump_aside:1:90",
                           "drift_aside",
                           "heading_off:181",
                           "heading_epoch:0.1",
                           "heading_epoch:-3",
                           "backlog:-1",
                           "backlog:20:3",
                           "backlog:20:0",
                           "stamp_late:-1",
                           "lag:1:2"})
    EXPECT_FALSE(twin.set_state(name, now)) << name;
}

TEST_F(NmeaTwin, RefusesOptionsThatMeanNothing) {
  EXPECT_THROW(Nmea0183Twin(twin_defaults().set("utc_start", std::string("today")), 1),
               std::runtime_error);
  EXPECT_THROW(
      Nmea0183Twin(twin_defaults().set("utc_start", std::string("2026-02-29T00:00:00")), 1),
      std::runtime_error);
  EXPECT_THROW(Nmea0183Twin(twin_defaults().set("talker", std::string("GNX")), 1),
               std::runtime_error);
  EXPECT_THROW(Nmea0183Twin(twin_defaults().set("first_fix", std::string("rtk")), 1),
               std::runtime_error);
}

TEST_F(NmeaTwin, SpeaksFiveSentencesAnEpochThatTheDriverUnderstands) {
  run(10s);
  const auto health = driver.health(now);
  EXPECT_EQ(health.bad, 0U);
  EXPECT_EQ(health.good, 5U * 100U);  // the first epoch is told 80 ms after the start
  EXPECT_EQ(health.state, SourceState::fresh);
  EXPECT_EQ(health.reason.view(), "");
  EXPECT_TRUE(text.starts_with("$GNGGA,080000.00,")) << text.substr(0, 80);
  EXPECT_NE(text.find(",010626,,,R,V*"), std::string::npos);
}

TEST_F(NmeaTwin, TellsTheTruthOfTheInstantThatTheDriverRestores) {
  run(20s);
  const auto positions = all<GnssPosition>();
  ASSERT_GE(positions.size(), 190U);
  for (const auto& [m, p] : positions) {
    EXPECT_EQ(p.quality, FixQuality::rtk_fixed);
    EXPECT_LT(std::abs(north_error_m(m, p)), 0.06);  // a latency forgotten would add 0.04
    EXPECT_LT(std::abs(east_error_m(p)), 0.06);
    EXPECT_NEAR(p.altitude_msl_m + p.undulation_m, 10, 0.1);
    EXPECT_EQ(to_s(now - m.time) > 0, true);
  }
  double mean_m = 0;
  for (const auto& [m, p] : positions) mean_m += north_error_m(m, p);
  EXPECT_LT(std::abs(mean_m / static_cast<double>(positions.size())), 0.03);
}

TEST_F(NmeaTwin, ErrsAsItsKindOfFixDoes) {
  const struct {
    const char* state;
    FixQuality quality;
    double sigma_m;
  } kinds[] = {{"fix", FixQuality::rtk_fixed, 0.01},
               {"float", FixQuality::rtk_float, 0.30},
               {"dgps", FixQuality::dgps, 0.60},
               {"single", FixQuality::single, 2.0}};
  for (const auto& kind : kinds) {
    ASSERT_TRUE(twin.set_state(kind.state, now));
    run(20s);  // the error finds its size
    restart();
    run(1800s);
    // Sixty time constants: the sample's sigma is within a third of the true one.
    EXPECT_NEAR(east_rms_m() / kind.sigma_m, 1.0, 0.35) << kind.state;
    for (const auto& [m, p] : all<GnssPosition>()) ASSERT_EQ(p.quality, kind.quality);
    EXPECT_NEAR(all<GnssPosition>().back().second.sigma_east_m, kind.sigma_m, 0.002);
  }
}

TEST_F(NmeaTwin, ErrsInACorrelatedWay) {
  twin.set_state("single", now);
  run(60s);
  restart();
  run(600s);
  const auto positions = all<GnssPosition>();
  double step = 0;
  for (std::size_t i = 1; i < positions.size(); ++i)
    step += std::pow(east_error_m(positions[i].second) - east_error_m(positions[i - 1].second), 2);
  const double step_rms_m = std::sqrt(step / static_cast<double>(positions.size() - 1));
  // White noise of 2 m would step by 2.8 m; a tenth of its variance is white: 0.9 m.
  EXPECT_LT(step_rms_m, 1.2);
  EXPECT_GT(step_rms_m, 0.5);
}

TEST_F(NmeaTwin, ConvergesWhenTheFixComesBack) {
  twin.set_state("float", now);
  run(60s);
  twin.set_state("fix", now);
  restart();
  run(3s);
  const auto positions = all<GnssPosition>();
  EXPECT_EQ(positions[1].second.quality, FixQuality::rtk_fixed);
  EXPECT_GT(positions[1].second.sigma_east_m, 0.05);
  EXPECT_LT(positions.back().second.sigma_east_m, 0.012);
  EXPECT_LT(std::abs(east_error_m(positions.back().second)), 0.05);
}

TEST_F(NmeaTwin, HasAHeadingWithItsNoiseAcrossNorth) {
  run(60s);
  double sum = 0;
  const auto headings = all<GnssHeading>();
  for (const auto& [m, h] : headings) {
    EXPECT_GE(h.heading_deg, 0.0);
    EXPECT_LT(h.heading_deg, 360.0);
    const double error_deg = wrap_deg(h.heading_deg - 359.9 + 180) - 180;
    sum += error_deg * error_deg;
  }
  EXPECT_NEAR(std::sqrt(sum / static_cast<double>(headings.size())), 0.3, 0.1);
}

TEST_F(NmeaTwin, TellsItsSpeedAndCourse) {
  run(10s);
  ASSERT_GE(all<GnssVelocity>().size(), 95U);
  for (const auto& [m, v] : all<GnssVelocity>()) {
    EXPECT_NEAR(v.speed_mps, 0.5, 0.13);
    EXPECT_LT(std::abs(wrap_deg(v.course_deg + 180) - 180), 15.0);
  }
}

TEST_F(NmeaTwin, HasNothingToTellWithoutSatellites) {
  twin.set_state("none", now);
  run(1s);
  EXPECT_TRUE(all<GnssHeading>().empty());
  EXPECT_TRUE(all<GnssVelocity>().empty());
  ASSERT_FALSE(all<GnssPosition>().empty());
  EXPECT_EQ(all<GnssPosition>().back().second.quality, FixQuality::none);
  EXPECT_EQ(driver.health(now).bad, 0U);
}

TEST_F(NmeaTwin, CanBeSilentAndCanComeBack) {
  run(1s);
  twin.set_state("silent", now);
  restart();
  run(1s);
  EXPECT_EQ(text, "");
  EXPECT_EQ(driver.health(now).state, SourceState::stale);
  twin.set_state("fix", now);
  run(1s);
  EXPECT_EQ(driver.health(now).state, SourceState::fresh);
}

TEST_F(NmeaTwin, CanSpeakGarbage) {
  twin.set_state("garbage", now);
  run(3s);
  EXPECT_GT(text.size(), 5000U);
  EXPECT_TRUE(measurements.empty());
  EXPECT_EQ(driver.health(now).reason.view(), "bytes but no sentence: baud, or another device?");
}

TEST_F(NmeaTwin, CanDamageOneSentenceInTen) {
  twin.set_state("bad_checksum:10", now);
  run(100s);
  const auto health = driver.health(now);
  EXPECT_EQ(health.bad + health.good, 5000U);
  EXPECT_NEAR(static_cast<double>(health.bad), 500.0, 100.0);
}

TEST_F(NmeaTwin, CanLagSoThatTheDriverSeesIt) {
  run(5s);
  EXPECT_TRUE(twin.set_state("lag:1000", now));
  run(3s);
  EXPECT_EQ(driver.health(now).state, SourceState::stale);
  const auto [m, p] = all<GnssPosition>().back();
  EXPECT_NEAR(to_s(m.received - m.time), 1.08, 0.01);
  EXPECT_LT(std::abs(north_error_m(m, p)), 0.06);
  EXPECT_TRUE(twin.set_state("lag:0", now));
  run(3s);
  EXPECT_EQ(driver.health(now).state, SourceState::fresh);
  EXPECT_EQ(driver.health(now).bad, 0U);
}

TEST_F(NmeaTwin, CanChangeItsPace) {
  twin.set_state("rate:1", now);
  run(10s);
  EXPECT_EQ(all<GnssPosition>().size(), 10U);
  twin.set_state("rate:20", now);
  restart();
  run(10s);
  EXPECT_NEAR(static_cast<double>(all<GnssPosition>().size()), 190.0, 12.0);
}

TEST_F(NmeaTwin, CanJumpAndComeBack) {
  run(1s);
  twin.set_state("jump:5", now);
  restart();
  run(1s);
  EXPECT_NEAR(east_error_m(all<GnssPosition>().back().second), 5, 0.06);
  twin.set_state("clear", now);
  run(1s);
  EXPECT_NEAR(east_error_m(all<GnssPosition>().back().second), 0, 0.06);
}

TEST_F(NmeaTwin, CanDriftWithAGoodFix) {
  run(1s);
  twin.set_state("drift:20", now);
  run(10s);
  EXPECT_NEAR(east_error_m(all<GnssPosition>().back().second), 0.2, 0.06);
  EXPECT_EQ(all<GnssPosition>().back().second.quality, FixQuality::rtk_fixed);
}

TEST_F(NmeaTwin, CanTellASpeedAtRestThatIsNoise) {
  speed_mps = 0;
  EXPECT_FALSE(twin.set_state("speed_noise:-1", now));
  ASSERT_TRUE(twin.set_state("speed_noise:0.3", now));
  run(60s);
  double sum_mps = 0;
  const auto said = all<GnssVelocity>();
  for (const auto& one : said) sum_mps += one.second.speed_mps;
  // The length of two errors of 0.3 m/s.
  EXPECT_NEAR(sum_mps / static_cast<double>(said.size()), 0.376, 0.03);
}

TEST_F(NmeaTwin, CanBeStuckWhileItsTimeRuns) {
  run(1s);
  twin.set_state("stuck", now);
  run(200ms);
  restart();
  run(2s);
  const auto positions = all<GnssPosition>();
  EXPECT_EQ(positions.size(), 20U);
  EXPECT_EQ(positions.front().second.latitude_deg, positions.back().second.latitude_deg);
  EXPECT_EQ(driver.health(now).state, SourceState::fresh);
}

TEST_F(NmeaTwin, CanLoseItsCorrections) {
  run(1s);
  twin.set_state("corrections_lost", now);
  run(60s);
  const auto position = all<GnssPosition>().back().second;
  EXPECT_EQ(position.quality, FixQuality::rtk_fixed);
  EXPECT_NEAR(position.correction_age_s, 61, 0.5);
}

TEST_F(NmeaTwin, CanTurnAndLoseItsHeading) {
  twin.set_state("heading_flip", now);
  run(1s);
  EXPECT_NEAR(all<GnssHeading>().back().second.heading_deg, 179.9, 2.0);
  twin.set_state("heading_lost", now);
  restart();
  run(1s);
  EXPECT_TRUE(all<GnssHeading>().empty());
  EXPECT_FALSE(all<GnssPosition>().empty());
}

TEST_F(NmeaTwin, CrossesMidnightAndTheYear) {
  Nmea0183Twin late{twin_defaults().set("utc_start", std::string("2026-12-31T23:59:59")), 7};
  std::string said;
  for (int i = 0; i < 400; ++i) {
    std::array<char, 4096> buffer{};
    GnssTruth truth;
    truth.latitude_deg = kLatitude_deg;
    const auto size = late.on_tick(start + i * kTick, truth, buffer);
    said.append(buffer.data(), size);
  }
  EXPECT_NE(said.find("$GNRMC,235959.90,"), std::string::npos);
  EXPECT_NE(said.find(",311226,,,R,V*"), std::string::npos);
  EXPECT_NE(said.find("$GNRMC,000000.00,"), std::string::npos);
  EXPECT_NE(said.find(",010127,,,R,V*"), std::string::npos);
}

TEST_F(NmeaTwin, WaitsWhenThereIsNoRoomForAnEpoch) {
  std::array<char, 100> small{};
  GnssTruth truth;
  for (int i = 0; i < 40; ++i) EXPECT_EQ(twin.on_tick(start + i * kTick, truth, small), 0U);
  std::array<char, 4096> large{};
  EXPECT_GT(twin.on_tick(start + 40 * kTick, truth, large), 500U);  // two epochs at once
}

TEST_F(NmeaTwin, SaysTheSameForOneSeedAndAnotherThingForAnother) {
  run(5s);
  const std::string first = text;
  Nmea0183Twin same{options, 7};
  Nmea0183Twin different{options, 8};
  std::string again;
  std::string other;
  for (Time t = start; t < now; t += kTick) {
    GnssTruth truth;
    truth.latitude_deg = kLatitude_deg + north_m(t) / kMetresPerDegree_north;
    truth.longitude_deg = kLongitude_deg;
    truth.altitude_m = 10;
    truth.heading_deg = 359.9;
    truth.speed_mps = speed_mps;
    std::array<char, 4096> buffer{};
    again.append(buffer.data(), same.on_tick(t, truth, buffer));
    other.append(buffer.data(), different.on_tick(t, truth, buffer));
  }
  EXPECT_EQ(first, again);
  EXPECT_NE(first, other);
}

}  // namespace
}  // namespace drover::nmea0183
