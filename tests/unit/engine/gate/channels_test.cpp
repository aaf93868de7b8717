// What leaves towards devices of several channels, of a bus that they share with others, and on
// byte streams.
#include <gtest/gtest.h>

#include <stdexcept>

#include "engine/gate/frame_gate.h"

namespace drover::engine {
namespace {

constexpr auto kPass = FrameVerdict::pass;
constexpr auto kNotAllowed = FrameVerdict::refused_not_allowed;
constexpr auto kMotion = FrameVerdict::refused_motion;
constexpr ChannelMask kLeft = channel_bit(0);
constexpr ChannelMask kRight = channel_bit(1);
constexpr Channel kChannels[] = {{"left"}, {"right"}};
constexpr std::uint8_t kHead = 0x55;

/// Of each channel the speed in whole rad/s, as frame 200 + node, or after a head as a packet. On a
/// bus it starts its node with a frame that all nodes share.
class TwoWheels final : public Actuator {
 public:
  explicit TwoWheels(std::uint8_t node = 1, bool shares = true)
      : node_(node),
        rules_{{{0x000, false, false, 2, 2, shares}, {0x200U + node, false, false, 2, 2, false}}} {}
  std::span<const Channel> channels() const override { return kChannels; }
  void on_setpoints(std::span<const Setpoint>, Time, DriverOut&) override {}
  std::span<const FrameRule> rules() const override { return rules_; }
  Effect effect(const Message& message, Time now) const override {
    const auto bytes = message.payload();
    if (message.frame() != nullptr && message.frame()->id == 0)
      return {bytes[1] == node_ ? FrameEffect::harmless : FrameEffect::forbidden, 0};
    if (message.packet() != nullptr && (bytes.size() != 3 || bytes[0] != kHead)) return {};
    const auto speeds = bytes.last(2);
    if (speeds[0] == 99) return {FrameEffect::motion, 0};
    if (speeds[0] == 98) return {FrameEffect::motion, channel_bit(2)};
    const auto moves =
        static_cast<ChannelMask>((speeds[0] != 0 ? kLeft : 0) | (speeds[1] != 0 ? kRight : 0));
    if (moves == 0 || now < brakes_until) return {FrameEffect::stop, 0};
    return {FrameEffect::motion, moves};
  }
  double setpoint_radps(const Message& message, std::size_t channel) const override {
    return static_cast<std::int8_t>(message.payload().last(2)[channel]);
  }
  StopRecipe stop_recipe() const override { return {}; }
  SilenceBehaviour silence() const override { return {}; }

  Time brakes_until = kNever;

