// Tasks and stops: asked for, refused, told at each stage.
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
  start("emty");
  EXPECT_THAT(feedback(), ElementsAre("start_task_failse: there is no track of this name (did you "
                                      "mean \"empty\"?)"));
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

TEST_F(CommandServiceTest, AStopOfABadFormGoesToTheEngineAndIsToldWhatIsWrong) {
  control(R"({"cmd":"cancel_task","cmd_type":"manual_control"})");
  const Command command = only<Command>();
  EXPECT_TRUE(std::holds_alternative<CancelTask>(command.body));
  event(CommandAccepted{command.id, {}});
  EXPECT_THAT(feedback(),
              ElementsAre("cancel_task_success (obeyed, though the message is wrong: the cmd_type "
                          "of cancel_task is task_control, not 'manual_control')"));
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

TEST_F(CommandServiceTest, AnEmptyMessageIsNoCommand) {
  control("", {.retain = Retain::stored});
  control("");
  EXPECT_TRUE(actions_.empty());
}

}  // namespace
}  // namespace drover::publish
