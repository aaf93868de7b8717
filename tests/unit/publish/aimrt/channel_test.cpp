#include "publish/aimrt/channel.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdlib>

#include "drover/angle.h"
#include "tests/unit/publish/aimrt/wire.h"

namespace drover::publish::aimrt {
namespace {

using test::hex;
using test::in_packet;
using test::joint_entry;
using test::stamp;

constexpr Duration kWallMinusMonotonic = std::chrono::hours(400'000);

class AnAimrtChannel : public testing::Test {
 protected:
  AnAimrtChannel() {
    commands_config_.rules.joints = {"left", "right"};
    make();
  }
  void make() {
    commands_.emplace(commands_config_);
    channel_.emplace(config_, *commands_);
  }
  void give(const std::string& payload, const Arrival& arrival = {},
            Names names = Names::document) {
    channel_->on_command(names, payload, arrival, now_, kWallMinusMonotonic, actions_);
  }
  std::uint64_t wall_ns() const {
    return static_cast<std::uint64_t>((now_.time_since_epoch() + kWallMinusMonotonic).count());
  }
  template <class Body>
  std::vector<Body> commands() const {
    std::vector<Body> all;
    for (const auto& action : actions_)
      if (const auto* command = std::get_if<Command>(&action))
        if (const auto* body = std::get_if<Body>(&command->body)) all.push_back(*body);
    return all;
  }
  std::size_t log_lines() const {
    std::size_t lines = 0;
    for (const auto& action : actions_) lines += std::holds_alternative<LogLine>(action) ? 1 : 0;
    return lines;
  }
  std::string last_refusal() const {
    const auto all = commands<JointTargetsRefused>();
    return all.empty() ? "" : std::string(all.back().reason.view());
  }

  ChannelConfig config_;
  JointCommandsConfig commands_config_;
  std::optional<JointCommands> commands_;
  std::optional<Channel> channel_;
  Actions actions_;
  Time now_ = Time(from_s(1000));
};

TEST_F(AnAimrtChannel, NeverFollowsARetainedMessage) {
  give(in_packet(joint_entry("left", 0, 1)), {.retain = Retain::asked});
  EXPECT_EQ(last_refusal(), "a retained message is never followed");
  EXPECT_TRUE(commands<JointTargets>().empty());
}

/// A stream that was there before this program: refused, it has to pause.
TEST_F(AnAimrtChannel, FollowsNobodyWhileItHasOnlyJustCome) {
  give(in_packet(joint_entry("left", 0, 0)), {.just_connected = true});
  EXPECT_EQ(last_refusal(), "droverd has only just come, and nobody's commands are followed yet");
  EXPECT_TRUE(commands<JointTargetsRefused>().back().was_there);
  EXPECT_TRUE(commands<JointTargets>().empty());
  give(in_packet(joint_entry("nobody's", 0, 0)));
  EXPECT_FALSE(commands<JointTargetsRefused>().back().was_there);
  give(in_packet(joint_entry("left", 0, 0)));
  EXPECT_EQ(commands<JointTargets>().size(), 1U);
}

TEST_F(AnAimrtChannel, RefusesWhatIsNoPacketOfACommand) {
  give("");
  EXPECT_EQ(last_refusal(), "the packet ends inside its content type");
  give(hex("04 79 61 6d 6c 00 7b 7d"));
  EXPECT_EQ(last_refusal(), "the content type 'yaml' is neither pb nor json");
  give(hex("04 6a 73 6f 6e 00 7b 7d"));
  EXPECT_EQ(last_refusal(), "it names no joint");
  give(hex("04 6a 73 6f 6e 00 7b"));
  EXPECT_EQ(last_refusal().substr(0, 35), "the JSON is no JointCommand: line 1");
  give(in_packet("x"));
  EXPECT_EQ(last_refusal(), "the message is no JointCommand");
  give(in_packet("x"), {}, Names::aimrt_1x);
  EXPECT_EQ(last_refusal(), "the message is no JointCommandArray");
  give(in_packet(std::string(kMaxCommandBytes + 1, '\0')));
  EXPECT_EQ(last_refusal(), "the packet is longer than 16 KiB");
  give(in_packet(joint_entry("left", 0, 1) + joint_entry("wing", 0, 1)));
  EXPECT_EQ(last_refusal(), "joint 'wing': there is no such joint");
  EXPECT_TRUE(commands<JointTargets>().empty());
}

/// A packet of one pair of context, with a value of so many bytes.
std::string with_context(std::size_t bytes, const std::string& message) {
  return hex("02 70 62 01 01 00 6b") + static_cast<char>(bytes & 0xFFU) +
         static_cast<char>(bytes >> 8U) + std::string(bytes, 'v') + message;
}

TEST_F(AnAimrtChannel, BoundsAPacketWithAllThatItCarries) {
  const std::string message = joint_entry("left", 0, 1);
  give(with_context(kMaxCommandBytes - message.size() - 9, message));
  EXPECT_EQ(commands<JointTargets>().size(), 1U);
  give(with_context(kMaxCommandBytes - message.size() - 8, message));
  EXPECT_EQ(last_refusal(), "the packet is longer than 16 KiB");
  EXPECT_EQ(commands<JointTargets>().size(), 1U);
}

TEST_F(AnAimrtChannel, PassesAStreamOn) {
  for (int i = 0; i < 3; ++i) {
    give(in_packet(stamp(wall_ns()) + joint_entry("right", 0, 0.5 * i)));
    now_ += std::chrono::milliseconds(5);
  }
  const auto targets = commands<JointTargets>();
  ASSERT_EQ(targets.size(), 3U);
  EXPECT_EQ(targets[2].joints[0].axis, 1);
  EXPECT_EQ(targets[2].joints[0].velocity_radps, 1.0);
  const auto& last = std::get<Command>(actions_.back());
  EXPECT_EQ(last.id.source, RequestId::Source::aimrt);
  EXPECT_EQ(last.id.number, 3U);
  EXPECT_EQ(last.received, now_ - std::chrono::milliseconds(5));
  EXPECT_EQ(log_lines(), 0U);
}

TEST_F(AnAimrtChannel, FollowsTheSameStampOnce) {
  const auto payload = in_packet(stamp(wall_ns()) + joint_entry("left", 0, 1));
  give(payload);
  give(payload);
  EXPECT_EQ(commands<JointTargets>().size(), 1U);
  EXPECT_EQ(last_refusal(), "time_stamp is not newer than the last accepted one");
}

TEST_F(AnAimrtChannel, TakesALastStampFromAcceptedMessagesOnly) {
  give(in_packet(stamp(wall_ns() + 1'000'000) + joint_entry("wing", 0, 1)));
  give(in_packet(stamp(wall_ns()) + joint_entry("left", 0, 1)));
  EXPECT_EQ(commands<JointTargets>().size(), 1U);
}

TEST_F(AnAimrtChannel, LeavesRoomForOthersInAFlood) {
  for (int i = 0; i < 10'000; ++i) {
    give(in_packet(joint_entry("left", 0, 1)));
    now_ += std::chrono::microseconds(100);
  }
  EXPECT_LE(commands<JointTargets>().size(), 250U + 50U + 1U);
  EXPECT_LE(commands<JointTargetsRefused>().size(), 2U);
  EXPECT_EQ(last_refusal(), "slow down: 250 messages a second are taken, and 50 at once");
}

TEST_F(AnAimrtChannel, TakesTwoHundredMessagesASecond) {
  for (int i = 0; i < 2000; ++i) {
    give(in_packet(joint_entry("left", 0, 1)));
    now_ += std::chrono::milliseconds(5);
  }
  EXPECT_EQ(commands<JointTargets>().size(), 2000U);
}

TEST_F(AnAimrtChannel, TellsTheLogOfAStreamOfRefusalsNowAndThen) {
  for (int i = 0; i < 1000; ++i) {
    give(in_packet(joint_entry("joint" + std::to_string(i), 0, 1)));
    now_ += std::chrono::milliseconds(10);
  }
  EXPECT_EQ(commands<JointTargetsRefused>().size(), 1000U);
  EXPECT_LE(log_lines(), 5U);
  EXPECT_GE(log_lines(), 3U);
}

TEST_F(AnAimrtChannel, PublishesAnInertialSampleOnceAndOnlyAFreshOne) {
  Snapshot snapshot;
  snapshot.time = now_;
  const auto topics = [&] {
    std::vector<std::string> names;
    snapshot.time += std::chrono::milliseconds(20);
    for (const auto& each : channel_->telemetry(snapshot, kWallMinusMonotonic))
      names.push_back(*each.topic);
    return names;
  };
  const std::string joints = "/channel/%2Fjoint_state/pb%3Aaimrt.protocols.sensor.JointState";
  const std::string imu = "/channel/%2Fimu_state/pb%3Aaimrt.protocols.sensor.ImuState";
  EXPECT_EQ(topics(), std::vector{joints});
  snapshot.imu.configured = true;
  snapshot.imu.time = now_;
  snapshot.imu.health = SourceState::stale;
  EXPECT_EQ(topics(), std::vector{joints});
  snapshot.imu.health = SourceState::fresh;
  EXPECT_EQ(topics(), (std::vector{joints, imu}));
  EXPECT_EQ(topics(), std::vector{joints});
  snapshot.imu.time += std::chrono::milliseconds(10);
  EXPECT_EQ(topics(), (std::vector{joints, imu}));
}

/// Of the orientation in a JSON message: x, y, z, w.
std::array<double, 4> quaternion_in(const std::string& text) {
  std::array<double, 4> q{};
  const auto begin = text.find("\"orientation\":{");
  for (std::size_t i = 0; i < q.size(); ++i) {
    const auto key = text.find(std::string("\"") + "xyzw"[i] + "\":", begin);
    q[i] = begin == text.npos || key == text.npos ? kAbsent : std::atof(text.c_str() + key + 4);
  }
  return q;
}

// The sensor's yaw is half a turn off the robot's, give or take its noise.
TEST_F(AnAimrtChannel, TurnsTheQuaternionWithoutAJumpThreeTimesRound) {
  config_.imu_state_wording.content = Content::json;
  make();
  Snapshot snapshot;
  snapshot.imu.configured = true;
  snapshot.imu.health = SourceState::fresh;
  snapshot.imu.sample.has_orientation = true;
  std::array<double, 4> last{};
  for (int i = 0; i <= 1080; ++i) {
    now_ += std::chrono::milliseconds(20);
    const double yaw_rad = to_rad(i);
    const double sensor_rad = yaw_rad + kPi + (i % 2 == 0 ? 0.01 : -0.01);
    snapshot.time = snapshot.imu.time = snapshot.pose.time = now_;
    snapshot.pose.yaw_rad = wrap_rad(yaw_rad);
    snapshot.pose.yaw_sigma_rad = 0.01;
    snapshot.imu.sample.orientation = {std::cos(sensor_rad / 2), 0, 0, std::sin(sensor_rad / 2)};
    const auto sent = channel_->telemetry(snapshot, kWallMinusMonotonic);
    ASSERT_EQ(sent.size(), 2U);
    const auto q = quaternion_in(sent[1].payload);
    ASSERT_NEAR(wrap_rad(2 * std::atan2(q[2], q[3]) - yaw_rad), 0, 1e-9);
    if (i == 0) EXPECT_GE(q[3], 0);
    if (i > 0) ASSERT_NEAR(std::hypot(q[2] - last[2], q[3] - last[3]), 0, 0.01) << i << " degrees";
    last = q;
  }
}

TEST_F(AnAimrtChannel, StampsNoTwoJointStatesAlikeAndIsSilentWithoutANewCycle) {
  Snapshot snapshot;
  snapshot.time = now_;
  AxisSnapshot axis;
  axis.health = SourceState::fresh;
  axis.last_motion = now_ - std::chrono::milliseconds(5);
  ASSERT_TRUE(snapshot.axes.push_back(axis));
  const auto first = channel_->telemetry(snapshot, kWallMinusMonotonic);
  ASSERT_EQ(first.size(), 1U);
  snapshot.time += std::chrono::milliseconds(20);
  const auto late = channel_->telemetry(snapshot, kWallMinusMonotonic);
  ASSERT_EQ(late.size(), 1U) << "the drive is late, and not yet silent";
  // The stamp follows the packet's head, the header's key and length and its own key.
  EXPECT_NE(first[0].payload.substr(0, 24), late[0].payload.substr(0, 24));
  EXPECT_EQ(channel_->telemetry(snapshot, kWallMinusMonotonic).size(), 0U) << "the same cycle";
}

TEST_F(AnAimrtChannel, CountsWhatItDoesNotReadOfAFlood) {
  for (int i = 0; i < 1000; ++i) give(in_packet(joint_entry("left", 0, 1)));
  const auto told = commands<JointTargets>().size() + commands<JointTargetsRefused>().size();
  EXPECT_GT(commands_->unread(), 900U);
  EXPECT_EQ(told + commands_->unread(), 1000U);
}

TEST_F(AnAimrtChannel, PublishesTouchOnlyWhereAContactIsConfigured) {
  Snapshot snapshot;
  snapshot.time = now_;
  snapshot.line_configured[static_cast<std::size_t>(Line::estop)] = true;
  EXPECT_EQ(channel_->telemetry(snapshot, kWallMinusMonotonic).size(), 1U);
  snapshot.line_configured[static_cast<std::size_t>(Line::zone_far)] = true;
  snapshot.time += std::chrono::milliseconds(20);
  const auto packets = channel_->telemetry(snapshot, kWallMinusMonotonic);
  ASSERT_EQ(packets.size(), 2U);
  EXPECT_EQ(*packets[1].topic, "/channel/%2Ftouch_state/pb%3Aaimrt.protocols.sensor.TouchState");
}

TEST_F(AnAimrtChannel, PublishesTouchAtEachChangeAndTenTimesASecond) {
  Snapshot snapshot;
  snapshot.time = now_;
  snapshot.line_configured[static_cast<std::size_t>(Line::bumper)] = true;
  snapshot.line_health.fill(SourceState::fresh);
  const auto is_published = [&] {
    const auto packets = channel_->telemetry(snapshot, kWallMinusMonotonic);
    return !packets.empty() && packets.back().topic->find("touch_state") != std::string::npos;
  };
  int published = 0;
  for (int i = 0; i < 50; ++i) {
    published += is_published() ? 1 : 0;
    snapshot.time += std::chrono::milliseconds(20);
  }
  EXPECT_EQ(published, 10);
  EXPECT_TRUE(is_published());
  EXPECT_FALSE(is_published());
  snapshot.line_active[static_cast<std::size_t>(Line::bumper)] = true;
  EXPECT_TRUE(is_published());
  EXPECT_FALSE(is_published());
  snapshot.line_active[static_cast<std::size_t>(Line::bumper)] = false;
  EXPECT_TRUE(is_published());
  snapshot.line_health[static_cast<std::size_t>(Line::bumper)] = SourceState::stale;
  EXPECT_TRUE(is_published()) << "not to be read is touched";
}

TEST_F(AnAimrtChannel, PublishesNoTouchForAnEstopAlone) {
  Snapshot snapshot;
  snapshot.time = now_;
  for (const Line line : {Line::bumper, Line::estop})
    snapshot.line_configured[static_cast<std::size_t>(line)] = true;
  snapshot.line_health.fill(SourceState::fresh);
  const auto count = [&] { return channel_->telemetry(snapshot, kWallMinusMonotonic).size(); };
  const auto with_touch = count();
  snapshot.line_active[static_cast<std::size_t>(Line::estop)] = true;
  snapshot.time += std::chrono::milliseconds(20);
  EXPECT_EQ(count(), with_touch - 1);
}

TEST_F(AnAimrtChannel, CountsTheMessagesOfEachType) {
  Snapshot snapshot;
  snapshot.time = now_;
  (void)channel_->telemetry(snapshot, kWallMinusMonotonic);
  snapshot.time += std::chrono::milliseconds(20);
  const auto second = channel_->telemetry(snapshot, kWallMinusMonotonic);
  const auto& payload = second[0].payload;
  EXPECT_EQ(payload.substr(payload.size() - 2), hex("18 02")) << "sequence_num = 3";
}

TEST_F(AnAimrtChannel, ListensToTheConfiguredTopicUnderBothNames) {
  config_.joint_command = "/arm/joint command";
  const Channel channel(config_, *commands_);
  const std::string topic =
      "/channel/%2Farm%2Fjoint+command/pb%3Aaimrt.protocols.sensor.JointCommand";
  EXPECT_EQ(channel.command_topics(), (std::vector{topic, topic + "Array"}));
  EXPECT_EQ(channel.command_names(topic), Names::document);
  EXPECT_EQ(channel.command_names(topic + "Array"), Names::aimrt_1x);
  EXPECT_EQ(channel.command_names(topic + "s"), std::nullopt);
}

TEST_F(AnAimrtChannel, FollowsEitherFamilyWrittenInEitherWay) {
  const std::string json = std::string("\x04json\0", 6) + R"({"header":{"time_stamp":")" +
                           std::to_string(wall_ns()) +
                           R"("},"joints":[{"name":"right","velocity":0}]})";
  const auto pb = in_packet(stamp(wall_ns()) + joint_entry("right", 0, 0));
  std::size_t followed = 0;
  for (const auto names : {Names::document, Names::aimrt_1x})
    for (const auto& payload : {json, pb}) {
      // Each begins anew: the one before is silent, and its stamps are old.
      make();
      give(payload, {}, names);
      EXPECT_EQ(commands<JointTargets>().size(), ++followed) << last_refusal();
    }
}

