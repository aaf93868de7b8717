#include "engine/gate/frame_gate.h"

#include <gtest/gtest.h>

#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace drover::engine {
namespace {

/// Sends 0x10 (8 bytes; first byte: 0 stop, 1 motion, 2 harmless, else forbidden), 0x11 as a remote
/// frame, and 0x12 extended.
constexpr Channel kOne{"axis"};

class FakeDrive : public Actuator {
 public:
  explicit FakeDrive(std::uint32_t base = 0x10, std::uint8_t max_len = 8)
      : rules_{{base, false, false, 8, max_len},
               {base + 1, false, true, 0, 0},
               {base + 2, true, false, 1, 4}} {}
  std::span<const Channel> channels() const override { return {&kOne, 1}; }
  void on_setpoints(std::span<const Setpoint>, Time, DriverOut&) override {}
  std::span<const FrameRule> rules() const override { return rules_; }
  Effect effect(const Message& message, Time) const override {
    const CanFrame& frame = *message.frame();
    if (frame.remote || frame.extended) return {FrameEffect::harmless, 0};
    switch (frame.data[0]) {
      case 0: return {FrameEffect::stop, 0};
      case 1: return {FrameEffect::motion, 1};
      case 2: return {FrameEffect::harmless, 0};
      case 0xFF: return {static_cast<FrameEffect>(77), 0};
      default: return {FrameEffect::forbidden, 0};
    }
  }
  /// The second byte, of a stop or a motion.
  double setpoint_radps(const Message& message, std::size_t) const override {
    const CanFrame& frame = *message.frame();
    return frame.data[0] <= 1 ? static_cast<std::int8_t>(frame.data[1]) : kAbsent;
  }
  StopRecipe stop_recipe() const override { return {}; }
  SilenceBehaviour silence() const override { return {}; }

