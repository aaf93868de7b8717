// The client against a broker that plays every part: old, slow, refusing, gone.
#include <gmock/gmock.h>
#include <poll.h>

#include "runtime/clock.h"
#include "runtime/mqtt_client.h"
#include "tests/unit/runtime/fake_broker.h"

namespace drover::runtime {
namespace {

using namespace std::chrono_literals;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using Type = FakeBroker;

class MqttClientTest : public testing::Test {
 protected:
  void make(const std::string& host = "127.0.0.1") {
    config::MqttConfig config;
    config.host = host;
    config.port = broker_.port();
    client_ = std::make_unique<MqttClient>(
        config, std::vector<MqttSubscription>{{"mqtt_control", 1}},
        [this](const MqttMessage& message) {
          heard_.push_back({std::string(message.payload), message.retain});
        },
        [this](bool, const std::string& text) { said_.push_back(text); });
  }
  /// Both sides, a few times; the test's clock moves with it.
  void turn(Duration time = 10ms) {
    for (const Time end = now_ + time; now_ < end; now_ += 10ms) {
      client_->tick(now_);
      for (int i = 0; i < 5; ++i) {
        pollfd wait{client_->fd(),
                    static_cast<short>(POLLIN | (client_->wants_write() ? POLLOUT : 0)), 0};
        if (client_->fd() >= 0 && ::poll(&wait, 1, 1) > 0) {
          if ((wait.revents & POLLOUT) != 0) client_->on_writable(now_);
          if ((wait.revents & ~POLLOUT) != 0 && client_->fd() >= 0) client_->on_readable(now_);
        }
        broker_.turn();
      }
    }
  }
  bool turn_until(const std::function<bool()>& done) {
    for (int i = 0; i < 500; ++i) {
      if (done()) return true;
      turn();
    }
    return false;
  }
  bool wait_for_connect(int version) {
    return turn_until([&] { return broker_.version() == version; });
  }
  void connect() {
    make();
    ASSERT_TRUE(wait_for_connect(5));
    broker_.accept();
    ASSERT_TRUE(turn_until([&] { return !broker_.all(Type::kSubscribe).empty(); }));
  }
  /// Answers every message that was not answered yet.
  void acknowledge_all() {
    const auto publishes = broker_.all(Type::kPublish);
    for (; acknowledged_ < publishes.size(); ++acknowledged_)
      broker_.acknowledge(publishes[acknowledged_]);
  }
  void turn_promptly(Duration time) {
    for (const Time end = now_ + time; now_ < end;) {
      turn();
      acknowledge_all();
    }
  }

