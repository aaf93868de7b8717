// What becomes of a message by the way it came: late, retained, with a time, in a flood.
#include <gmock/gmock.h>

#include "tests/unit/publish/command_service_fixture.h"

namespace drover::publish {
namespace {

using namespace std::chrono_literals;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr Duration kWall = std::chrono::seconds(1'700'000'000);

class AnArrival : public CommandServiceTest {
 protected:
  void start_at(const std::string& time, Duration wall = kWall) {
    now_ += 2s;  // else the same again counts as one that was delivered twice
    control(R"({"cmd_type":"task_control","cmd":"start_task","name":"13","id":2,"speed":0.2,)"
            R"("time":)" +
                time + "}",
            {.wall = wall});
  }
};

TEST_F(AnArrival, RefusesAStartWhileTheBrokerHoldsMessagesBackButObeysAStop) {
  control(example("start_task"), {.late = "the broker is late"});
  EXPECT_TRUE(all<Command>().empty());
  EXPECT_THAT(feedback(), ElementsAre("start_task_failse: the broker is late"));
  control(example("cancel_task"), {.late = "the broker is late"});
  EXPECT_EQ(all<Command>().size(), 1U);
}

/// The broker may have held it back, and the last word was the stop.
TEST_F(AnArrival, RefusesAStartJustAfterAStopOfTheCommandLine) {
  service_->on_cli(7, CancelTaskRequest{}, now_, actions_);
  actions_.clear();
  now_ += 500ms;
  start();
  EXPECT_TRUE(all<Command>().empty());
  EXPECT_THAT(feedback(), ElementsAre(HasSubstr("a stop came by the command line just now")));
  now_ += 2s;
  start();
  EXPECT_EQ(all<Command>().size(), 1U);
}

TEST_F(AnArrival, ObeysALiveStopThatIsToBeRetainedButNotAStoredOne) {
  control(example("cancel_task"), {.retain = Retain::asked});
  EXPECT_EQ(all<Command>().size(), 1U);
  actions_.clear();
  control(example("cancel_task"), {.retain = Retain::stored});
  EXPECT_TRUE(all<Command>().empty());
  EXPECT_THAT(feedback(), ElementsAre(HasSubstr("cancel_task_failse: the message was retained")));
}

TEST_F(AnArrival, RefusesAStartThatWasPressedOverASecondAgo) {
  start_at("1699999998.9");
  EXPECT_THAT(feedback(), ElementsAre("start_task_failse: it was pressed 1.1 s ago, more than 1 s: "
                                      "press again"));
  start_at("1699999992000");
  EXPECT_THAT(feedback(), ElementsAre(HasSubstr("8.0 s ago")));
  start_at("1700000000.5");
  EXPECT_THAT(feedback(), ElementsAre("start_task_failse: its time is 0.5 s ahead of the robot's "
                                      "clock"));
  start_at("1699999999.5");
  EXPECT_EQ(all<Command>().size(), 1U);
}

TEST_F(AnArrival, NeedsATimeWhereTheConfigurationSaysSo) {
  CommandServiceConfig config;
  config.start_needs_time = true;
  make(config, {{straight("13")}, kOrigin, {}});
  start();
  EXPECT_THAT(feedback(), ElementsAre(HasSubstr("start_task_failse: 'time' is missing")));
  start_at("1700000000");
  EXPECT_EQ(all<Command>().size(), 1U);
}

TEST_F(AnArrival, ObeysEachStopInTheMiddleOfAFlood) {
  for (int i = 0; i < 10'000; ++i) {
    now_ += from_s(1e-4);
    control(example("get_all_trajectory"));
  }
  actions_.clear();
  control(example("cancel_task"));
  EXPECT_EQ(all<Command>().size(), 1U);
}

TEST_F(AnArrival, LetsNoOtherCommandThroughAFloodByLookingLikeAStop) {
  const std::string disguised =
      R"({"cmd_type":"trajectory_control","cmd":"get_all_trajectory","x":"cancel_task"})";
  for (int i = 0; i < 100; ++i) control(disguised);
  std::size_t lists = 0;
  for (const auto& message : all<PublishText>()) lists += message.topic == kTopicTrajectoryData;
  EXPECT_LE(lists, 21U);
}

TEST_F(AnArrival, TellsThatALargeMessageFoundNoRoom) {
  service_->on_unparsed(std::string(5000, 'x'), now_, actions_);
  EXPECT_THAT(feedback(),
              ElementsAre("unknown_failse: slow down: 64 large messages, or 8 MiB of them, "
                          "wait to be read already"));
  EXPECT_THAT(all<Command>(), IsEmpty());
}

}  // namespace
}  // namespace drover::publish
