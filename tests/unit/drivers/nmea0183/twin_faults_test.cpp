// What can be wrong with the simulated receiver while it says that all is well.
#include "drivers/nmea0183/twin_faults.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "drivers/nmea0183/driver.h"
#include "drivers/nmea0183/entry.h"
#include "drivers/nmea0183/twin.h"
#include "drover/angle.h"
#include "unit/drivers/nmea0183/lines.h"

namespace drover::nmea0183 {
namespace {

using namespace std::chrono_literals;

constexpr double kLatitude_deg = 31.2;
constexpr double kLongitude_deg = 121.5;
constexpr double kMetresPerDegree_east = 95283;  // at that latitude
constexpr double kMetresPerDegree_north = 110873;

/// A robot that drives at 1 m/s and turns to its right by 6 degrees a second, or straight on; its
/// receiver errs by millimetres.
class WrongReceiver : public testing::Test {
 protected:
  static constexpr Duration kTick = 5ms;

  void make(Options options = Options(kNmea0183Entry.twin_options)) {
    options.set("sigma_fix_m", 0.001).set("heading_sigma_deg", 0.01).set("speed_sigma_mps", 0.001);
    twin.emplace(options, 7);
  }
  void run(Duration length) {
    if (!twin) make();
    for (const Time end = now + length; now < end; now += kTick) {
      ahead_deg = wrap_deg(ahead_deg + turn_degps * to_s(kTick));
      east_m += to_s(kTick) * std::sin(to_rad(ahead_deg));
      north_m += to_s(kTick) * std::cos(to_rad(ahead_deg));
      GnssTruth truth;
      truth.latitude_deg = kLatitude_deg + north_m / kMetresPerDegree_north;
      truth.longitude_deg = kLongitude_deg + east_m / kMetresPerDegree_east;
      truth.heading_deg = truth.ahead_deg = truth.course_deg = ahead_deg;
      truth.speed_mps = 1;
      truths.push_back({now, east_m, north_m, ahead_deg});
      std::array<char, 4096> buffer{};
      const auto size = twin->on_tick(now, truth, buffer);
      text.append(buffer.data(), size);
      out.clear();
      driver.on_bytes(test::bytes({buffer.data(), size}), now, out);
      for (const auto& m : out.measurements) measurements.push_back(m);
    }
  }
  void set(const char* state) {
    if (!twin) make();
    ASSERT_TRUE(twin->set_state(state, now)) << state;
  }
  template <class T>
  std::pair<Measurement, T> last() const {
    for (std::size_t i = measurements.size(); i-- > 0;)
      if (const auto* value = std::get_if<T>(&measurements[i].value))
        return {measurements[i], *value};
    ADD_FAILURE() << "nothing was told";
    return {};
  }
  struct Truth {
    Time at;
    double east_m;
    double north_m;
    double ahead_deg;
  };
  Truth truth_at(Time at) const {
    for (std::size_t i = truths.size(); i-- > 0;)
      if (truths[i].at <= at) return truths[i];
    return truths.front();
  }
  /// Of the newest position, against where the robot was when it is said to have been measured.
  Offset error() const {
    const auto [m, p] = last<GnssPosition>();
    const auto truth = truth_at(m.time);
    return {(p.longitude_deg - kLongitude_deg) * kMetresPerDegree_east - truth.east_m,
            (p.latitude_deg - kLatitude_deg) * kMetresPerDegree_north - truth.north_m};
  }
  double heading_error_deg() const {
    const auto [m, h] = last<GnssHeading>();
    return wrap_deg(h.heading_deg - truth_at(m.time).ahead_deg + 180) - 180;
  }

