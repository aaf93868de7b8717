#include "publish/rtk_navigation/trajectory_data.h"

#include <gtest/gtest.h>

#include "store/point_texts.h"
#include "tests/unit/publish/examples.h"

namespace drover::publish {
namespace {

using json::Node;

TEST(TrajectoryData, NoTrackIsAnEmptyList) {
  EXPECT_EQ(trajectory_data_text({}), "[]");
}

TEST(TrajectoryData, HasTheDocumentsShapeAndDigits) {
  store::Track track{"test5", {}, {}};
  track.points.assign(2, {188.2222333, 23.04934955, 30, 322100, 45220, 230, 3.141592});
  const auto ours = document_of(trajectory_data_text({&track, 1}));
  const auto theirs = document_of(example("trajectory_data"));
  const Node& our_point = (*(*ours.root.list())[0].find("data")->list())[1];
  const Node& their_point = (*(*theirs.root.list())[0].find("data")->list())[1];
  ASSERT_EQ(our_point.object()->size(), their_point.object()->size());
  for (const auto& field : *their_point.object()) {
    EXPECT_EQ(our_point.find(field.key)->number(), field.node.number()) << field.key;
  }
  EXPECT_EQ(*(*ours.root.list())[0].find("name")->text(), "test5");
}

TEST(TrajectoryData, TakesNoMoreBytesThanWereCounted) {
  store::Track track{"te\"st\n5", {}, {}};
  track.points.assign(3, {188.2222333, 23.04934955, 30, 322100, 45220, 230, 3.141592});
  const store::Track tracks[] = {track, {"empty", {}, {}}};
  const auto counted = store::list_bytes(tracks[0]) + store::list_bytes(tracks[1]) + 2;
  const auto text = trajectory_data_text(tracks);
  EXPECT_LE(text.size(), counted);
  // Counted beyond: room for another origin's x and y, and the last point's and track's comma.
  EXPECT_EQ(text.size() + 3 * (4 + 5) + 2, counted);
}

}  // namespace
}  // namespace drover::publish