  struct Heard {
    std::string text;
    publish::Retain retain;
  };
  FakeBroker broker_;
  std::unique_ptr<MqttClient> client_;
  std::vector<Heard> heard_;
  std::vector<std::string> said_;
  std::size_t acknowledged_ = 0;
  Time now_ = Time{1000s};
};

TEST_F(MqttClientTest, AsksForTheRetainFlagAsPublishedAndForNothingThatIsStored) {
  connect();
  const auto& subscribe = broker_.packets.at(broker_.all(Type::kSubscribe).front()).body;
  constexpr unsigned kRetainAsPublished = 0x08;
  constexpr unsigned kNeverStored = 0x20;
  EXPECT_EQ(static_cast<unsigned>(subscribe.back()), 1U | kRetainAsPublished | kNeverStored);
  EXPECT_EQ(said_.back(), "connected to the broker");
}

TEST_F(MqttClientTest, TellsALiveMessageThatIsToBeRetainedFromOthers) {
  connect();
  broker_.publish("mqtt_control", "one", false);
  broker_.publish("mqtt_control", "two", true);
  ASSERT_TRUE(turn_until([&] { return heard_.size() == 2; }));
  EXPECT_EQ(heard_[0].retain, publish::Retain::no);
  EXPECT_EQ(heard_[1].retain, publish::Retain::asked);
}

TEST_F(MqttClientTest, FallsBackToAnOldBrokerAndSaysWhatIsLost) {
  make();
  ASSERT_TRUE(wait_for_connect(5));
  broker_.send(Type::kConnack, 0, std::string{'\0', '\1'});  // as 3.1.1 refuses a version
  ASSERT_TRUE(wait_for_connect(4));
  broker_.accept();
  ASSERT_TRUE(turn_until([&] { return client_->connected(); }));
  EXPECT_THAT(said_.back(), HasSubstr("MQTT 3.1.1 only"));
  broker_.publish("mqtt_control", "stored", true);
  ASSERT_TRUE(turn_until([&] { return !heard_.empty(); }));
  EXPECT_EQ(heard_[0].retain, publish::Retain::stored);
}

TEST_F(MqttClientTest, FallsBackWhenTheBrokerClosesWithoutAWordTwice) {
  make();
  for (int i = 1; i <= 2; ++i) {
    ASSERT_TRUE(turn_until([&] { return broker_.connections == i && broker_.version() != 0; }));
    EXPECT_EQ(broker_.version(), 5);
    broker_.close();
  }
  EXPECT_TRUE(wait_for_connect(4));
}

TEST_F(MqttClientTest, SaysWhyTheBrokerRefusesAndTriesAgain) {
  make();
  ASSERT_TRUE(wait_for_connect(5));
  constexpr unsigned kNotAuthorized = 0x87;
  broker_.accept(kNotAuthorized);
  turn(50ms);
  broker_.close();
  ASSERT_TRUE(turn_until([&] { return broker_.connections == 2; }));
  EXPECT_THAT(said_.back(), HasSubstr("Not authorized (mqtt.username, mqtt.password_file)"));
  EXPECT_EQ(broker_.version(), 5);
}

TEST_F(MqttClientTest, BelievesNoStartInTheFirstSecondAfterTheBrokerCameBack) {
  connect();
  EXPECT_THAT(client_->late(now_), IsEmpty()) << "the first connection brings nothing old";
  broker_.close();
  ASSERT_TRUE(turn_until([&] { return broker_.connections == 2; }));
  turn(50ms);
  broker_.accept();
  ASSERT_TRUE(turn_until([&] { return client_->connected(); }));
  EXPECT_THAT(std::string(client_->late(now_)), HasSubstr("has just come back"));
  acknowledged_ = broker_.all(Type::kPublish).size() - 1;
  turn_promptly(1100ms);
  EXPECT_THAT(client_->late(now_), IsEmpty());
}

TEST_F(MqttClientTest, BelievesNoStartAfterABrokerThatTookLongToAnswer) {
  make();
  ASSERT_TRUE(wait_for_connect(5));
  turn(800ms);
  broker_.accept();
  ASSERT_TRUE(turn_until([&] { return client_->connected(); }));
  EXPECT_THAT(std::string(client_->late(now_)), HasSubstr("has just come back"));
}

TEST_F(MqttClientTest, NoticesByItsOwnMessagesThatTheBrokerHoldsMessagesBack) {
  connect();
  turn_promptly(2s);
  ASSERT_THAT(client_->late(now_), IsEmpty());
  turn(800ms);
  EXPECT_THAT(std::string(client_->late(now_)), HasSubstr("it holds messages back"));
  acknowledge_all();
  turn_promptly(100ms);
  EXPECT_THAT(std::string(client_->late(now_)), HasSubstr("was late just now"));
  turn_promptly(1100ms);
  EXPECT_THAT(client_->late(now_), IsEmpty());
}

TEST_F(MqttClientTest, MeasuresWithAMessageThatEveryListOfRightsLetsItWrite) {
  connect();
  turn_promptly(1s);
  for (const auto n : broker_.all(Type::kPublish))
    EXPECT_EQ(broker_.packets.at(n).body.substr(2, 13), "drover/online");
  EXPECT_GT(broker_.all(Type::kPublish).size(), 3U);
}

TEST_F(MqttClientTest, QueuesOnlySoManyAnswersForABrokerThatTakesNone) {
  connect();
  int taken = 0;
  for (int i = 0; i < 10'000; ++i) taken += client_->publish("feedback", "{}").empty() ? 1 : 0;
  EXPECT_EQ(taken, 200);
  EXPECT_EQ(client_->dropped(), 9'800U);
}

TEST_F(MqttClientTest, TellsAtOnceWhatTheBrokerWouldNotTake) {
  make();
  ASSERT_TRUE(wait_for_connect(5));
  broker_.accept_small_packets();
  ASSERT_TRUE(turn_until([&] { return client_->connected(); }));
  EXPECT_EQ(client_->publish("feedback", std::string(100, ' ')),
            "the broker takes no message of this size");
  EXPECT_EQ(client_->publish("feedback", "{}"), "");
}

TEST_F(MqttClientTest, CountsTelemetryThatTheBrokerWouldNotTakeAsDropped) {
  make();
  ASSERT_TRUE(wait_for_connect(5));
  broker_.accept_small_packets();
  ASSERT_TRUE(turn_until([&] { return client_->connected() && !client_->wants_write(); }));
  EXPECT_FALSE(client_->publish_latest("base_status", std::string(100, ' ')));
  EXPECT_EQ(client_->dropped(), 1U);
  EXPECT_EQ(client_->publish("feedback", "{}"), "");
  EXPECT_EQ(client_->dropped(), 1U);
}

TEST_F(MqttClientTest, KnowsHowMuchOfItsAnswersIsStillOnItsWay) {
  connect();
  turn_promptly(100ms);
  EXPECT_EQ(client_->bytes_under_way(), 0U);
  EXPECT_EQ(client_->publish("trajectory_data", std::string(5000, ' ')), "");
  EXPECT_EQ(client_->publish("feedback", "{}"), "");
  EXPECT_EQ(client_->bytes_under_way(), 5002U);
  turn_promptly(100ms);
  EXPECT_EQ(client_->bytes_under_way(), 0U);
}

TEST_F(MqttClientTest, LeavesTimeForOthersBetweenLargeMessages) {
  connect();
  const std::string large(40'000, ' ');
  for (int i = 0; i < 10; ++i) broker_.publish("mqtt_control", large, false);
  client_->on_readable(now_);
  EXPECT_LE(heard_.size(), 7U);
  EXPECT_TRUE(turn_until([&] { return heard_.size() == 10; }));
}

TEST_F(MqttClientTest, FindsABrokerByItsNameWithoutWaitingForIt) {
  make("localhost");
  const Time before = monotonic_now();
  client_->tick(now_);
  EXPECT_LT(monotonic_now() - before, 200ms);
  ASSERT_TRUE(turn_until([&] {
    ::usleep(1000);
    return broker_.version() == 5;
  }));
}

TEST_F(MqttClientTest, SaysThatANameIsUnknown) {
  make("no-such-host.invalid");
  ASSERT_TRUE(turn_until([&] {
    ::usleep(5000);
    return !said_.empty();
  }));
  EXPECT_THAT(said_.back(), HasSubstr("broker no-such-host.invalid"));
}

TEST_F(MqttClientTest, ComesBackWhenTheBrokerDoes) {
  connect();
  broker_.close();
  ASSERT_TRUE(turn_until([&] { return broker_.connections == 2; }));
  EXPECT_FALSE(client_->connected());
  EXPECT_THAT(said_, Not(IsEmpty()));
}

}  // namespace
}  // namespace drover::runtime