  Time now{50s};
  double turn_degps = 0;
  double ahead_deg = 0;
  double east_m = 0;
  double north_m = 0;
  std::optional<Nmea0183Twin> twin;
  Nmea0183Driver driver{Options(kNmea0183Entry.options)};
  DriverOut out;
  std::string text;
  std::vector<Measurement> measurements;
  std::vector<Truth> truths;
};

TEST_F(WrongReceiver, JumpsInTheDirectionThatItIsTold) {
  set("jump:0.3:90");
  run(1s);
  EXPECT_NEAR(error().east_m, 0, 0.01);
  EXPECT_NEAR(error().north_m, 0.3, 0.01);
  EXPECT_EQ(last<GnssPosition>().second.quality, FixQuality::rtk_fixed);
  set("jump:0");
  run(1s);
  EXPECT_NEAR(error().north_m, 0, 0.01);
}

TEST_F(WrongReceiver, JumpsToTheLeftOfTheRobotAsItStoodThen) {
  ahead_deg = 60;  // its left is 30 degrees west of north
  run(1s);
  set("jump_aside:0.5");
  run(1s);
  EXPECT_NEAR(error().east_m, -0.25, 0.01);
  EXPECT_NEAR(error().north_m, 0.433, 0.01);
  ahead_deg = 240;
  run(1s);
  EXPECT_NEAR(error().north_m, 0.433, 0.01);
}

TEST_F(WrongReceiver, DriftsInADirectionStaysThereAndIsBackAtOnce) {
  run(1s);
  set("drift:20:180");
  run(10s);
  EXPECT_NEAR(error().east_m, -0.2, 0.01);
  EXPECT_NEAR(error().north_m, 0, 0.01);
  set("drift_stays");
  run(5s);
  EXPECT_NEAR(error().east_m, -0.2, 0.01);
  set("drift:20:90");
  run(5s);
  EXPECT_NEAR(error().east_m, -0.2, 0.01);
  EXPECT_NEAR(error().north_m, 0.1, 0.01);
  set("drift:0");
  run(1s);
  EXPECT_NEAR(std::hypot(error().east_m, error().north_m), 0, 0.01);
}

TEST_F(WrongReceiver, DriftsToTheLeftOfTheRobotWhateverItDoesThen) {
  ahead_deg = 90;
  run(1s);
  set("drift_aside:20");
  ahead_deg = 0;
  run(10s);
  EXPECT_NEAR(error().east_m, 0, 0.01);
  EXPECT_NEAR(error().north_m, 0.2, 0.01);
}

TEST_F(WrongReceiver, TellsTheSpeedOfTheSignalsWhileItDrifts) {
  run(1s);
  set("drift_aside:500");
  run(5s);
  EXPECT_NEAR(last<GnssVelocity>().second.speed_mps, 1, 0.05);
}

TEST_F(WrongReceiver, TellsTheSpeedOfItsPositionsWhereItIsMadeSo) {
  make(Options(kNmea0183Entry.twin_options).set("speed_from", std::string("positions")));
  run(5s);
  EXPECT_NEAR(last<GnssVelocity>().second.speed_mps, 1, 0.05);
  set("drift_aside:500");
  run(5s);
  const auto velocity = last<GnssVelocity>().second;
  EXPECT_NEAR(velocity.speed_mps, std::hypot(1, 0.5), 0.05);
  EXPECT_NEAR(velocity.course_deg, 360 - 26.6, 2);
}

TEST_F(WrongReceiver, TellsNoSpeedOfTheWayThatItWasStuck) {
  make(Options(kNmea0183Entry.twin_options).set("speed_from", std::string("positions")));
  run(5s);
  set("stuck");
  run(10s);
  EXPECT_NEAR(last<GnssVelocity>().second.speed_mps, 1, 0.05);
  set("clear");
  for (int i = 0; i < 10; ++i) {
    run(200ms);
    EXPECT_NEAR(last<GnssVelocity>().second.speed_mps, 1, 0.05) << i;
  }
}

TEST_F(WrongReceiver, HasAHeadingThatIsOffUntilItIsNot) {
  set("heading_off:20");
  run(1s);
  EXPECT_NEAR(heading_error_deg(), 20, 0.1);
  EXPECT_EQ(last<GnssPosition>().second.quality, FixQuality::rtk_fixed);
  set("heading_off:-3");
  run(1s);
  EXPECT_NEAR(heading_error_deg(), -3, 0.1);
  set("heading_off:0");
  run(1s);
  EXPECT_NEAR(heading_error_deg(), 0, 0.1);
}

TEST_F(WrongReceiver, HasAHeadingOfAnEarlierEpoch) {
  turn_degps = 6;
  run(2s);
  EXPECT_NEAR(heading_error_deg(), 0, 0.1);
  set("heading_epoch:-0.5");
  run(2s);
  EXPECT_NEAR(heading_error_deg(), -3, 0.1);
  EXPECT_NEAR(std::hypot(error().east_m, error().north_m), 0, 0.01);
}

TEST_F(WrongReceiver, TellsWhatIsOlderThanItsStamp) {
  turn_degps = 6;
  run(2s);
  set("stamp_late:200");
  run(2s);
  EXPECT_NEAR(std::hypot(error().east_m, error().north_m), 0.2, 0.01);
  EXPECT_NEAR(heading_error_deg(), -1.2, 0.1);
  EXPECT_NEAR(to_s(last<GnssPosition>().first.received - last<GnssPosition>().first.time), 0.08,
              0.006);
}

// The driver subtracts what is configured: what is later from the start is stamped late.
TEST_F(WrongReceiver, IsStampedLateWhenItIsSlowerThanConfiguredFromTheStart) {
  make(Options(kNmea0183Entry.twin_options).set("output_latency_s", 0.28));
  run(5s);
  EXPECT_NEAR(error().north_m, -0.2, 0.01);
}

// ... and what becomes later on the way is not, because its UTC tells.
TEST_F(WrongReceiver, FallsBehindByABacklogThatGrowsAndEnds) {
  run(2s);
  set("backlog:20");
  run(10s);
  const auto delay_s = [this] {
    const auto m = last<GnssPosition>().first;
    return to_s(m.received - m.time);
  };
  EXPECT_NEAR(delay_s(), 0.08 + 0.2, 0.01);
  EXPECT_NEAR(error().north_m, 0, 0.02);
  run(20s);
  EXPECT_NEAR(delay_s(), 0.08 + 0.4, 0.02);
  set("backlog:0");
  run(1s);
  EXPECT_NEAR(delay_s(), 0.08, 0.02);
  EXPECT_EQ(driver.health(now).bad, 0U);
}

TEST_F(WrongReceiver, SendsNoSigmasWhereItIsMadeSoOrWhenTheyAreLost) {
  run(1s);
  EXPECT_NE(text.find("GNGST"), std::string::npos);
  set("gst_lost");
  text.clear();
  run(2s);
  EXPECT_EQ(text.find("GNGST"), std::string::npos);
  EXPECT_TRUE(std::isnan(last<GnssPosition>().second.sigma_east_m));
  make(Options(kNmea0183Entry.twin_options).set("gst", false).set("hdt", false));
  text.clear();
  run(2s);
  EXPECT_EQ(text.find("GNGST"), std::string::npos);
  EXPECT_EQ(text.find("GNHDT"), std::string::npos);
  EXPECT_NE(text.find("GNGGA"), std::string::npos);
}

TEST_F(WrongReceiver, TellsSigmasThatAreTooSmall) {
  make(Options(kNmea0183Entry.twin_options)
           .set("gst_factor", 0.3)
           .set("first_fix", std::string("float")));
  run(5s);
  EXPECT_NEAR(last<GnssPosition>().second.sigma_east_m, 0.09, 0.002);
}

TEST_F(WrongReceiver, IsWellAgainWhenItIsCleared) {
  for (const auto* state : {"jump:5:45", "drift_aside:50", "heading_off:90", "heading_epoch:-1",
                            "stamp_late:500", "backlog:100", "gst_lost", "rate:2"})
    set(state);
  run(5s);
  set("clear");
  run(2s);
  EXPECT_NEAR(std::hypot(error().east_m, error().north_m), 0, 0.01);
  EXPECT_NEAR(heading_error_deg(), 0, 0.1);
  EXPECT_FALSE(std::isnan(last<GnssPosition>().second.sigma_east_m));
}

}  // namespace
}  // namespace drover::nmea0183
