#include "runtime/stop_listener.h"

#include <gmock/gmock.h>

#include <functional>
#include <thread>

#include "runtime/clock.h"
#include "tests/unit/runtime/fake_broker.h"

namespace drover::runtime {
namespace {

using namespace std::chrono_literals;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using Type = FakeBroker;

constexpr const char* kCancel = R"({"cmd_type":"task_control","cmd":"cancel_task"})";
constexpr const char* kTerminate = R"({"cmd_type":"manual_control","cmd":"terminate"})";
constexpr const char* kList = R"({"cmd_type":"trajectory_control","cmd":"get_all_trajectory"})";
constexpr const char* kStart =
    R"({"cmd_type":"task_control","cmd":"start_task","name":"cancel_task","id":1,"speed":0.5})";

class StopListenerTest : public testing::Test {
 protected:
  StopListenerTest() {
    config::MqttConfig config;
    config.host = "127.0.0.1";
    config.port = broker_.port();
    config.client_id = "robot";
    listener_ = std::make_unique<StopListener>(config, stops_);
    thread_ = std::thread([this] { listener_->run(end_); });
  }
  ~StopListenerTest() override {
    end_ = true;
    listener_->wake();
    thread_.join();
  }
  bool turn_until(const std::function<bool()>& done) {
    for (int i = 0; i < 5000; ++i) {
      if (done()) return true;
      broker_.turn();
      std::this_thread::sleep_for(1ms);
    }
    return false;
  }
  void connect() {
    ASSERT_TRUE(turn_until([&] { return broker_.version() == 5; }));
    broker_.accept();
    ASSERT_TRUE(turn_until([&] { return !broker_.all(Type::kSubscribe).empty(); }));
    ASSERT_TRUE(turn_until([&] { return listener_->connected(); }));
  }
  void publish(const char* text) { broker_.publish("mqtt_control", text, false); }
  std::vector<std::string> heard() {
    std::vector<std::string> texts;
    for (HeardStop one; listener_->take(one);) texts.push_back(one.payload);
    return texts;
  }

  FakeBroker broker_;
  StopRequests stops_;
  std::unique_ptr<StopListener> listener_;
  std::atomic<bool> end_{false};
  std::thread thread_;
};

TEST_F(StopListenerTest, AsksForEachStopByItselfAndTellsWhichItHeard) {
  ASSERT_NO_FATAL_FAILURE(connect());
  publish(kCancel);
  publish(kTerminate);
  ASSERT_TRUE(turn_until([&] { return stops_.asked().stops == 1; }));
  EXPECT_EQ(stops_.asked().cancels, 1U);
  EXPECT_EQ(heard(), (std::vector<std::string>{kCancel, kTerminate}));
}

TEST_F(StopListenerTest, ThrowsAwayWhateverElseComes) {
  ASSERT_NO_FATAL_FAILURE(connect());
  const std::string large(100'000, 'x');
  for (const char* text : {kList, kStart, "", "cancel", "{", large.c_str()}) publish(text);
  publish(kCancel);
  ASSERT_TRUE(turn_until([&] { return stops_.asked().cancels > 0; }));
  EXPECT_EQ(stops_.asked().cancels, 1U);
  EXPECT_EQ(stops_.asked().stops, 0U);
  EXPECT_EQ(heard(), (std::vector<std::string>{kCancel}));
}

/// What is not told is not answered; the robot stops all the same.
TEST_F(StopListenerTest, AsksForEveryStopOfAFloodThatNobodyTakes) {
  ASSERT_NO_FATAL_FAILURE(connect());
  for (int i = 0; i < 1000; ++i) publish(kCancel);
  EXPECT_TRUE(turn_until([&] { return stops_.asked().cancels == 1000; }));
  EXPECT_THAT(heard(), Not(IsEmpty()));
}

TEST_F(StopListenerTest, HasANameOfItsOwnAndSaysNothingToTheBroker) {
  ASSERT_NO_FATAL_FAILURE(connect());
  const auto& connect = broker_.packets.at(broker_.all(Type::kConnect).front()).body;
  EXPECT_THAT(connect, HasSubstr("robot-stop"));
  EXPECT_THAT(connect, Not(HasSubstr("drover/online"))) << "its end is not droverd's";
  (void)turn_until([end = monotonic_now() + 500ms] { return monotonic_now() > end; });
  EXPECT_THAT(broker_.all(Type::kPublish), IsEmpty());
}

TEST_F(StopListenerTest, TellsAnswersAndTakesNoneWhileTheBrokerIsGone) {
  EXPECT_FALSE(listener_->answer("early"));
  ASSERT_NO_FATAL_FAILURE(connect());
  EXPECT_TRUE(listener_->answer("one"));
  EXPECT_TRUE(listener_->answer("two"));
  ASSERT_TRUE(turn_until([&] { return broker_.all(Type::kPublish).size() == 2; }));
  const auto told = broker_.all(Type::kPublish);
  EXPECT_THAT(broker_.packets.at(told[0]).body, HasSubstr("feedback"));
  EXPECT_THAT(broker_.packets.at(told[0]).body, testing::EndsWith("one"));
  EXPECT_THAT(broker_.packets.at(told[1]).body, testing::EndsWith("two"));
  broker_.close();
  ASSERT_TRUE(turn_until([&] { return !listener_->connected(); }));
  EXPECT_FALSE(listener_->answer("late"));
}

TEST_F(StopListenerTest, CountsAnswersThatItCanNeitherSendNorGiveBack) {
  ASSERT_NO_FATAL_FAILURE(connect());
  std::uint64_t given = 0;
  ASSERT_TRUE(turn_until([&] {  // a broker that acknowledges nothing, and nobody takes them back
    for (int i = 0; i < 10; ++i) given += listener_->answer("an answer") ? 1U : 0U;
    return listener_->lost_answers() >= 5;
  }));
  std::uint64_t sent = 0;
  std::uint64_t back = 0;
  EXPECT_TRUE(turn_until([&] {
    const auto told = broker_.all(Type::kPublish);
    for (; sent < told.size(); ++sent) broker_.acknowledge(told[sent]);
    for (std::string text; listener_->take_unsent(text);) ++back;
    return sent + back + listener_->lost_answers() == given;
  })) << given
      << " = " << sent << " + " << back << " + " << listener_->lost_answers();
}

TEST_F(StopListenerTest, ComesBackWhenItsConnectionBroke) {
  ASSERT_NO_FATAL_FAILURE(connect());
  broker_.close();
  broker_.packets.clear();
  ASSERT_TRUE(turn_until([&] { return !listener_->connected(); }));
  ASSERT_NO_FATAL_FAILURE(connect());
  publish(kTerminate);
  EXPECT_TRUE(turn_until([&] { return stops_.asked().stops == 1; }));
}

}  // namespace
}  // namespace drover::runtime
