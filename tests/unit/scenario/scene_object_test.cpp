// Objects and zones of a scenario: what is told, what stands there, and where.
#include "sim/scenario/scene_object.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sim/scenario/scene_zone.h"

namespace drover::sim {
namespace {

using nlohmann::json;
using nlohmann::ordered_json;
using testing::HasSubstr;
using namespace std::chrono_literals;

constexpr TrackPose kShift{10, -20, 0};
constexpr Time kNow{100s};

ObjectSpec object(const char* text) {
  const auto raw = json::parse(text);
  return read_object(JsonReader(raw, "object"), raw);
}
std::string refusal(const char* text) {
  try {
    (void)object(text);
  } catch (const std::exception& error) {
    return error.what();
  }
  return "accepted";
}

TEST(SceneObject, IsRefusedWithTheKey) {
  EXPECT_THAT(refusal(R"({"box": [1, 1, 1], "at": [0, 0]})"), HasSubstr("object.id"));
  EXPECT_THAT(refusal(R"({"id": "two words", "box": [1, 1, 1], "at": [0, 0]})"), HasSubstr("id"));
  EXPECT_THAT(refusal(R"({"id": "a", "box": [1, 1], "at": [0, 0]})"), HasSubstr("object.box"));
  EXPECT_THAT(refusal(R"({"id": "a", "box": [1, 1, 1]})"), HasSubstr("object.at"));
  EXPECT_THAT(refusal(R"({"id": "a", "at": [0, 0]})"), HasSubstr("must have box"));
  EXPECT_THAT(refusal(R"({"id": "a", "at": [0, 0], "box": [1, 1, 1], "sphere": [1]})"),
              HasSubstr("second shape"));
  EXPECT_THAT(refusal(R"({"id": "a", "at": [0, "x"], "box": [1, 1, 1]})"), HasSubstr("object.at"));
  EXPECT_THAT(refusal(R"({"id": "a", "to": [0, 0], "speed_mps": 0})"), HasSubstr("speed_mps"));
  EXPECT_THAT(refusal(R"({"id": "a", "at": [0, 0], "box": [1, 1, 1], "size": 1})"),
              HasSubstr("size"));
}

TEST(SceneObject, IsPutInTheSimulatorsFrameAndToldInTheMap) {
  const auto box = object(R"({"id": "b", "box": [0.4, 0.3, 1.2], "at": [3, 0.5], "yaw_deg": 90})");
  EXPECT_EQ(obstacle_command(box), "obstacle b box 3 0.5 90 0.4 0.3 1.2");
  const auto message = added_message(box, kShift);
  EXPECT_EQ(message.at("header").at("frame_id"), "map");
  EXPECT_EQ(message.at("id"), "b");
  EXPECT_EQ(message.at("operation"), 0);
  ASSERT_EQ(message.at("primitives").size(), 1U);
  EXPECT_EQ(message.at("primitives")[0].at("type"), 1);
  EXPECT_EQ(message.at("primitives")[0].at("dimensions"), ordered_json({0.4, 0.3, 1.2}));
  ASSERT_EQ(message.at("primitive_poses").size(), 1U);
  const auto& pose = message.at("primitive_poses")[0];
  EXPECT_EQ(pose.at("position").at("x"), 13);
  EXPECT_EQ(pose.at("position").at("y"), -19.5);
  EXPECT_EQ(pose.at("position").at("z"), 0.6) << "it stands on the ground";
  EXPECT_NEAR(pose.at("orientation").at("z").get<double>(), std::sqrt(0.5), 1e-12);
}

TEST(SceneObject, HasTheDocumentsHeightFirst) {
  const auto pole = object(R"({"id": "p", "cylinder": [0.01, 1.5], "at": [3, 1], "z_m": 0.9})");
  EXPECT_EQ(obstacle_command(pole), "obstacle p cylinder 3 1 0.01 1.5 0.9");
  const auto message = added_message(pole, kShift);
  EXPECT_EQ(message.at("primitives")[0].at("type"), 3);
  EXPECT_EQ(message.at("primitives")[0].at("dimensions"), ordered_json({1.5, 0.01}));
  EXPECT_EQ(message.at("primitive_poses")[0].at("position").at("z"), 0.9);
  const auto cone = object(R"({"id": "c", "cone": [0.3, 0.8], "at": [0, 0]})");
  EXPECT_EQ(added_message(cone, kShift).at("primitives")[0].at("type"), 4);
  const auto ball = object(R"({"id": "s", "sphere": [0.3], "at": [0, 0]})");
  EXPECT_EQ(obstacle_command(ball), "obstacle s sphere 0 0 0.3");
  EXPECT_EQ(added_message(ball, kShift).at("primitive_poses")[0].at("position").at("z"), 0.3);
}

TEST(SceneObject, GoesAndIsTakenAway) {
  EXPECT_EQ(obstacle_command(object(R"({"id": "p", "to": [3, 4], "speed_mps": 1.2})")),
            "obstacle p move 3 4 1.2");
  EXPECT_EQ(obstacle_command(object(R"({"id": "p", "gone": true})")), "obstacle p remove");
  EXPECT_EQ(removed_message("p"), ordered_json::parse(R"({"id": "p", "operation": 1})"));
}

TEST(SceneObject, OfAMessageInTheMapEveryPositionIsShifted) {
  const auto shifted = in_map(ordered_json::parse(R"([
    {"header": {"frame_id": "map"}, "mesh_poses": [{"position": {"x": 1, "y": 2, "z": 3}}, {}]},
    {"position_constraints": [{"header": {"frame_id": "1"}, "constraint_region":
      {"primitive_poses": [{"position": {"y": 5}}]}, "target_point_offset": {"x": 1}},
      {"header": {"frame_id": "base_link"}, "constraint_region":
      {"primitive_poses": [{"position": {"y": 5}}]}}]}])"),
                              kShift);
  EXPECT_EQ(shifted[0].at("mesh_poses")[0].at("position"),
            ordered_json::parse(R"({"x": 11.0, "y": -18.0, "z": 3})"));
  const auto& constraints = shifted[1].at("position_constraints");
  const auto position = [&](std::size_t i) {
    return constraints[i].at("constraint_region").at("primitive_poses")[0].at("position");
  };
  EXPECT_EQ(position(0).at("x"), 10);
  EXPECT_EQ(position(0).at("y"), -15);
  EXPECT_EQ(position(1), ordered_json::parse(R"({"y": 5})"));
  EXPECT_EQ(constraints[0].at("target_point_offset").at("x"), 1);
}

TEST(SceneObject, OfAMessageEveryHeaderIsStamped) {
  auto message = ordered_json::parse(R"([{"header": {"frame_id": "map"}, "id": "a"}])");
  set_stamps(message, 1700000000s + 250ms);
  EXPECT_EQ(message[0].at("header").at("stamp"),
            ordered_json::parse(R"({"sec": 1700000000, "nsec": 250000000})"));
}

TEST(Journeys, TellWhereItIsUntilItArrives) {
  Journeys journeys;
  EXPECT_EQ(journeys.next(), Time::max());
  const auto person = object(R"({"id": "p", "cylinder": [0.25, 1.7], "at": [3, -2]})");
  journeys.begin(person, object(R"({"id": "p", "to": [3, 2], "speed_mps": 1})"), kNow);
  EXPECT_EQ(journeys.next(), kNow);
  auto due = journeys.due(kNow);
  ASSERT_EQ(due.size(), 1U);
  EXPECT_EQ(due[0].object.y_m, -2);
  EXPECT_EQ(due[0].object.shape, "cylinder");
  EXPECT_EQ(journeys.next(), kNow + 100ms);
  EXPECT_TRUE(journeys.due(kNow + 99ms).empty());
  due = journeys.due(kNow + 1s);
  EXPECT_NEAR(due[0].object.y_m, -1, 1e-9);
  EXPECT_FALSE(due[0].arrived);
  due = journeys.due(kNow + 4s);
  EXPECT_EQ(due[0].object.y_m, 2);
  EXPECT_TRUE(due[0].arrived);
  EXPECT_EQ(journeys.next(), Time::max());
}

TEST(SceneZone, IsAFileAndTheWordsThatImportIt) {
  const auto raw = json::parse(
      R"({"name": "pond", "kind": "keep_out", "polygon": [[0, 0], [10, 0], [10, 10]]})");
  const auto zone = read_zone(JsonReader(raw, "zone"), raw);
  const auto file = json::parse(geojson(zone, {52, 13, 30}));
  const auto& ring = file.at("geometry").at("coordinates").at(0);
  ASSERT_EQ(ring.size(), 4U);
  EXPECT_EQ(ring[0], ring[3]);
  EXPECT_NEAR(ring[0][0].get<double>(), 13, 1e-12) << "the longitude is first";
  EXPECT_NEAR(ring[2][1].get<double>(), 52 + 10 / 111267.0, 1e-7);
  EXPECT_THAT(zone_words(zone, "/a b/pond.geojson"), testing::Contains("/a b/pond.geojson"));
  EXPECT_THAT(zone_words(zone, ""), testing::Contains("--keep-out"));
  const auto gone = json::parse(R"({"name": "pond", "deleted": true})");
  EXPECT_EQ(zone_words(read_zone(JsonReader(gone, "zone"), gone), ""),
            (std::vector<std::string>{"zone", "delete", "pond"}));
}

}  // namespace
}  // namespace drover::sim
