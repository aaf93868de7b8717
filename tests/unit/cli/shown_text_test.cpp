#include "cli/shown_text.h"

#include <gmock/gmock.h>

#include <map>
#include <set>

#include "cli/measurement.h"
#include "drover/describe_snapshot.h"
#include "unit/cli/parsed.h"

namespace drover::cli {
namespace {

/// Every name that is shown, with the decimals that it has somewhere.
struct Names {
  template <class T>
  void value(const char*, const T&) {}
  template <class T>
  void value(const char* name, const T&, const Shown& shown) {
    decimals[shown.as != nullptr ? shown.as : name].insert(shown.decimals);
  }
  template <class Visit>
  void inside(const char*, const Visit& visit) {
    visit();
  }
  void vector(const char* name, const Vector3&, const Shown& shown, bool) {
    decimals[name].insert(shown.decimals);
  }
  void derived(const char* name, double, const Shown& shown) {
    decimals[name].insert(shown.decimals);
  }
  std::map<std::string, std::set<int>> decimals;
};

template <class T>
Names names_of(const T& it) {
  Names names;
  describe(names, it);
  return names;
}

TEST(ShownValues, HaveOnePrecisionWhateverTheyAreAPartOf) {
  Names names;
  const auto add = [&names](const auto&... it) { (describe(names, it), ...); };
  add(AxisMotion{}, AxisStatus{}, AxisTemperature{}, AxisSupply{}, GnssPosition{}, GnssVelocity{},
      GnssHeading{}, LineState{}, ImuSample{}, BatterySample{}, BodyMotion{});
  add(Pose{}, NavSnapshot{}, AxisSnapshot{}, BaseSnapshot{}, GnssSnapshot{}, ImuSnapshot{},
      BatterySnapshot{}, SensorSnapshot{}, LinkSnapshot{}, GeodeticPoint{});
  for (const auto& [name, decimals] : names.decimals) EXPECT_EQ(decimals.size(), 1U) << name;
}

TEST(ShownValues, OfASnapshotHaveAllThatItsMeasurementHas) {
  const auto all_in = [](const Names& part, const Names& whole) {
    for (const auto& [name, decimals] : part.decimals)
      EXPECT_EQ(whole.decimals.count(name), 1U) << name;
  };
  all_in(names_of(GnssPosition{}), names_of(GnssSnapshot{}));
  all_in(names_of(BatterySample{}), names_of(BatterySnapshot{}));
  all_in(names_of(AxisSupply{}), names_of(AxisSnapshot{}));
  SensorSnapshot spare;
  spare.last = GnssPosition{};
  all_in(names_of(GnssPosition{}), names_of(spare));
  spare.last = BatterySample{};
  all_in(names_of(BatterySample{}), names_of(spare));
}

TEST(ShownValues, AreTheSameInARecordingAndLive) {
  Measurement measured;
  GnssPosition position;
  position.latitude_deg = 42.5;
  position.hdop = 0.71;
  measured.value = position;
  const auto recorded = measurement_text(measured, {}, {"byte", 1, 0, ""});
  const auto live = parsed(measurement_json(measured, {}, {"byte", 1, 0, ""}));
  for (const auto* name : {"latitude_deg", "hdop", "satellites", "correction_age_s"})
    EXPECT_THAT(recorded, testing::HasSubstr(said(live, name))) << name;
}

TEST(ShownValues, HaveTheUnitThatTheirNameEndsIn) {
  const auto node = parsed(R"({"speed_mps":-0.0001,"soc_percent":83.25,"hdop":null,
      "gyro_bias_radps":[0.5,null,-1]})");
  EXPECT_EQ(said(node, "speed_mps"), "0.000 m/s") << "what rounds to zero is zero";
  EXPECT_EQ(said("charge", node, "soc_percent"), "charge 83.2 %");
  EXPECT_EQ(said(node, "hdop"), "-");
  EXPECT_EQ(said(node, "course_deg"), "-") << "of an older droverd";
  EXPECT_EQ(said_vector(node, "gyro_bias_radps"), "x  0.50000  y -  z -1.00000  rad/s");
}

TEST(ShownValues, OfAMisspeltNameAreAMistakeOfTheProgram) {
  EXPECT_THROW((void)said(json::Node{}, "speed_kmh"), std::logic_error);
}

}  // namespace
}  // namespace drover::cli
