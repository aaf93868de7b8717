// The same start more than once, and requests in a flood.
#include <gmock/gmock.h>

#include "tests/unit/publish/command_service_fixture.h"

namespace drover::publish {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

TEST_F(CommandServiceTest, ExecutesAStartThatTheBrokerDeliversTwiceOnce) {
  start();
  now_ += from_s(0.5);
  start();
  EXPECT_EQ(all<Command>().size(), 1U);
}

TEST_F(CommandServiceTest, AnswersARefusedStartThatComesAgainWithTheSameRefusal) {
  start("none");
  EXPECT_THAT(feedback(), ElementsAre("start_task_failse: there is no track of this name"));
  now_ += from_s(0.5);
  start("none");
  EXPECT_THAT(feedback(), ElementsAre("start_task_failse: there is no track of this name"));
}

TEST_F(CommandServiceTest, DoesNotExecuteAStartThatTheEngineRefusedWhenItComesAgain) {
  start();
  event(CommandRefused{only<Command>().id, "e-stop pressed"});
  EXPECT_THAT(feedback(), ElementsAre("start_task_failse: e-stop pressed"));
  now_ += from_s(0.5);
  start();
  EXPECT_THAT(all<Command>(), IsEmpty());
  for (const LogLine& line : all<LogLine>()) EXPECT_THAT(line.text, Not(HasSubstr("executed")));
  EXPECT_THAT(feedback(), ElementsAre("start_task_failse: e-stop pressed"));
  now_ += from_s(1.1);
  start();
  EXPECT_EQ(all<Command>().size(), 1U) << "later it is another start";
}

TEST_F(CommandServiceTest, AnswersAStartThatComesTwiceBeforeItIsDecidedOnce) {
  start();
  start();
  event(CommandAccepted{only<Command>().id, {}});
  EXPECT_THAT(feedback(), ElementsAre("start_task_success"));
  start();
  EXPECT_THAT(feedback(), IsEmpty());
}

TEST_F(CommandServiceTest, AnswersEachOfTwoEqualStartsThatAreRefused) {
  start();
  start();
  EXPECT_EQ(all<Command>().size(), 1U) << "nothing moves twice";
  event(CommandRefused{only<Command>().id, "e-stop pressed"});
  EXPECT_THAT(feedback(), ElementsAre("start_task_failse: e-stop pressed",
                                      "start_task_failse: e-stop pressed"));
}

TEST_F(CommandServiceTest, TakesTheSameStartAgainAfterASecondOrAChange) {
  start();
  now_ += from_s(1.1);
  start();
  EXPECT_EQ(all<Command>().size(), 2U);
  control(example("cancel_task"));
  start();
  EXPECT_EQ(all<Command>().size(), 4U);
  event(TaskEnded{all<Command>().back().id, TaskEnded::How::success, {}});
  start();
  EXPECT_EQ(all<Command>().size(), 5U);
}

TEST_F(CommandServiceTest, AnswersAFloodWithSlowDownAndNoFloodOfItsOwn) {
  for (int i = 0; i < 10'000; ++i) {
    now_ += from_s(1e-4);
    control(example("get_all_trajectory"));
  }
  std::size_t lists = 0;
  for (const auto& message : all<PublishText>()) lists += message.topic == kTopicTrajectoryData;
  EXPECT_GE(lists, 29U);
  EXPECT_LE(lists, 31U);
  const auto told = feedback();
  EXPECT_GE(told.size(), 29U);
  EXPECT_LE(told.size(), 31U);
  EXPECT_EQ(told.back(),
            "get_all_trajectory_failse: slow down: 10 requests a second are taken, and 20 at once");
  now_ += from_s(1);
  control(example("get_all_trajectory"));
  EXPECT_EQ(only<PublishText>().topic, kTopicTrajectoryData);
}

TEST_F(CommandServiceTest, TellsTheCommandLineHowManyRequestsAreTaken) {
  for (std::uint64_t i = 1; i <= 21; ++i) service_->on_cli(i, GetAllTrajectory{}, now_, actions_);
  EXPECT_EQ(all<Answer>().back().text, "slow down: 10 requests a second are taken, and 20 at once");
}

TEST_F(CommandServiceTest, TheCommandLineIsNotHeldUpByAFloodOnTheBroker) {
  for (int i = 0; i < 100; ++i) control(example("get_all_trajectory"));
  actions_.clear();
  service_->on_cli(1, StartTaskRequest{"13", 1, 0.5}, now_, actions_);
  const Command command = only<Command>();
  EXPECT_EQ(command.id.source, RequestId::Source::cli);
  event(CommandAccepted{command.id, "note"});
  const auto answer = only<Answer>();
  EXPECT_TRUE(answer.ok);
  EXPECT_EQ(answer.text, "note");
  EXPECT_THAT(feedback(), IsEmpty());
}

}  // namespace
}  // namespace drover::publish