 private:
  std::vector<FrameRule> rules_;
};

CanFrame frame(std::uint8_t first) {
  return make_frame(0x10, {first, 0, 0, 0, 0, 0, 0, 0});
}

Permission permission(bool motion, bool guard = false) {
  return {motion ? kAllChannels : ChannelMask{0}, guard, {}};
}

class AFrameGate : public ::testing::Test {
 protected:
  AFrameGate() {
    gate.add(1, drive);
    gate.add(1, other);
  }
  FrameVerdict admit(const CanFrame& f, bool motion = true, bool guard = false) {
    return gate.admit(1, f, drive, permission(motion, guard), Time{});
  }
  FakeDrive drive;
  FakeDrive other{0x20};
  FakeDrive stranger{0x10};
  FrameGate gate;
};

constexpr auto kNotAllowed = FrameVerdict::refused_not_allowed;

TEST_F(AFrameGate, RefusesAnIdThatIsNotOnTheList) {
  CanFrame f = frame(0);
  f.id = 0x13;
  EXPECT_EQ(admit(f), kNotAllowed);
}
TEST_F(AFrameGate, RefusesTheIdOfAnotherDriveOfTheBus) {
  CanFrame f = frame(0);
  f.id = 0x20;
  EXPECT_EQ(admit(f), kNotAllowed);
  EXPECT_EQ(gate.admit(1, f, other, permission(true), Time{}), FrameVerdict::pass);
}
TEST_F(AFrameGate, RefusesADriveOnABusItDoesNotHangOn) {
  EXPECT_EQ(gate.admit(0, frame(0), drive, permission(true), Time{}), kNotAllowed);
}
TEST_F(AFrameGate, RefusesASenderItWasNotToldOf) {
  EXPECT_EQ(gate.admit(1, frame(0), stranger, permission(true), Time{}), kNotAllowed);
}
TEST_F(AFrameGate, RefusesABusThatDoesNotExist) {
  EXPECT_EQ(gate.admit(FrameGate::kMaxLinks, frame(0), drive, permission(true), Time{}),
            kNotAllowed);
}
TEST_F(AFrameGate, RefusesTheExtendedTwinOfAStandardId) {
  CanFrame f = frame(0);
  f.extended = true;
  EXPECT_EQ(admit(f), kNotAllowed);
}
TEST_F(AFrameGate, RefusesADataFrameWhereARemoteFrameIsListed) {
  EXPECT_EQ(admit(make_frame(0x11)), kNotAllowed);
}
TEST_F(AFrameGate, RefusesARemoteFrameWhereADataFrameIsListed) {
  CanFrame f = frame(0);
  f.remote = true;
  EXPECT_EQ(admit(f), kNotAllowed);
}
TEST_F(AFrameGate, RefusesATooShortAndATooLongFrame) {
  CanFrame f = frame(0);
  f.len = 7;
  EXPECT_EQ(admit(f), kNotAllowed);
  f = make_frame(0x12, {1, 2, 3, 4, 5});
  f.extended = true;
  EXPECT_EQ(admit(f), kNotAllowed);
}
TEST_F(AFrameGate, RefusesAnFdFrameUnderARuleForClassicFrames) {
  CanFrame f = frame(0);
  f.fd = true;
  EXPECT_EQ(admit(f), kNotAllowed);
}
TEST_F(AFrameGate, RefusesAnErrorFrame) {
  CanFrame f = frame(0);
  f.error = true;
  EXPECT_EQ(admit(f), kNotAllowed);
}
TEST_F(AFrameGate, RefusesAForbiddenEffectWhateverIsPermitted) {
  EXPECT_EQ(admit(frame(9), true, false), kNotAllowed);
}
TEST_F(AFrameGate, RefusesAnEffectThatItDoesNotKnow) {
  EXPECT_EQ(admit(frame(0xFF), true, false), kNotAllowed);
}
TEST_F(AFrameGate, RefusesMotionWhileNoneIsPermitted) {
  EXPECT_EQ(admit(frame(1), false, false), FrameVerdict::refused_motion);
}
TEST_F(AFrameGate, RefusesMotionWhileTheGuardHasTheBus) {
  EXPECT_EQ(admit(frame(1), true, true), FrameVerdict::refused_motion);
}
TEST_F(AFrameGate, PassesMotionOnlyWhenItIsPermitted) {
  EXPECT_EQ(admit(frame(1), true, false), FrameVerdict::pass);
}
TEST_F(AFrameGate, PassesStopsAndHarmlessFramesAtAnyTime) {
  for (const bool motion : {false, true}) {
    for (const bool guard : {false, true}) {
      EXPECT_EQ(admit(frame(0), motion, guard), FrameVerdict::pass);
      EXPECT_EQ(admit(frame(2), motion, guard), FrameVerdict::pass);
    }
  }
}
TEST_F(AFrameGate, PassesRemoteAndExtendedFramesThatAreListedSo) {
  CanFrame remote = make_frame(0x11);
  remote.remote = true;
  EXPECT_EQ(admit(remote), FrameVerdict::pass);
  CanFrame extended = make_frame(0x12, {1});
  extended.extended = true;
  EXPECT_EQ(admit(extended), FrameVerdict::pass);
}
TEST_F(AFrameGate, CountsWhatItDoesOnEachBus) {
  admit(frame(0));
  admit(frame(1), false);
  admit(frame(1), false);
  admit(frame(9));
  EXPECT_EQ(gate.counts(1).passed, 1U);
  EXPECT_EQ(gate.counts(1).motion, 2U);
  EXPECT_EQ(gate.counts(1).not_allowed, 1U);
  EXPECT_EQ(gate.counts(0).passed, 0U);
}
TEST_F(AFrameGate, RefusesEveryIdOfEveryBusThatNobodyListed) {
  for (std::size_t bus = 0; bus < FrameGate::kMaxLinks; ++bus) {
    for (std::uint32_t id = 0; id < 0x800; ++id) {
      CanFrame f = frame(0);
      f.id = id;
      const bool listed = bus == 1 && id == 0x10;
      EXPECT_EQ(gate.admit(bus, f, drive, permission(true), Time{}) == FrameVerdict::pass, listed)
          << id;
    }
  }
}

TEST(FrameGate, PassesFdFramesUnderARuleForMoreThanEightBytes) {
  const FakeDrive fd_drive(0x10, 16);
  FrameGate gate;
  gate.add(0, fd_drive);
  CanFrame f = frame(0);
  EXPECT_EQ(gate.admit(0, f, fd_drive, permission(true), Time{}), kNotAllowed);
  f.fd = true;
  f.len = 16;
  EXPECT_EQ(gate.admit(0, f, fd_drive, permission(true), Time{}), FrameVerdict::pass);
}
TEST(FrameGate, RefusesToBeBuiltWithTwoDrivesOfOneNumberOnOneBus) {
  const FakeDrive a;
  const FakeDrive b;
  FrameGate gate;
  gate.add(0, a);
  EXPECT_THROW(gate.add(0, b), std::runtime_error);
  EXPECT_NO_THROW(gate.add(1, b));
}
TEST(FrameGate, RefusesToBeBuiltWithMoreBusesOrDrivesThanItHolds) {
  FrameGate gate;
  const FakeDrive one;
  EXPECT_THROW(gate.add(FrameGate::kMaxLinks, one), std::runtime_error);
  std::vector<FakeDrive> drives;
  for (std::uint32_t i = 0; i <= kMaxAxes; ++i) drives.emplace_back(0x100 + 4 * i);
  for (std::size_t i = 0; i < kMaxAxes; ++i) gate.add(0, drives[i]);
  EXPECT_THROW(gate.add(0, drives[kMaxAxes]), std::runtime_error);
}

/// Nobody may move it, but what rolls may be brought to rest.
class AFrameGateThatLetsSlowDown : public AFrameGate {
 protected:
  FrameVerdict slow(int radps, double measured_radps, bool guard = false) {
    CanFrame f = frame(radps == 0 ? 0 : 1);
    f.data[1] = static_cast<std::uint8_t>(radps);
    const Slowing slowing[] = {{true, measured_radps}};
    return gate.admit(1, f, drive, {0, guard, slowing}, Time{});
  }
};
constexpr auto kRefusedMotion = FrameVerdict::refused_motion;

TEST_F(AFrameGateThatLetsSlowDown, LetsARampFromTheMeasuredSpeedPass) {
  for (const int radps : {20, 15, 15, 3, 0}) EXPECT_EQ(slow(radps, 20), FrameVerdict::pass);
  gate.end_slowing(drive, 0);
  for (const int radps : {-20, -15, -1, 0}) EXPECT_EQ(slow(radps, -20), FrameVerdict::pass);
}
TEST_F(AFrameGateThatLetsSlowDown, TakesTheZerosOfRestForNoRamp) {
  // The order of a cycle: the ramp is ended, then the drive says zero, as at rest.
  for (int cycle = 0; cycle < 3; ++cycle) {
    gate.end_slowing(drive, 0);
    EXPECT_EQ(admit(frame(0), false), FrameVerdict::pass);
  }
  for (const int radps : {20, 15, 0}) EXPECT_EQ(slow(radps, 20), FrameVerdict::pass);
  EXPECT_EQ(slow(1, 20), kRefusedMotion) << "this zero was the ramp's end";
}
TEST_F(AFrameGateThatLetsSlowDown, RefusesMoreThanTheWheelHas) {
  EXPECT_EQ(slow(21, 20), kRefusedMotion);
  EXPECT_EQ(slow(1, 0), kRefusedMotion);
  EXPECT_EQ(slow(1, kAbsent), kRefusedMotion);
}
TEST_F(AFrameGateThatLetsSlowDown, RefusesToTurnTheOtherWay) {
  EXPECT_EQ(slow(-5, 20), kRefusedMotion);
}
TEST_F(AFrameGateThatLetsSlowDown, RefusesARampThatGrowsAgain) {
  EXPECT_EQ(slow(10, 20), FrameVerdict::pass);
  EXPECT_EQ(slow(11, 20), kRefusedMotion);
  EXPECT_EQ(slow(0, 20), FrameVerdict::pass);
  EXPECT_EQ(slow(1, 20), kRefusedMotion);
}
TEST_F(AFrameGateThatLetsSlowDown, RefusesItWhileTheGuardHasTheBus) {
  EXPECT_EQ(slow(10, 20, true), kRefusedMotion);
}

/// Two joints in one frame, or a base: bytes 1 and 2 are what is asked.
constexpr Channel kTwo[] = {{"left"}, {"right"}};
constexpr Channel kBase{"base", ChannelMode::twist};

class FakePair : public FakeDrive {
 public:
  std::span<const Channel> channels() const override { return kTwo; }
  Effect effect(const Message& message, Time now) const override {
    const Effect one = FakeDrive::effect(message, now);
    return one.kind == FrameEffect::motion ? Effect{one.kind, 3} : one;
  }
  double setpoint_radps(const Message& message, std::size_t channel) const override {
    return static_cast<std::int8_t>(message.frame()->data[1 + channel]);
  }
};

class FakeBase final : public FakePair {
 public:
  std::span<const Channel> channels() const override { return {&kBase, 1}; }
  Effect effect(const Message& message, Time now) const override {
    return FakeDrive::effect(message, now);
  }
  Twist setpoint_twist(const Message& message, std::size_t) const override {
    return {setpoint_radps(message, 0), setpoint_radps(message, 1)};
  }
};

CanFrame both(int first, int second) {
  CanFrame f = frame(first == 0 && second == 0 ? 0 : 1);
  f.data[1] = static_cast<std::uint8_t>(first);
  f.data[2] = static_cast<std::uint8_t>(second);
  return f;
}

TEST(AFrameGateWithTwoJointsInAFrame, TakesAZeroBesideAMotionForTheEndOfThatRamp) {
  FrameGate gate;
  const FakePair drive;
  gate.add(0, drive);
  const Slowing slowing[] = {{true, 20}, {true, 20}};
  const auto slow = [&](int left, int right) {
    return gate.admit(0, both(left, right), drive, {0, false, slowing}, Time{});
  };
  EXPECT_EQ(slow(20, 10), FrameVerdict::pass);
  EXPECT_EQ(slow(15, 0), FrameVerdict::pass);
  EXPECT_EQ(slow(15, 1), kRefusedMotion);
  EXPECT_EQ(slow(10, 0), FrameVerdict::pass);
}

class AFrameGateOfABase : public ::testing::Test {
 protected:
  AFrameGateOfABase() { gate.add(0, base); }
  FrameVerdict slow(int vx, int wz, const Twist& measured) {
    const Slowing slowing[] = {{true, 0, measured}};
    return gate.admit(0, both(vx, wz), base, {0, false, slowing}, Time{});
  }
  FakeBase base;
  FrameGate gate;
};

TEST_F(AFrameGateOfABase, LetsARampOfBothPartsPass) {
  for (const auto& [vx, wz] : {std::pair{20, -10}, {15, -10}, {15, -3}, {0, -3}, {0, 0}})
    EXPECT_EQ(slow(vx, wz, {20, -10}), FrameVerdict::pass) << vx << ' ' << wz;
  EXPECT_EQ(slow(0, -1, {20, -10}), kRefusedMotion) << "it has come to rest";
  gate.end_slowing(base, 0);
  EXPECT_EQ(slow(0, -1, {20, -10}), FrameVerdict::pass);
}
TEST_F(AFrameGateOfABase, RefusesAPartThatGrows) {
  EXPECT_EQ(slow(20, -5, {20, -10}), FrameVerdict::pass);
  EXPECT_EQ(slow(15, -6, {20, -10}), kRefusedMotion);
  EXPECT_EQ(slow(21, -5, {30, -10}), kRefusedMotion);
}
TEST_F(AFrameGateOfABase, RefusesAPartThatTheBaseDoesNotHave) {
  EXPECT_EQ(slow(20, 1, {20, 0}), kRefusedMotion);
  EXPECT_EQ(slow(20, 5, {20, -10}), kRefusedMotion);
  EXPECT_EQ(slow(21, 0, {20, 0}), kRefusedMotion);
  EXPECT_EQ(slow(1, 0, {kAbsent, kAbsent}), kRefusedMotion);
}

TEST(FrameGate, NamesAnIdAsDataSheetsDo) {
  FrameGate gate;
  const FakeDrive one{0x20};
  const FakeDrive other{0x20};
  gate.add(0, one);
  try {
    gate.add(0, other);
    FAIL() << "two drives send the same frame";
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find("0x020"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace drover::engine
