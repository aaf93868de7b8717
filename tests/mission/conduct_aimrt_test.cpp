// The check of AimRT's rates finds the fault it is for, in a small record made by hand.
#include <gmock/gmock.h>

#include "mission/conduct.h"

namespace drover::mission {
namespace {

using testing::IsEmpty;
using testing::Not;
using testing::SizeIs;

Time at(int ms) {
  return Time{std::chrono::milliseconds(ms)};
}

/// Ten seconds of all three, as they should be.
struct Sound {
  Sound() {
    record.events = {{at(0), "start mosquitto"}, {at(0), "start droverd"}, {at(10'000), "the end"}};
    for (int ms = 100; ms <= 10'000; ms += 20) {
      say(ms, "JointState");
      say(ms, "ImuState");
      if (ms % 100 == 0) say(ms, "TouchState");
    }
  }
  void say(int ms, const std::string& type) {
    record.mqtt.push_back({at(ms), "/channel/x." + type, false, "1a030a0100"});
  }
  void drop(const std::string& type, int begin, int end) {
    std::erase_if(record.mqtt, [&](const MqttLine& line) {
      return line.topic.ends_with(type) && line.time > at(begin) && line.time < at(end);
    });
  }
  void tell_imu(int ms, bool heard) {
    Status status;
    status.time = at(ms);
    status.document = {{"sensor", {{"imu", heard}}}};
    record.statuses.push_back(status);
  }
  Record record;
};

TEST(MissionAimrtRates, FindEachMessageThatIsMissingAtBeginningOrEnd) {
  for (const char* type : {"JointState", "ImuState", "TouchState"}) {
    Sound late;
    late.drop(type, 0, 2200);
    EXPECT_THAT(check_aimrt_rates(late.record), SizeIs(1)) << type;
    Sound early;
    early.drop(type, 9600, 11'000);
    EXPECT_THAT(check_aimrt_rates(early.record), SizeIs(1)) << type;
  }
}

TEST(MissionAimrtRates, FindAGap) {
  for (const char* type : {"JointState", "ImuState", "TouchState"}) {
    Sound sound;
    sound.tell_imu(4100, true);
    sound.drop(type, 4000, 4201);
    EXPECT_THAT(check_aimrt_rates(sound.record), Not(IsEmpty())) << type;
  }
}

TEST(MissionAimrtRates, FindEachRateThatIsWrongByMoreThanAHundredth) {
  for (const char* type : {"JointState", "ImuState", "TouchState"}) {
    Sound sound;
    auto& lines = sound.record.mqtt;
    for (auto& line : lines)
      if (line.topic.ends_with(type)) line.time = at(200) + (line.time - at(200)) * 102 / 100;
    lines.erase(std::remove_if(lines.begin(), lines.end(),
                               [](const MqttLine& line) { return line.time > at(10'000); }),
                lines.end());
    EXPECT_THAT(check_aimrt_rates(sound.record), SizeIs(1)) << type;
  }
}

TEST(MissionAimrtRates, PermitAGapOfTheInertialSensorThatTheStatusTells) {
  Sound sound;
  sound.tell_imu(4100, false);
  sound.drop("ImuState", 4000, 5000);
  EXPECT_THAT(check_aimrt_rates(sound.record), IsEmpty());
}

TEST(MissionAimrtRates, PermitAContactThatIsToldAtOnce) {
  Sound sound;
  MqttLine change{at(4040), "/channel/x.TouchState", false, "1a030a0101"};
  sound.record.mqtt.push_back(change);
  std::stable_sort(sound.record.mqtt.begin(), sound.record.mqtt.end(),
                   [](const MqttLine& a, const MqttLine& b) { return a.time < b.time; });
  EXPECT_THAT(check_aimrt_rates(sound.record), IsEmpty());
  for (auto& line : sound.record.mqtt)
    if (line.time == at(4040)) line.payload = "1a030a0100";  // nothing changed
  EXPECT_THAT(check_aimrt_rates(sound.record), Not(IsEmpty()));
}

/// Whatever stands in a program that is stopped leaves in the instant in which it goes on.
TEST(MissionAimrtRates, PassOverWhatWaitedWhileDroverdWasStoppedAndNothingElse) {
  Sound sound;
  auto& events = sound.record.events;
  events.insert(events.begin() + 2,
                {{at(150), "signal 19 to droverd"}, {at(390), "signal 18 to droverd"}});
  for (const char* type : {"JointState", "ImuState", "TouchState"}) sound.drop(type, 150, 390);
  auto& lines = sound.record.mqtt;
  const auto next = std::find_if(lines.begin(), lines.end(), [](const auto& line) {
    return line.time == at(400) && line.topic.ends_with("TouchState");
  });
  const MqttLine waited{at(390) + std::chrono::microseconds(50), next->topic, false, next->payload};
  lines.insert(std::find_if(lines.begin(), lines.end(),
                            [](const auto& line) { return line.time > at(390); }),
               waited);
  EXPECT_THAT(check_aimrt_rates(sound.record), IsEmpty());
  sound.record.events.erase(sound.record.events.begin() + 2, sound.record.events.begin() + 4);
  EXPECT_THAT(check_aimrt_rates(sound.record), Not(IsEmpty()));
}

TEST(MissionAimrtRates, AreGoodAsTheyShouldBe) {
  EXPECT_THAT(check_aimrt_rates(Sound().record), IsEmpty());
}

}  // namespace
}  // namespace drover::mission
