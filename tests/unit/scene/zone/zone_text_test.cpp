#include "scene/zone/zone_text.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

#include "tests/unit/scene/zone/zones.h"

namespace drover::scene {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

void expect_same(const Zone& a, const Zone& b) {
  EXPECT_EQ(a.name, b.name);
  EXPECT_EQ(a.kind, b.kind);
  EXPECT_EQ(a.source, b.source);
  EXPECT_EQ(a.polygons, b.polygons);
  ASSERT_EQ(a.datum.has_value(), b.datum.has_value());
  if (!a.datum) return;
  EXPECT_EQ(a.datum->latitude_deg, b.datum->latitude_deg);
  EXPECT_EQ(a.datum->longitude_deg, b.datum->longitude_deg);
  EXPECT_EQ(a.datum->altitude_m, b.datum->altitude_m);
}

TEST(ZoneText, ReadsBackToTheBit) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> some(-1e-5, 1e-5);
  for (int i = 0; i < 1000; ++i) {
    GeoRing outer = box(0, 0, 100, 100);
    for (GeoPoint& point : outer) {
      point.latitude_deg += some(random);
      point.longitude_deg += some(random);
    }
    Zone zone{"园区 \"1\"",
              i % 2 == 0 ? Zone::Kind::keep_in : Zone::Kind::keep_out,
              {{outer, {box(40, 40, 5, 5)}}, {box(200, 0, 1, 1), {}}},
              GeodeticPoint{some(random), 180 * some(random), 1e6 * some(random)},
              "a b.kml"};
    if (i % 3 == 0) zone.datum.reset();
    const auto again = read_zone_text(zone_text(zone));
    ASSERT_TRUE(again.ok()) << again.error().path << " " << again.error().why;
    expect_same(*again, zone);
  }
}
TEST(ZoneText, IsOneLine) {
  EXPECT_EQ(zone_text(zone({{box(0, 0, 5, 5), {}}})).find('\n'), std::string::npos);
}
TEST(ZoneText, OfTheLargestZoneReadsBack) {
  GeoRing teeth;
  for (int i = 0; i < 4999; ++i) {
    teeth.push_back(at(i * 0.1, i % 2 == 0 ? 10.123456789 : 11.987654321));
  }
  for (int i = 4999; i > 0; --i) teeth.push_back(at(i * 0.1, i % 2 == 0 ? 0.1 : 1.2));
  const Zone largest = zone({{teeth, {}}});
  const auto again = read_zone_text(zone_text(largest));
  ASSERT_TRUE(again.ok()) << again.error().path << " " << again.error().why;
  expect_same(*again, largest);
}
TEST(ZoneText, RefusesWhatSaysLessOrMoreThanAZone) {
  const std::string good = zone_text(zone({{box(0, 0, 5, 5), {}}}));
  ASSERT_TRUE(read_zone_text(good).ok());
  const auto changed = [&](const std::string& what, const std::string& to) {
    std::string text = good;
    const auto begin = text.find(what);
    EXPECT_NE(begin, std::string::npos) << what;
    return text.replace(begin, what.size(), to);
  };
  for (const std::string& bad :
       {std::string(), std::string("[]"), good.substr(0, good.size() - 1),
        changed("\"name\":\"zone\",", ""), changed("\"name\":\"zone\"", "\"name\":7"),
        changed("keep_out", "keep"), changed("\"datum\":", "\"data\":"),
        changed("\"altitude_m\":500", "\"altitude_m\":null"),
        changed("\"latitude_deg\":48", "\"latitude_deg\":98"),
        changed("[\"latitude_deg\",\"longitude_deg\"]", "[\"longitude_deg\",\"latitude_deg\"]"),
        changed("\"holes\":[]", "\"holes\":null"), changed(",\"holes\":[]", ""),
        changed("\"holes\":[]", "\"holes\":[],\"from_s\":7"), changed("[[48,11]", "[[48]"),
        changed("[[48,11]", "[[\"48\",11]"), changed("\"source\"", "\"until_s\":7,\"source\""),
        changed("{\"outer\"", "7,{\"outer\"")}) {
    EXPECT_FALSE(read_zone_text(bad).ok()) << bad;
  }
}
TEST(ZoneText, RefusesAZoneThatIsNone) {
  Zone bad = zone({{box(0, 0, 5, 5), {}}});
  std::swap(bad.polygons[0].outer[0], bad.polygons[0].outer[1]);
  const auto read = read_zone_text(zone_text(bad));
  ASSERT_FALSE(read.ok());
  EXPECT_THAT(read.error().path, HasSubstr("polygons[0].outer"));
}
TEST(ZoneText, OneThatCannotBeReadMakesTheFenceUnknown) {
  const std::string good = zone_text(zone({{box(0, 0, 5, 5), {}}}));
  EXPECT_TRUE(read_zone_texts({}).known());
  EXPECT_TRUE(read_zone_texts({good, good}).known());
  const KnownZones found = read_zone_texts({good, "{}", good});
  EXPECT_FALSE(found.known());
  EXPECT_EQ(found.zones.size(), 2U);
  EXPECT_THAT(found.problems, ElementsAre(HasSubstr("stored zone 2")));
}

}  // namespace
}  // namespace drover::scene
