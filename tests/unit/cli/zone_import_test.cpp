// A zone is shown to a person before it is stored, and nothing is stored that nobody looked at.
#include "cli/zone_import.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <vector>

#include "cli/client.h"
#include "cli/exit_codes.h"
#include "json/located_json.h"

namespace drover::cli {
namespace {

using testing::HasSubstr;
using testing::Not;

const std::string kYard =
    std::string(DROVER_SOURCE_DIR) + "/config/zones/keep_in_yard_with_pond.geojson";

/// The robot at the origin of its map, 10 m west of the yard.
constexpr auto kStatus =
    R"({"ok":true,"status":{"pose":{"x_m":-10,"y_m":20,"position_sigma_m":0.01},)"
    R"("origin":{"latitude_deg":23.14951707,"longitude_deg":113.01944127,"altitude_m":20}}})";

class ZoneImport : public testing::Test {
 protected:
  int run(ImportOrder order) {
    const ImportTalk talk{[this](const std::string& request) {
                            requests.push_back(request);
                            if (request.starts_with(R"({"cmd":"zone_import",)")) return stored;
                            return request == R"({"cmd":"status"})" ? status : zones;
                          },
                          [this](const std::string&) { return person; }};
    return import_zone_file(order, talk, out, err);
  }
  bool asked_to_store() const {
    return !requests.empty() && requests.back().starts_with(R"({"cmd":"zone_import",)");
  }