TEST_F(AnAimrtChannel, HasOneLimitForAllNames) {
  for (int i = 0; i < 1000; ++i) {
    give(in_packet(joint_entry("left", 0, 0)), {}, Names::document);
    give(in_packet(joint_entry("left", 0, 0)), {}, Names::aimrt_1x);
  }
  EXPECT_GT(commands_->unread(), 1900U);
}

TEST_F(AnAimrtChannel, FollowsOneOfTwoProgramsAndNamesBothInTheLog) {
  for (int i = 0; i < 100; ++i) {
    give(in_packet(joint_entry("left", 0, 1)), {}, Names::document);
    give(in_packet(joint_entry("left", 0, 2)), {}, Names::aimrt_1x);
    now_ += std::chrono::milliseconds(20);
  }
  const auto targets = commands<JointTargets>();
  ASSERT_EQ(targets.size(), 100U);
  for (const auto& each : targets) EXPECT_EQ(each.joints[0].velocity_radps, 1.0);
  EXPECT_EQ(commands<JointTargetsRefused>().size(), 100U);
  EXPECT_EQ(commands_->rivals_refused(), 100U);
  const std::string told =
      "two programs write joint commands: JointCommand (pb) has the joints, JointCommandArray "
      "(pb) is refused";
  EXPECT_EQ(commands_->rivals(now_), told);
  EXPECT_EQ(log_lines(), 1U);
  for (const auto& action : actions_)
    if (const auto* line = std::get_if<LogLine>(&action)) {
      EXPECT_EQ(line->text, "joint command refused: " + told);
    }
}

