// How the driver brings a sensor to its settings, and what it never does.
#include <gtest/gtest.h>

#include <set>

#include "unit/drivers/witmotion/rig.h"

namespace drover::witmotion {
namespace {

using namespace std::chrono_literals;

/// Register addresses of what was sent; fails on anything that is no command.
std::vector<int> addresses(const std::vector<std::uint8_t>& sent) {
  std::vector<int> list;
  EXPECT_EQ(sent.size() % 5, 0U);
  for (std::size_t at = 0; at + 5 <= sent.size(); at += 5) {
    EXPECT_EQ(sent[at], 0xFF);
    EXPECT_EQ(sent[at + 1], 0xAA);
    list.push_back(sent[at + 2]);
  }
  return list;
}

std::size_t writes_in(const std::vector<std::uint8_t>& sent) {
  std::size_t count = 0;
  for (const int address : addresses(sent)) count += address == 0x27 ? 0 : 1;
  return count;
}

TEST(WitmotionSetup, OnlyReadsASensorThatIsAsItShouldBe) {
  Rig rig;
  rig.run(60s);
  EXPECT_EQ(writes_in(rig.sent), 0U);
  EXPECT_EQ(rig.sent.size(), 15U);
  EXPECT_EQ(rig.device().saves(), 0);
  EXPECT_TRUE(rig.speeds.empty());
}

TEST(WitmotionSetup, WritesNothingWhenToldSo) {
  Rig rig({{"configure", false}}, {{"factory", true}});
  rig.run(20s);
  EXPECT_TRUE(rig.sent.empty());
  EXPECT_TRUE(rig.speeds.empty());
}

TEST(WitmotionSetup, FindsAFactoryFreshSensorSetsItAndSavesOnceAtTheNewSpeed) {
  Rig rig({}, {{"factory", true}});
  rig.run(12s);
  EXPECT_EQ(rig.state(), SourceState::fresh) << rig.reason();
  EXPECT_EQ(rig.reason(), "");
  EXPECT_EQ(rig.speeds, (std::vector<std::uint32_t>{9600, 115200}));
  const Settings& saved = rig.device().saved();
  EXPECT_EQ(saved.baud, 6);
  EXPECT_EQ(saved.rate, 9);
  EXPECT_EQ(saved.content, kAcceleration | kAngularRate | kAngles);
  EXPECT_EQ(saved.algorithm, 1);
  EXPECT_EQ(saved.bandwidth, 1);
  EXPECT_EQ(rig.device().saves(), 1);
  const auto before = rig.samples;
  rig.run(1s);
  EXPECT_EQ(rig.samples, before + 100);
}

TEST(WitmotionSetup, SendsNothingButTheCommandsOfTheDocument) {
  Rig rig({}, {{"factory", true}});
  for (int i = 0; i < 10; ++i) {
    rig.run(3s);
    (void)rig.twin->set_state(i % 2 == 0 ? "garbage" : "restart", rig.now);
    rig.run(3s);
    (void)rig.twin->set_state("", rig.now);
  }
  const std::set<int> allowed{0x00, 0x02, 0x03, 0x04, 0x1F, 0x24, 0x27, 0x69};
  for (const int address : addresses(rig.sent)) EXPECT_EQ(allowed.count(address), 1U) << address;
  // A save is a save: 1 would forget everything, 255 restart it.
  for (std::size_t at = 0; at + 5 <= rig.sent.size(); at += 5) {
    if (rig.sent[at + 2] == 0) {
      EXPECT_EQ(rig.sent[at + 3] | rig.sent[at + 4], 0);
    }
  }
  EXPECT_EQ(rig.overflows, 0U);
  EXPECT_EQ(rig.allocations, 0U);
}

TEST(WitmotionSetup, SetsASensorAgainThatForgotWithinThreeSeconds) {
  Rig rig;
  rig.run(5s);
  ASSERT_EQ(rig.device().saves(), 0);
  // At the right speed, but with another rate and content than wanted, as after a reset by hand.
  const auto order = [&rig](Register address, std::uint16_t value) {
    rig.twin->on_bytes(write_register(address, value), rig.now);
    rig.run(100ms);
  };
  order(Register::unlock, kUnlock);
  order(Register::content, kAcceleration | kAngularRate);
  order(Register::rate, 6);
  rig.run(3500ms);
  EXPECT_EQ(rig.device().settings().rate, 9);
  EXPECT_EQ(rig.device().settings().content, kAcceleration | kAngularRate | kAngles);
  rig.run(3s);
  EXPECT_EQ(rig.state(), SourceState::fresh) << rig.reason();
  EXPECT_EQ(rig.device().saves(), 1);
}

TEST(WitmotionSetup, IsBackAfterTheCableWasPulled) {
  Rig rig;
  rig.run(5s);
  rig.unplug();
  rig.run(20s);
  EXPECT_EQ(rig.state(), SourceState::stale);
  EXPECT_NE(rig.reason().find("silent"), std::string::npos) << rig.reason();
  EXPECT_TRUE(rig.speeds.empty());
  rig.plug();
  rig.run(200ms);
  EXPECT_EQ(rig.state(), SourceState::fresh) << rig.reason();
  EXPECT_EQ(rig.device().saves(), 0);
}

TEST(WitmotionSetup, WakesASensorWhoseOutputIsSwitchedOff) {
  Rig rig;
  rig.run(5s);
  rig.twin->on_bytes(write_register(Register::unlock, kUnlock), rig.now);
  rig.run(100ms);
  rig.twin->on_bytes(write_register(Register::rate, 0x0D), rig.now);
  rig.run(10s);
  EXPECT_EQ(rig.state(), SourceState::fresh) << rig.reason();
}

/// Bytes of the driver get lost on their way to a sensor that only talks.
struct Deaf final : ImuTwin {
  explicit Deaf(std::unique_ptr<ImuTwin> made) : inner(std::move(made)) {}
  std::size_t on_tick(Time now, const ImuTruth& truth, std::span<char> out) override {
    return inner->on_tick(now, truth, out);
  }
  void on_bytes(std::span<const std::uint8_t>, Time) override {}
  std::uint32_t baud() const override { return inner->baud(); }
  bool set_state(std::string_view name, Time now) override { return inner->set_state(name, now); }
  std::unique_ptr<ImuTwin> inner;
};

TEST(WitmotionSetup, UsesASensorThatAnswersNothing) {
  Rig rig;
  rig.twin = std::make_unique<Deaf>(std::move(rig.twin));
  rig.run(60s);
  EXPECT_EQ(rig.state(), SourceState::fresh);
  EXPECT_EQ(rig.reason(), "");
  EXPECT_EQ(writes_in(rig.sent), 0U);
  EXPECT_NEAR(static_cast<double>(rig.samples), 6000, 10);
}

TEST(WitmotionSetup, SaysThatASensorDoesNotTakeItsSettings) {
  Rig rig({{"stale_s", 0.5}});
  rig.twin->on_bytes(write_register(Register::unlock, kUnlock), rig.now);
  rig.run(100ms);
  rig.twin->on_bytes(write_register(Register::rate, 7), rig.now);
  rig.twin = std::make_unique<Deaf>(std::move(rig.twin));
  rig.run(60s);
  EXPECT_EQ(rig.state(), SourceState::fresh) << rig.reason();
  EXPECT_EQ(rig.reason(), "the inertial sensor does not take its settings");
}

TEST(WitmotionTwin, ObeysOnlyWhenUnlockedAndForgetsWhatWasNotSaved) {
  WitmotionTwin twin(options_with({}), 1);
  Time now{100s};
  const auto order = [&](Register address, std::uint16_t value) {
    now += 100ms;
    twin.on_bytes(write_register(address, value), now);
  };
  order(Register::rate, 6);
  EXPECT_EQ(twin.settings().rate, 9);
  order(Register::unlock, 0x1234);
  order(Register::rate, 6);
  EXPECT_EQ(twin.settings().rate, 9);
  order(Register::unlock, kUnlock);
  order(Register::rate, 6);
  order(Register::baud, 2);
  EXPECT_EQ(twin.settings().rate, 6);
  EXPECT_EQ(twin.baud(), 9600U);
  EXPECT_TRUE(twin.set_state("restart", now));
  EXPECT_EQ(twin.settings().rate, 9);
  EXPECT_EQ(twin.baud(), 115200U);
  order(Register::unlock, kUnlock);
  order(Register::rate, 6);
  order(Register::save, kSave);
  EXPECT_TRUE(twin.set_state("restart", now));
  EXPECT_EQ(twin.settings().rate, 6);
  now += 1s;
  order(Register::unlock, kUnlock);
  now += 11s;
  order(Register::rate, 9);
  EXPECT_EQ(twin.settings().rate, 6);
}

TEST(WitmotionTwin, KnowsNoOtherStates) {
  WitmotionTwin twin(options_with({}), 1);
  for (const char* name : {"silly", "bias", "bias:", "bias:x", "rate:0", "scale:nan"})
    EXPECT_FALSE(twin.set_state(name, Time{1s})) << name;
}

}  // namespace
}  // namespace drover::witmotion