 private:
  std::uint8_t node_;
  std::array<FrameRule, 2> rules_;
};

CanFrame speeds(std::uint8_t left, std::uint8_t right) {
  return make_frame(0x201, {left, right});
}

Packet packet(std::initializer_list<std::uint8_t> bytes) {
  Packet all;
  for (const auto byte : bytes) EXPECT_TRUE(all.push_back(byte));
  return all;
}

class AGateOfChannels : public ::testing::Test {
 protected:
  AGateOfChannels() { gate.add(0, drive); }
  FrameVerdict admit(const Message& message, ChannelMask motion) {
    return gate.admit(0, message, drive, {motion, false, {}}, now);
  }
  /// Nothing may be driven; the wheels turn so fast and may be slowed.
  FrameVerdict slow(const Message& message, double left_radps, double right_radps,
                    bool right_too = true) {
    const Slowing slowing[] = {{true, left_radps}, {right_too, right_radps}};
    return gate.admit(0, message, drive, {0, false, slowing}, now);
  }
  TwoWheels drive;
  FrameGate gate;
  Time now{std::chrono::seconds(5)};
};

TEST_F(AGateOfChannels, AsksThePermissionOfEachChannelThatMayMove) {
  EXPECT_EQ(admit(speeds(5, 0), kLeft), kPass);
  EXPECT_EQ(admit(speeds(0, 5), kLeft), kMotion);
  EXPECT_EQ(admit(speeds(5, 5), kLeft), kMotion);
  EXPECT_EQ(admit(speeds(5, 5), kLeft | kRight), kPass);
  EXPECT_EQ(admit(speeds(0, 0), 0), kPass);
}

TEST_F(AGateOfChannels, RefusesAMotionOfNothingAndOfAChannelThatThereIsNot) {
  EXPECT_EQ(admit(speeds(99, 0), kAllChannels), kNotAllowed);
  EXPECT_EQ(admit(speeds(98, 0), kAllChannels), kNotAllowed);
}

TEST_F(AGateOfChannels, LetsEachChannelSlowDownByItself) {
  EXPECT_EQ(slow(speeds(10, 20), 10, 20), kPass);
  EXPECT_EQ(slow(speeds(10, 21), 10, 20), kMotion) << "the right one is no faster than its wheel";
  EXPECT_EQ(slow(speeds(5, 20), 10, 20), kPass);
  EXPECT_EQ(slow(speeds(6, 20), 10, 20), kMotion) << "the left one only falls";
  EXPECT_EQ(slow(speeds(4, 20), 10, 20), kPass);
  EXPECT_EQ(slow(speeds(4, 19), 10, 20, false), kMotion) << "only the left one may be slowed";
  gate.end_slowing(drive, 0);
  EXPECT_EQ(slow(speeds(9, 20), 10, 20), kPass) << "the left one's ramp begins anew";
  EXPECT_EQ(slow(speeds(9, 21), 10, 21), kMotion) << "the right one's goes on";
}

TEST_F(AGateOfChannels, ARefusedMessageChangesNoRamp) {
  EXPECT_EQ(slow(speeds(3, 21), 10, 20), kMotion);
  EXPECT_EQ(slow(speeds(10, 20), 10, 20), kPass);
}

TEST_F(AGateOfChannels, AnEffectMayGoByTheTime) {
  drive.brakes_until = now + std::chrono::seconds(1);
  EXPECT_EQ(admit(speeds(5, 5), 0), kPass);
  now += std::chrono::seconds(2);
  EXPECT_EQ(admit(speeds(5, 5), 0), kMotion);
}

TEST_F(AGateOfChannels, JudgesAPacketByWhatIsInIt) {
  EXPECT_EQ(admit(packet({kHead, 0, 0}), 0), kPass);
  EXPECT_EQ(admit(packet({kHead, 5, 0}), 0), kMotion);
  EXPECT_EQ(admit(packet({kHead, 5, 0}), kLeft), kPass);
  EXPECT_EQ(admit(packet({kHead, 5}), kAllChannels), kNotAllowed) << "it is not whole";
  EXPECT_EQ(admit(packet({0x54, 0, 0}), kAllChannels), kNotAllowed) << "it is none of the device's";
  EXPECT_EQ(admit(packet({}), kAllChannels), kNotAllowed);
  EXPECT_EQ(gate.counts(0).passed, 2U);
  EXPECT_EQ(gate.counts(0).not_allowed, 3U);
}

TEST(AGateOfABusThatNodesShare, TakesTwoDevicesWithASharedId) {
  const TwoWheels one(1);
  const TwoWheels other(2);
  FrameGate gate;
  gate.add(0, one);
  gate.add(0, other);
  const CanFrame start = make_frame(0x000, {1, 1});
  EXPECT_EQ(gate.admit(0, start, one, {}, Time{}), kPass);
  EXPECT_EQ(gate.admit(0, start, other, {}, Time{}), kNotAllowed) << "it means the first node";
  const CanFrame all = make_frame(0x000, {1, 0});
  EXPECT_EQ(gate.admit(0, all, one, {}, Time{}), kNotAllowed) << "every node of the bus";
}

TEST(AGateOfABusThatNodesShare, RefusesEverythingElseThatIsThereTwice) {
  const TwoWheels one(1);
  const TwoWheels twin(1);
  const TwoWheels alone(2, false);
  FrameGate gate;
  gate.add(0, one);
  EXPECT_THROW(gate.add(0, twin), std::runtime_error) << "one node number";
  EXPECT_THROW(gate.add(0, alone), std::runtime_error) << "shared by only one of both";
}

}  // namespace
}  // namespace drover::engine