TEST_F(AnAimrtChannel, NamesTwoProgramsAlsoAmongOtherRefusals) {
  for (int i = 0; i < 10; ++i) give(in_packet(joint_entry("wing", 0, 1)));
  const auto before = log_lines();
  give(in_packet(joint_entry("left", 0, 1)), {}, Names::document);
  give(in_packet(joint_entry("left", 0, 1)), {}, Names::aimrt_1x);
  EXPECT_EQ(log_lines(), before + 1);
}

TEST_F(AnAimrtChannel, IsNotDisturbedByTheStampsOfAProgramThatIsRefused) {
  const auto ms = [](int count) { return static_cast<std::uint64_t>(count) * 1'000'000; };
  for (int i = 0; i < 20; ++i) {
    give(in_packet(stamp(wall_ns()) + joint_entry("left", 0, 1)), {}, Names::document);
    give(in_packet(stamp(wall_ns() + ms(500)) + joint_entry("left", 0, 2)), {}, Names::aimrt_1x);
    now_ += std::chrono::milliseconds(20);
  }
  EXPECT_EQ(commands<JointTargets>().size(), 20U);
}

TEST_F(AnAimrtChannel, PublishesUnderTheNamesThatAreConfigured) {
  Snapshot snapshot;
  snapshot.time = now_;
  snapshot.line_configured[static_cast<std::size_t>(Line::bumper)] = true;
  config_.joint_state_wording.names = {Names::document, Names::aimrt_1x};
  config_.touch_state_wording.names = {Names::aimrt_1x};
  Channel channel(config_, *commands_);
  const auto packets = channel.telemetry(snapshot, kWallMinusMonotonic);
  ASSERT_EQ(packets.size(), 3U);
  const std::string joints = "/channel/%2Fjoint_state/pb%3Aaimrt.protocols.sensor.JointState";
  EXPECT_EQ(*packets[0].topic, joints);
  EXPECT_EQ(*packets[1].topic, joints + "Array");
  EXPECT_EQ(packets[0].payload, packets[1].payload);
  EXPECT_EQ(*packets[2].topic,
            "/channel/%2Ftouch_state/pb%3Aaimrt.protocols.sensor.TouchSensorStateArray");
}

