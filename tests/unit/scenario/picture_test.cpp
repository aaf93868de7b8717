// The map of a drive, as a person sees it.
#include "sim/scenario/picture.h"

#include <gtest/gtest.h>

#include "sim/scenario/map_sketch.h"

namespace drover::sim {
namespace {

std::string joined(const std::vector<std::string>& lines) {
  std::string text;
  for (const auto& line : lines) text += line + "\n";
  return text;
}

ObjectSpec object(const std::string& id, const std::string& shape, std::vector<double> sizes_m,
                  double x_m, double y_m) {
  ObjectSpec spec;
  spec.id = id;
  spec.shape = shape;
  spec.sizes_m = std::move(sizes_m);
  spec.x_m = x_m;
  spec.y_m = y_m;
  return spec;
}

Surroundings demo_like() {
  Surroundings around;
  around.objects["box"] = object("box", "box", {0.6, 0.4, 0.8}, 3, -1);
  around.objects["person"] = object("person", "cylinder", {0.25, 1.7}, 6, 1);
  around.zones["pond"] = {"pond", false, false, {{8, -1, 0}, {11, -1, 0}, {11, 1, 0}, {8, 1, 0}}};
  return around;
}

const std::vector<TrackPose> kRow{{0, 0, 0}, {15, 0, 0}};

TEST(APicture, ShowsWhatIsAroundTheRobotWithItsNames) {
  const auto text = joined(map_lines(kRow, 1, demo_like(), TrackPose{1, 0, 0}, false));
  for (const char* part : {"██  box", "●  person", "▒pond▒", "·G", "→", "█● object", "▒ keep-out"})
    EXPECT_NE(text.find(part), std::string::npos) << part << "\n" << text;
}

TEST(APicture, ExplainsNoMarkThatItDoesNotHave) {
  const auto text = joined(map_lines(kRow, 1, {}, {}, false));
  for (const char* part : {"object", "keep-out", "keep-in", "driven", "waited"})
    EXPECT_EQ(text.find(part), std::string::npos) << part;
}

TEST(APicture, ShowsWhereTheRobotWasAndWhereItWaited) {
  Surroundings around;
  around.driven = {{0, 0, 0}, {4, 0, 0}};
  around.waited = {{3, 0, 0}};
  const auto text = joined(map_lines(kRow, 1, around, TrackPose{4, 0, 0}, false));
  for (const char* part : {"•w•", "•→·", "• driven", "w waited"})
    EXPECT_NE(text.find(part), std::string::npos) << part << "\n" << text;
}

TEST(APicture, ShowsOnlyTheEdgeOfAKeepIn) {
  Surroundings around;
  around.zones["field"] = {
      "field", true, false, {{-1, -1, 0}, {16, -1, 0}, {16, 1, 0}, {-1, 1, 0}}};
  const auto text = joined(map_lines(kRow, 1, around, {}, false));
  EXPECT_NE(text.find("+  "), std::string::npos) << text;
  EXPECT_NE(text.find("+ keep-in"), std::string::npos) << text;
}

TEST(APicture, IsNoWiderThanAHundredColumns) {
  auto around = demo_like();
  around.driven = {{0, 0, 0}, {4, 0, 0}};
  around.waited = {{3, 0, 0}};
  for (const auto& line : map_lines(kRow, 1, around, TrackPose{4, 0, 0}, false))
    EXPECT_LE(characters(line).size(), 100U) << line;
}

TEST(APicture, CutsWhatIsTooLongByCharacters) {
  EXPECT_EQ(fitted("short", 5), "short");
  EXPECT_EQ(fitted("grün ist es", 5), "grün…");
}

}  // namespace
}  // namespace drover::sim