  std::string status = kStatus;
  std::string zones = R"({"ok":true,"zones":[],"problem":""})";
  std::string stored =
      R"({"ok":true,"zone":{"name":"yard","kind":"keep_in","warnings":[]},"replaced":false,)"
      R"("notes":[]})";
  std::optional<std::string> person = "yes";
  std::vector<std::string> requests;
  std::ostringstream out;
  std::ostringstream err;
};

TEST_F(ZoneImport, ShowsWhatAndWhereItIsBeforeItIsStored) {
  EXPECT_EQ(run({.file = kYard, .keep_in = true}), kDone);
  // As the README of the command line shows it.
  EXPECT_THAT(out.str(),
              testing::StartsWith("zone      yard\n"
                                  "kind      keep-in: the whole robot stays inside\n"
                                  "shape     1 polygon, 1 hole, 12 points\n"
                                  "area      4231.2 m2\n"
                                  "perimeter 305.0 m\n"
                                  "robot     10.00 m from it, which lies 90 deg from north, "
                                  "clockwise\n"
                                  "warning   the robot is outside of what it may not leave\n"));
  EXPECT_THAT(out.str(), HasSubstr("done: the zone yard is stored as keep-in"));
  EXPECT_THAT(out.str(), Not(HasSubstr("replaces")));
  EXPECT_EQ(err.str(), "");
}

TEST_F(ZoneImport, HandsTheFileOver) {
  EXPECT_EQ(run({.file = kYard, .name = "north", .keep_in = false, .yes = true}), kDone);
  ASSERT_EQ(requests.size(), 1U);
  const auto request = json::parse(requests[0]);
  ASSERT_TRUE(request.ok());
  std::ifstream in(kYard);
  std::stringstream file;
  file << in.rdbuf();
  EXPECT_EQ(*request->root.find("name")->text(), "north");
  EXPECT_EQ(*request->root.find("kind")->text(), "keep_out");
  EXPECT_EQ(*request->root.find("source")->text(), "keep_in_yard_with_pond.geojson");
  EXPECT_EQ(*request->root.find("text")->text(), file.str());
}

TEST_F(ZoneImport, StoresNothingUnlessThePersonSaysYes) {
  for (const auto* answer : {"", "no", "y", "YES!"}) {
    person = answer;
    EXPECT_EQ(run({.file = kYard, .keep_in = true}), kRefused) << answer;
    EXPECT_FALSE(asked_to_store()) << answer;
  }
  EXPECT_THAT(err.str(), HasSubstr("refused: not imported: the answer was not yes\n"));
}

TEST_F(ZoneImport, IsRefusedWhereNobodyCanBeAsked) {
  person.reset();
  EXPECT_EQ(run({.file = kYard, .keep_in = true}), kRefused);
  EXPECT_FALSE(asked_to_store());
  EXPECT_THAT(err.str(), HasSubstr("nobody was asked whether the zone is in the right place"));
  EXPECT_THAT(err.str(), HasSubstr("--yes"));
  EXPECT_THAT(out.str(), HasSubstr("area      "));
}

TEST_F(ZoneImport, OfAProgramNeedsYes) {
  EXPECT_EQ(run({.file = kYard, .keep_in = true, .json = true}), kRefused);
  EXPECT_FALSE(asked_to_store());
  EXPECT_THAT(out.str(), testing::StartsWith(R"({"ok":false,"reason":"nobody was asked)"));
  out.str("");
  EXPECT_EQ(run({.file = kYard, .keep_in = true, .yes = true, .json = true}), kDone);
  EXPECT_EQ(out.str(), stored + "\n");
}

TEST_F(ZoneImport, SaysWhenItReplacesAZone) {
  zones = R"({"ok":true,"zones":[{"name":"yard","unreadable":"why"}],"problem":""})";
  EXPECT_EQ(run({.file = kYard, .keep_in = true}), kDone);
  EXPECT_THAT(out.str(), HasSubstr("replaces  the zone that has this name now\n"));
}

TEST_F(ZoneImport, SaysWhatItReplacesAndWhenTheKindChanges) {
  zones = R"({"ok":true,"zones":[{"name":"pond","kind":"keep_in","area_m2":9},)"
          R"({"name":"yard","kind":"keep_out","area_m2":400.2}],"problem":""})";
  EXPECT_EQ(run({.file = kYard, .keep_in = true}), kDone);
  EXPECT_THAT(out.str(), HasSubstr("replaces  the keep-out of this name (400 m2)\n"));
  EXPECT_THAT(out.str(), HasSubstr("warning   what was a keep-out of this name becomes a keep-in"));
  out.str("");
  EXPECT_EQ(run({.file = kYard, .keep_in = false}), kDone);
  EXPECT_THAT(out.str(), HasSubstr("replaces  the keep-out of this name (400 m2)\n"));
  EXPECT_THAT(out.str(), Not(HasSubstr("becomes")));
  out.str("");
  EXPECT_EQ(run({.file = kYard, .name = "pond", .keep_in = false}), kDone);
  EXPECT_THAT(out.str(), HasSubstr("becomes a keep-out: THE FENCE IS GONE\n"));
}

TEST_F(ZoneImport, SaysThatTheAreaOfSeveralPolygonsIsTheirSum) {
  EXPECT_EQ(run({.file = kYard, .keep_in = true}), kDone);
  EXPECT_THAT(out.str(), HasSubstr("area      4231.2 m2\n"));
  const std::string file = testing::TempDir() + "/two_yards.geojson";
  std::ofstream(file) << R"({"type":"MultiPolygon","coordinates":[)"
                         R"([[[113,23],[113.001,23],[113.001,23.001],[113,23.001],[113,23]]],)"
                         R"([[[113,23],[113.001,23],[113.001,23.001],[113,23.001],[113,23]]]]})";
  out.str("");
  EXPECT_EQ(run({.file = file, .name = "two", .keep_in = true}), kDone) << err.str();
  EXPECT_THAT(out.str(), HasSubstr(" m2, the sum of 2 polygons\n"));
}

TEST_F(ZoneImport, SaysThatTheRobotDoesNotKnowWhereItIs) {
  for (const auto* unknown :
       {R"({"ok":true,"status":{"pose":{"x_m":0,"y_m":0},"origin":{"latitude_deg":23,)"
        R"("longitude_deg":113,"altitude_m":0}}})",
        R"({"ok":true,"status":{"pose":{"x_m":0,"y_m":0,"position_sigma_m":0.01}}})"}) {
    status = unknown;
    out.str("");
    EXPECT_EQ(run({.file = kYard, .keep_in = true}), kDone);
    EXPECT_THAT(out.str(), HasSubstr("robot     does not know where it is")) << unknown;
  }
}

TEST_F(ZoneImport, TellsTheLineOfAFileThatIsWrongAndAsksNobody) {
  const auto file = std::filesystem::path(testing::TempDir()) / "wrong.geojson";
  std::ofstream(file) << "{\"type\": \"Feature\",\n \"geometry\": {\"type\": \"LineString\", "
                         "\"coordinates\": [[0, 0], [1, 1]]}}";
  EXPECT_EQ(run({.file = file.string(), .keep_in = true}), kRefused);
  EXPECT_THAT(err.str(), HasSubstr("wrong.geojson: line 2, column "));
  EXPECT_TRUE(requests.empty());
}

TEST_F(ZoneImport, TellsAFileThatCannotBeReadOrIsTooLarge) {
  EXPECT_EQ(run({.file = "/nowhere/yard.geojson", .keep_in = true}), kRefused);
  EXPECT_THAT(err.str(), HasSubstr("/nowhere/yard.geojson: No such file or directory"));
  EXPECT_EQ(run({.file = testing::TempDir(), .keep_in = true}), kRefused);
  EXPECT_THAT(err.str(), HasSubstr("Is a directory"));
  const auto file = std::filesystem::path(testing::TempDir()) / "large.geojson";
  std::ofstream(file) << std::string((2U << 20) + 1, ' ');
  EXPECT_EQ(run({.file = file.string(), .keep_in = true}), kRefused);
  EXPECT_THAT(err.str(), HasSubstr("large.geojson: is larger than 2 MiB"));
  EXPECT_TRUE(requests.empty());
}

TEST_F(ZoneImport, TellsWhyTheRobotHasNoUseForAZoneBeforeItAsks) {
  zones = R"({"ok":false,"reason":"this robot's configuration has no section scene"})";
  EXPECT_EQ(run({.file = kYard, .keep_in = true}), kRefused);
  EXPECT_EQ(err.str(), "refused: this robot's configuration has no section scene\n");
  EXPECT_EQ(out.str(), "");
}

TEST_F(ZoneImport, TellsWhyDroverdRefusedIt) {
  stored = R"({"ok":false,"reason":"there are 100 zones already"})";
  EXPECT_EQ(run({.file = kYard, .keep_in = true, .yes = true}), kRefused);
  EXPECT_EQ(err.str(), "refused: there are 100 zones already\n");
}

TEST_F(ZoneImport, FailsWhenAnAnswerIsNone) {
  stored = "{";
  EXPECT_THROW(run({.file = kYard, .keep_in = true, .yes = true}), NoAnswer);
}

}  // namespace
}  // namespace drover::cli