/// A robot with an arm: its joints have owners of their own.
class AnAimrtChannelOfAnArm : public AnAimrtChannel {
 protected:
  AnAimrtChannelOfAnArm() {
    commands_config_.rules.joints = {{"left"}, {"right"}, {"elbow", JointFollows::impedance, 1}};
    make();
  }
  void stamped(std::string_view joint, double velocity, int frame, std::uint64_t late_ns = 0) {
    const std::string header =
        test::bytes_field(1, test::varint_field(1, wall_ns() - late_ns) +
                                 test::bytes_field(2, frame == 0 ? "drive" : "arm"));
    give(in_packet(header + joint_entry(joint, 0, velocity)));
  }
};

TEST_F(AnAimrtChannelOfAnArm, HearsAProgramForEach) {
  for (int i = 0; i < 20; ++i) {
    stamped("left", 0, 0);
    stamped("elbow", 0.5, 1, 3'000'000);  // its clock is its own
    now_ += std::chrono::milliseconds(10);
  }
  EXPECT_EQ(commands<JointTargets>().size(), 40u);
  EXPECT_EQ(last_refusal(), "");
  EXPECT_EQ(commands_->rivals(now_), "");
}

TEST_F(AnAimrtChannelOfAnArm, NamesTwoProgramsOfOneGroup) {
  stamped("elbow", 0, 1);
  now_ += std::chrono::milliseconds(10);
  stamped("elbow", 0, 0);
  EXPECT_NE(last_refusal().find("two programs write joint commands"), std::string::npos);
  EXPECT_EQ(commands_->rivals_refused(), 1u);
}

}  // namespace
}  // namespace drover::publish::aimrt
