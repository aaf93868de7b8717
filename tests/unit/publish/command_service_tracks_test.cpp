// Tracks: saved, deleted, listed; and what is refused of them.
#include <gmock/gmock.h>

#include "tests/unit/publish/command_service_fixture.h"

namespace drover::publish {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

TEST_F(CommandServiceTest, AcknowledgesASaveOnlyWhenItIsStored) {
  save("园区01");
  const auto job = only<store::StorageJob>();
  EXPECT_THAT(feedback(), IsEmpty());
  EXPECT_FALSE(service_->tracks().contains("园区01"));
  const auto& track = std::get<store::SaveTrack>(job.what).track;
  EXPECT_EQ(track.origin->latitude_deg, kOrigin.latitude_deg);
  reply(job, true);
  EXPECT_THAT(feedback(), ElementsAre("save_trajectory_success"));
  EXPECT_TRUE(service_->tracks().contains("园区01"));
}

TEST_F(CommandServiceTest, AFailedSaveLeavesTheOldTrack) {
  save("13");
  reply(only<store::StorageJob>(), false, "cannot write x: No space left on device");
  EXPECT_THAT(feedback(),
              ElementsAre(HasSubstr("save_trajectory_failse: cannot write x: No space")));
  EXPECT_EQ(service_->tracks().at("13").points.size(), 5U);
}

TEST_F(CommandServiceTest, RefusesMoreWritesThanTheDiskMayOwe) {
  for (int i = 0; i < 16; ++i) save("t" + std::to_string(i));
  EXPECT_EQ(all<store::StorageJob>().size(), 16U);
  actions_.clear();
  save("one more");
  control(example("delete_all_trajectory"));
  EXPECT_THAT(feedback(),
              ElementsAre("save_trajectory_failse: the disk is behind, try again",
                          "delete_all_trajectory_failse: the disk is behind, try again"));
}

TEST_F(CommandServiceTest, DeletesOnlyWhatIsThere) {
  control(example("delete_trajectory"));
  EXPECT_TRUE(all<store::StorageJob>().empty());
  EXPECT_THAT(feedback(), ElementsAre("delete_trajectory_failse: there is no track of this name"));
  save("test5");
  control(example("delete_trajectory"));  // the save is not stored yet, but comes first
  const auto jobs = all<store::StorageJob>();
  ASSERT_EQ(jobs.size(), 2U);
  reply(jobs[0], true);
  reply(jobs[1], true);
  EXPECT_THAT(feedback(), ElementsAre("save_trajectory_success", "delete_trajectory_success"));
  EXPECT_FALSE(service_->tracks().contains("test5"));
}

TEST_F(CommandServiceTest, DeletingAllWhenThereIsNoneSucceeds) {
  make({}, {{}, kOrigin, {}});
  control(example("delete_all_trajectory"));
  reply(only<store::StorageJob>(), true);
  EXPECT_THAT(feedback(), ElementsAre("delete_all_trajectory_success"));
}

TEST_F(CommandServiceTest, AHalfDoneDeleteAllForgetsWhatIsGone) {
  control(example("delete_all_trajectory"));
  reply(only<store::StorageJob>(), false, "cannot remove", {"13"});
  EXPECT_THAT(feedback(), ElementsAre("delete_all_trajectory_failse: cannot remove"));
  EXPECT_FALSE(service_->tracks().contains("13"));
  EXPECT_TRUE(service_->tracks().contains("other"));
}

TEST_F(CommandServiceTest, AnswersWithAllTracksByName) {
  control(example("get_all_trajectory"));
  const auto message = only<PublishText>();
  EXPECT_EQ(message.topic, kTopicTrajectoryData);
  const auto parsed = json::parse(message.text);
  ASSERT_TRUE(parsed.ok());
  ASSERT_EQ(parsed->root.list()->size(), 2U);
  EXPECT_EQ(*(*parsed->root.list())[0].find("name")->text(), "13");
  make({}, {{}, kOrigin, {}});
  control(example("get_all_trajectory"));
  EXPECT_EQ(only<PublishText>().text, "[]");
}

/// A save whose numbers a double would spell otherwise.
constexpr const char* kSpelledSave =
    R"({"cmd_type":"trajectory_control","cmd":"save_trajectory","data":{"name":"13","data":[)"
    R"({"longitude":113.0000000000000001,"latitude":23.0,"angle":9e1,"x":0.00,"y":-0,)"
    R"("yaw":1.570}]}})";

TEST_F(CommandServiceTest, GivesBackTheNumbersAsTheyCame) {
  control(kSpelledSave);
  reply(only<store::StorageJob>(), true);
  actions_.clear();
  control(example("get_all_trajectory"));
  EXPECT_THAT(only<PublishText>().text,
              HasSubstr(R"({"angle":9e1,"latitude":23.0,"longitude":113.0000000000000001,)"
                        R"("x":0.00,"y":-0,"yaw":1.570,"z":0})"));
}

TEST_F(CommandServiceTest, SendsNoListWhileTheBrokerHasNotTakenTheLast) {
  make({.max_message_bytes = 2000}, {{straight("13")}, kOrigin, {}});
  control(example("get_all_trajectory"));
  control(example("get_all_trajectory"));
  control(example("get_all_trajectory"));
  control(example("get_all_trajectory"));
  EXPECT_THAT(feedback(), testing::Contains("get_all_trajectory_failse: the broker has not taken "
                                            "the last list yet, try again"));
  service_->set_under_way(0);
  control(example("get_all_trajectory"));
  EXPECT_EQ(only<PublishText>().topic, kTopicTrajectoryData);
}

TEST_F(CommandServiceTest, TellsThatAListCouldNotBeGivenToTheBroker) {
  service_->on_unsent({kTopicTrajectoryData, "[]"}, "the broker takes no message of this size",
                      actions_);
  EXPECT_THAT(feedback(), ElementsAre("get_all_trajectory_failse: the broker takes no message of "
                                      "this size"));
  service_->on_unsent({kTopicFeedback, "{}"}, "the broker is gone", actions_);
  EXPECT_THAT(feedback(), testing::IsEmpty());
}

TEST_F(CommandServiceTest, RefusesMoreBytesThanTheDiskMayOwe) {
  make({.max_pending_bytes = 300}, {{}, kOrigin, {}});
  save("a");
  save("b");
  save("c");
  EXPECT_THAT(feedback(),
              testing::Contains("save_trajectory_failse: the disk is behind, try again"));
}

TEST_F(CommandServiceTest, RefusesAListThatTheBrokerWouldNotCarry) {
  make({.max_message_bytes = 300}, {{straight("13")}, kOrigin, {}});
  control(example("get_all_trajectory"));
  EXPECT_THAT(feedback(),
              ElementsAre(HasSubstr("get_all_trajectory_failse: the tracks have 5 points")));
}

TEST_F(CommandServiceTest, RefusesATrackWhoseXAndYAreNotWhereItsLatitudesAre) {
  // Recorded, the origin moved a metre north, saved again: x and y are of the old origin.
  store::Track moved = straight("13");
  for (auto& point : moved.points) point.y_m += 1;
  make({}, {{moved}, kOrigin, {}});
  start();
  EXPECT_TRUE(all<Command>().empty());
  EXPECT_THAT(feedback(), ElementsAre(HasSubstr("start_task_failse: point 1: x, y are 1.00 m away "
                                                "from its latitude and longitude")));
  EXPECT_EQ(service_->paths_lent(), 0U);
}

TEST_F(CommandServiceTest, RefusesATrackOfAnotherContinent) {
  store::Track far = straight("13");
  for (auto& point : far.points) point.longitude_deg = 8.5;
  make({}, {{far}, kOrigin, {}});
  start();
  EXPECT_THAT(feedback(), ElementsAre(HasSubstr("start_task_failse: point 1: x, y are ")));
}

}  // namespace
}  // namespace drover::publish
