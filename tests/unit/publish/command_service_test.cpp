#include <gmock/gmock.h>

#include "tests/unit/publish/command_service_fixture.h"

namespace drover::publish {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

TEST_F(CommandServiceTest, RefusesPointIdsThatAreNotOnTheTrack) {
  for (const char* id : {"0", "-1", "6", "1000000000", "4294967297", "-9223372036854775808"}) {
    now_ += from_s(1);
    start("13", id);
    EXPECT_TRUE(all<Command>().empty()) << id;
    EXPECT_THAT(feedback(), ElementsAre(HasSubstr("start_task_failse: point " + std::string(id) +
                                                  " is not on the track: its ids are 1 to 5")));
  }
}

TEST_F(CommandServiceTest, CountsPointsAsConfigured) {
  start("13", "5");
  EXPECT_EQ(std::get<StartTask>(only<Command>().body).target, 4U);
  make({.zero_based_ids = true}, {{straight("13")}, kOrigin, {}});
  start("13", "0");
  EXPECT_EQ(std::get<StartTask>(only<Command>().body).target, 0U);
  actions_.clear();
  start("13", "5");
  EXPECT_THAT(feedback(), ElementsAre(HasSubstr("its ids are 0 to 4")));
}

TEST_F(CommandServiceTest, RefusesATrackItDoesNotHave) {
  start("unknown");
  EXPECT_THAT(feedback(), ElementsAre("start_task_failse: there is no track of this name"));
  make({}, {{{"empty", {}, kOrigin}}, kOrigin, {}});
  start("empty", "1");
  EXPECT_THAT(feedback(), ElementsAre("start_task_failse: the track has no points"));
}

TEST_F(CommandServiceTest, RefusesAStartWithoutAnOrigin) {
  make({}, {{straight("13")}, std::nullopt, {}});
  start();
  EXPECT_THAT(feedback(), ElementsAre(HasSubstr("start_task_failse: there is no origin yet")));
}

TEST_F(CommandServiceTest, RefusesAStartWhileItsTrackIsBeingWritten) {
  save("13");
  const auto job = only<store::StorageJob>();
  actions_.clear();
  start();
  EXPECT_THAT(feedback(), ElementsAre(HasSubstr("being stored or deleted")));
  start("other");
  EXPECT_EQ(all<Command>().size(), 1U);
  actions_.clear();
  reply(job, true);
  EXPECT_THAT(feedback(), ElementsAre("save_trajectory_success"));
  start("13", "1");
  EXPECT_EQ(all<Command>().size(), 1U);
}

TEST_F(CommandServiceTest, RefusesAStartWhileTheOriginIsBeingSet) {
  control(example("init_rtk_data"));
  actions_.clear();
  start();
  EXPECT_THAT(feedback(), ElementsAre("start_task_failse: the origin is being set, try again"));
}

TEST_F(CommandServiceTest, MalformedAndRetainedMessagesChangeNothing) {
  control("{");
  control(example("start_task"), {.retain = Retain::asked});
  EXPECT_TRUE(all<Command>().empty());
  EXPECT_TRUE(all<store::StorageJob>().empty());
  EXPECT_THAT(feedback(), ElementsAre(HasSubstr("unknown_failse: line 1"),
                                      HasSubstr("start_task_failse: the message was retained")));
}

TEST_F(CommandServiceTest, TellsEachStageOfATaskAtItsMoment) {
  start();
  const Command command = only<Command>();
  EXPECT_THAT(feedback(), IsEmpty());
  event(CommandAccepted{command.id, "speed clamped to 0.8 m/s"});
  EXPECT_THAT(feedback(), ElementsAre("start_task_success (speed clamped to 0.8 m/s)"));
  event(NavigationStarted{command.id});
  EXPECT_THAT(feedback(), ElementsAre("start_nav_success"));
  event(TaskEnded{command.id, TaskEnded::How::success, {}});
  EXPECT_THAT(feedback(), IsEmpty());
}

TEST_F(CommandServiceTest, TellsWhyATaskDidNotBeginToMove) {
  start();
  const Command command = only<Command>();
  event(CommandAccepted{command.id, {}});
  event(NavigationNotStarted{command.id, "wheel front_left did not arm"});
  EXPECT_THAT(feedback(),
              ElementsAre("start_task_success", "start_nav_failse: wheel front_left did not arm"));
}

TEST_F(CommandServiceTest, GivesTheEnginesRefusalOn) {
  start();
  const Command command = only<Command>();
  event(CommandRefused{command.id, "a task runs already"});
  event(PathReleased{std::get<StartTask>(command.body).path});
  EXPECT_THAT(feedback(), ElementsAre("start_task_failse: a task runs already"));
  EXPECT_EQ(service_->paths_lent(), 0U);
}

TEST_F(CommandServiceTest, ARunningTaskKeepsItsPathWhateverBecomesOfItsTrack) {
  start();
  const auto* path = std::get<StartTask>(only<Command>().body).path;
  event(CommandAccepted{only<Command>().id, {}});
  actions_.clear();
  save("13");
  reply(only<store::StorageJob>(), true);
  actions_.clear();
  control(example("delete_all_trajectory"));
  reply(only<store::StorageJob>(), true, "", {"13", "other"});
  EXPECT_THAT(service_->tracks(), IsEmpty());
  ASSERT_EQ(path->points.size(), 5U);
  EXPECT_NEAR(path->points[4].x_m, 2.0, 0.001);
  event(PathReleased{path});
  EXPECT_EQ(service_->paths_lent(), 0U);
}

TEST_F(CommandServiceTest, TheEngineThatTakesNoCommandIsAFailureToo) {
  start();
  const Command command = only<Command>();
  actions_.clear();
  service_->on_undelivered(command, actions_);
  EXPECT_THAT(feedback(), ElementsAre(HasSubstr("start_task_failse: the control loop")));
  EXPECT_EQ(service_->paths_lent(), 0U);
}

TEST_F(CommandServiceTest, AStopWithoutAnAnswerIsNotCalledUntold) {
  control(example("cancel_task"));
  const Command command = only<Command>();
  actions_.clear();
  service_->on_undelivered(command, actions_);
  EXPECT_THAT(feedback(), ElementsAre(HasSubstr("cancel_task_failse: told the control loop")));
}

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

TEST_F(CommandServiceTest, CancelAlwaysGoesToTheEngineAtOnce) {
  for (int i = 0; i < 200; ++i) control(example("cancel_task"));
  const auto commands = all<Command>();
  ASSERT_EQ(commands.size(), 200U);
  EXPECT_TRUE(std::holds_alternative<CancelTask>(commands.back().body));
  actions_.clear();
  event(CommandAccepted{commands[0].id, {}});
  EXPECT_THAT(feedback(), ElementsAre("cancel_task_success"));
}

TEST_F(CommandServiceTest, TerminateIsAnEmergencyStop) {
  control("{\"cmd_type\":\"manual_control\",\"cmd\":\"terminate\"}");
  const Command command = only<Command>();
  EXPECT_TRUE(std::holds_alternative<EngageStop>(command.body));
  event(CommandAccepted{command.id, {}});
  EXPECT_THAT(feedback(), ElementsAre("terminate_success"));
}

TEST_F(CommandServiceTest, KeepsTheOrderOfCancelsAndStarts) {
  for (int i = 0; i < 9; ++i) {
    control(example("cancel_task"));
    start();
  }
  const auto commands = all<Command>();
  ASSERT_EQ(commands.size(), 18U);
  for (std::size_t i = 0; i < commands.size(); ++i) {
    EXPECT_EQ(std::holds_alternative<StartTask>(commands[i].body), i % 2 == 1);
    if (i > 0) {
      EXPECT_GT(commands[i].id.number, commands[i - 1].id.number);
    }
  }
}

TEST_F(CommandServiceTest, TheCommandLineResetsAStop) {
  service_->on_cli(7, ResetStopRequest{}, now_, actions_);
  event(CommandRefused{only<Command>().id, "the e-stop is still pressed"});
  const auto answer = only<Answer>();
  EXPECT_FALSE(answer.ok);
  EXPECT_EQ(answer.id.number, 7U);
  EXPECT_EQ(answer.text, "the e-stop is still pressed");
}

TEST_F(CommandServiceTest, AStoredOriginGoesToTheEngineAtStart) {
  service_ = std::make_unique<CommandService>(
      CommandServiceConfig{},
      store::StoredState{.origin = kOrigin, .report = {"a file was put aside"}});
  service_->begin(now_, actions_);
  EXPECT_EQ(std::get<SetOrigin>(only<Command>().body).origin.latitude_deg, 23.0);
  EXPECT_EQ(only<LogLine>().text, "a file was put aside");
}

TEST_F(CommandServiceTest, ANewOriginIsStoredBeforeItIsUsed) {
  control(example("init_rtk_data"));
  const Command ask = only<Command>();
  EXPECT_TRUE(std::holds_alternative<ProposeOrigin>(ask.body));
  actions_.clear();
  const GeodeticPoint proposed{23.01, 113.0, 10.0};
  event(OriginProposed{ask.id, proposed});
  const auto job = only<store::StorageJob>();
  EXPECT_EQ(std::get<store::SaveOrigin>(job.what).origin.latitude_deg, 23.01);
  EXPECT_TRUE(all<Command>().empty());
  actions_.clear();
  reply(job, true);
  EXPECT_EQ(std::get<SetOrigin>(only<Command>().body).origin.latitude_deg, 23.01);
  EXPECT_EQ(service_->origin()->latitude_deg, 23.0);
  event(CommandAccepted{only<Command>().id, {}});
  EXPECT_THAT(feedback(), ElementsAre("init_rtk_data_success"));
  EXPECT_EQ(service_->origin()->latitude_deg, 23.01);
  EXPECT_EQ(service_->tracks().size(), 2U) << "it deletes nothing";
  // Tracks of the old origin are derived from latitude and longitude now.
  EXPECT_NEAR(service_->find_track("13")->points[0].y_m, -1106.5, 1);
}

TEST_F(CommandServiceTest, AnOriginThatCannotBeProposedStoredOrUsedFails) {
  control(example("init_rtk_data"));
  event(CommandRefused{only<Command>().id, "no RTK fixed position"});
  EXPECT_THAT(feedback(), ElementsAre("init_rtk_data_failse: no RTK fixed position"));

  control(example("init_rtk_data"));
  event(OriginProposed{only<Command>().id, {24, 113, 0}});
  reply(only<store::StorageJob>(), false, "disk full");
  EXPECT_THAT(feedback(), ElementsAre("init_rtk_data_failse: disk full"));

  control(example("init_rtk_data"));
  event(OriginProposed{only<Command>().id, {24, 113, 0}});
  reply(only<store::StorageJob>(), true);
  const auto id = all<Command>().back().id;
  actions_.clear();
  event(CommandRefused{id, "a task runs"});
  const auto back = std::get<store::SaveOrigin>(only<store::StorageJob>().what);
  EXPECT_EQ(back.origin.latitude_deg, 23.0) << "the disk holds what the engine uses";
  EXPECT_THAT(feedback(), ElementsAre("init_rtk_data_failse: a task runs"));
  EXPECT_EQ(service_->origin()->latitude_deg, 23.0);
}

TEST_F(CommandServiceTest, TwoOriginRequestsAtOnceAreOneTooMany) {
  control(example("init_rtk_data"));
  control(example("init_rtk_data"));
  EXPECT_EQ(all<Command>().size(), 1U);
  EXPECT_THAT(feedback(), ElementsAre("init_rtk_data_failse: the origin is being set already"));
}

TEST_F(CommandServiceTest, TheFirstFixedPositionBecomesTheOriginWhenThereIsNone) {
  make({}, {});
  Snapshot snapshot;
  snapshot.gnss.health = SourceState::fresh;
  snapshot.gnss.position.quality = FixQuality::rtk_float;
  service_->on_snapshot(snapshot, now_, actions_);
  EXPECT_TRUE(all<Command>().empty());
  snapshot.gnss.position.quality = FixQuality::rtk_fixed;
  service_->on_snapshot(snapshot, now_, actions_);
  service_->on_snapshot(snapshot, now_, actions_);
  const Command ask = only<Command>();
  EXPECT_TRUE(std::holds_alternative<ProposeOrigin>(ask.body));
  event(CommandRefused{ask.id, "not yet"});
  EXPECT_THAT(feedback(), IsEmpty()) << "nobody asked";
  service_->on_snapshot(snapshot, now_ + from_s(1), actions_);
  EXPECT_TRUE(all<Command>().empty());
  service_->on_snapshot(snapshot, now_ + from_s(6), actions_);
  EXPECT_EQ(all<Command>().size(), 1U);
  make({.automatic_origin = false}, {});
  service_->on_snapshot(snapshot, now_, actions_);
  EXPECT_TRUE(actions_.empty());
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

TEST_F(CommandServiceTest, ALostOriginIsToldAndNotReplacedByTheNextPlace) {
  service_ = std::make_unique<CommandService>(
      CommandServiceConfig{},
      store::StoredState{.tracks = {straight("13")}, .origin_problem = "the origin was damaged"});
  service_->begin(now_, actions_);
  EXPECT_EQ(only<LogLine>().text, "the origin was damaged");
  actions_.clear();
  Snapshot snapshot;
  snapshot.gnss.health = SourceState::fresh;
  snapshot.gnss.position.quality = FixQuality::rtk_fixed;
  service_->on_snapshot(snapshot, now_, actions_);
  EXPECT_TRUE(actions_.empty());
  start();
  EXPECT_THAT(feedback(), ElementsAre("start_task_failse: the origin was damaged"));
  EXPECT_EQ(service_->origin_problem(), "the origin was damaged");

  control(example("init_rtk_data"));
  event(OriginProposed{only<Command>().id, kOrigin});
  reply(only<store::StorageJob>(), true);
  event(CommandAccepted{all<Command>().back().id, {}});
  EXPECT_THAT(feedback(), ElementsAre("init_rtk_data_success"));
  EXPECT_EQ(service_->origin_problem(), "");
  start();
  EXPECT_EQ(all<Command>().size(), 1U);
}

TEST_F(CommandServiceTest, AnEmptyMessageIsNoCommand) {
  control("", {.retain = Retain::stored});
  control("");
  EXPECT_TRUE(actions_.empty());
}

}  // namespace
}  // namespace drover::publish
