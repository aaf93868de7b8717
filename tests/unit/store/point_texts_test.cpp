#include "store/point_texts.h"

#include <gtest/gtest.h>

#include "store/derive.h"
#include "store/track_file.h"

namespace drover::store {
namespace {

/// Spellings that a double would change.
Track spelled() {
  Track track{"t", {}, {}};
  track.points.assign(2, {113.0196366456667, 23, 90, 1, -0.0, 0.1, 0});
  for (int i = 0; i < 2; ++i)
    append_point(track.numbers,
                 {"113.019636645666700001", "23.0", "9e1", "1.00", "-0", "1E-1", "0"});
  return track;
}

std::string all(const Track& track) {
  std::string text;
  PointTexts texts(track);
  for (PointText point; texts.next(point);) {
    for (const auto number : point) text += std::string(number) + " ";
    text += "/ ";
  }
  return text;
}

TEST(PointTexts, GivesEachNumberAsItCame) {
  const std::string point = "113.019636645666700001 23.0 9e1 1.00 -0 1E-1 0 / ";
  EXPECT_EQ(all(spelled()), point + point);
}

TEST(PointTexts, SpellsWhatHasNoSpelling) {
  const Track track{"t", {{113.5, 23, 90, 0.1, -2, 0, 0}, {1, 2, 3, 4, 5, 6, 7}}, {}};
  EXPECT_EQ(all(track), "113.5 23 90 0.1 -2 0 0 / 1 2 3 4 5 6 7 / ");
  EXPECT_EQ(all(Track{}), "");
}

TEST(PointTexts, AFileKeepsTheSpelling) {
  const auto again = decode_track(encode_track(spelled()));
  ASSERT_TRUE(again.ok());
  EXPECT_EQ(all(*again), all(spelled()));
  EXPECT_EQ(again->points[0].angle_deg, 90);
}

TEST(PointTexts, AnotherOriginChangesXAndYOnly) {
  Track track = spelled();
  track.origin = GeodeticPoint{23.0, 113.0, 10.0};
  const Track derived = derive(track, GeodeticPoint{23.001, 113.0, 10.0});
  PointTexts texts(derived);
  PointText point;
  ASSERT_TRUE(texts.next(point));
  EXPECT_EQ(point[0], "113.019636645666700001");
  EXPECT_EQ(point[5], "1E-1");
  EXPECT_EQ(point[kY].substr(0, 5), "-110.");
  EXPECT_LE(point[kY].size(), 9U) << "no digits that nobody measured";
}

TEST(PointTexts, APlaceIsShortHoweverFarItIs) {
  EXPECT_EQ(place_text(-1234.56789), "-1234.5679");
  EXPECT_EQ(place_text(0.00004), "0");
  for (const double far_m :
       {9998.99999, 9999.99999, -99999.99999, -999999.99999, -9999999.99, -13e6})
    EXPECT_LE(place_text(far_m).size(), 10U) << far_m;
}

TEST(PointTexts, AListIsNeverLongerThanWhatWasCounted) {
  Track track = spelled();
  track.origin = GeodeticPoint{-23.0, -67.0, 0};  // the other side of the earth: the longest places
  const Track derived = derive(track, GeodeticPoint{23.001, 113.0, 10.0});
  EXPECT_LE(list_bytes(derived), list_bytes(track));
}

}  // namespace
}  // namespace drover::store
