// A base that takes a twist, through drivers, engine and gates: bytes in, packets out.
#include "gateway/gateway.h"

#include <gmock/gmock.h>

#include <deque>

#include "crawler_robot.h"
#include "json/located_json.h"
#include "publish/aimrt/messages.h"
#include "publish/rtk_navigation/base_status.h"
#include "publish/status/status.h"
#include "support/crawler.h"
#include "unit/gateway/recorded_run.h"

namespace drover::gateway {
namespace {

using namespace std::chrono_literals;
using test::crawler_with;
using ::testing::HasSubstr;

/// The chassis does what the packets say, without delay.
class Bench {
 public:
  explicit Bench(std::string_view text = test::kCrawlerRobot)
      : gateway(config::load_text(text).config) {
    apply(LinkUp{0});
    run(20);
  }
  void apply(const InputBody& body) { gateway.apply({now, body}); }
  void cycle() {
    now += 5ms;
    if (talks) {
      const Packet packet = test::crawler::packet(state, twist);
      apply(BytesHeard{0, {packet.data(), packet.size()}});
    }
    LevelsRead released;
    released.link = 2;
    (void)released.levels.push_back(true);
    apply(released);
    apply(Tick{true, guard_holds});
    sent.clear();
    const auto& bytes = gateway.output().streams.at(0).bytes;
    for (std::size_t i = 0; i + test::crawler::kSize <= bytes.size(); i += test::crawler::kSize)
      if (const auto said = test::crawler::read({bytes.data() + i, test::crawler::kSize}))
        sent.push_back(*said);
    if (obeys && !sent.empty() && sent.back().what == test::crawler::kDrive)
      twist = sent.back().twist;
  }
  void run(int cycles) {
    for (int i = 0; i < cycles; ++i) cycle();
  }
  void command(const decltype(Command::body)& body) {
    apply(CommandGiven{{.id = {}, .received = now, .body = body}});
  }
  std::string why() const {
    return gateway.snapshot().why.empty() ? "" : std::string(gateway.snapshot().why[0].view());
  }

  Time now{100s};
  Gateway gateway;
  std::vector<test::crawler::Said> sent;
  std::uint8_t state = test::crawler::kRuns;
  Twist twist;
  bool talks = true;
  bool obeys = true;
  bool guard_holds = false;
};

TEST(ATwistBaseAtTheGateway, IsToldToRestEachCycle) {
  Bench bench;
  ASSERT_EQ(bench.sent.size(), 1U);
  EXPECT_EQ(bench.sent[0].what, test::crawler::kDrive);
  EXPECT_EQ(bench.sent[0].twist.vx_mps, 0);
  EXPECT_EQ(bench.gateway.refused(0), 0U);
}

TEST(ATwistBaseAtTheGateway, IsSeenWithoutAJoint) {
  Bench bench;
  const Snapshot& robot = bench.gateway.snapshot();
  EXPECT_TRUE(robot.axes.empty());
  EXPECT_TRUE(robot.base.configured);
  EXPECT_EQ(robot.base.state, AxisState::running);
  EXPECT_EQ(robot.base.health, SourceState::fresh);
  EXPECT_GT(robot.base.source.samples, 10U);
  bench.obeys = false;
  bench.twist = {0.25, -0.5};
  bench.run(1);
  EXPECT_EQ(robot.base.measured.vx_mps, 0.25);
  EXPECT_EQ(robot.base.measured.wz_radps, -0.5);
}

TEST(ATwistBaseAtTheGateway, IsNamedAsTheBaseWhenItIsSilent) {
  Bench bench;
  EXPECT_THAT(bench.why(), ::testing::Not(HasSubstr("the base")));
  bench.talks = false;
  bench.run(60);
  EXPECT_EQ(bench.why(), "the base: the crawler is silent");
  bench.talks = true;
  bench.state = test::crawler::kFault;
  bench.run(2);
  EXPECT_EQ(bench.why(), "the base: a stone in the track");
}

TEST(ATwistBaseAtTheGateway, IsBroughtToRestFromARollBothPartsFalling) {
  Bench bench;
  bench.state = test::crawler::kIsIdle;
  bench.obeys = false;
  bench.twist = {0.8, 0.4};
  bench.run(200);
  bench.command(ArmHold{});
  std::vector<Twist> ramp;
  for (int i = 0; i < 400; ++i) {
    bench.run(1);
    for (const auto& said : bench.sent)
      if (said.twist.vx_mps != 0 || said.twist.wz_radps != 0) ramp.push_back(said.twist);
    if (i == 10) {
      bench.state = test::crawler::kRuns;
      bench.obeys = true;
    }
  }
  ASSERT_GT(ramp.size(), 20U);
  EXPECT_NEAR(ramp.front().vx_mps, 0.8, 0.002);
  EXPECT_NEAR(ramp.front().wz_radps, 0.4, 0.002);
  for (std::size_t i = 1; i < ramp.size(); ++i) {
    EXPECT_LE(ramp[i].vx_mps, ramp[i - 1].vx_mps);
    EXPECT_LE(ramp[i].wz_radps, ramp[i - 1].wz_radps);
    EXPECT_GE(ramp[i].vx_mps, 0);
    EXPECT_GE(ramp[i].wz_radps, 0);
  }
  EXPECT_EQ(bench.twist.vx_mps, 0);
  EXPECT_EQ(bench.twist.wz_radps, 0);
  EXPECT_EQ(bench.gateway.refused(0), 0U);
}

TEST(ATwistBaseAtTheGateway, IsMovedByNoJointCommand) {
  Bench bench;
  JointTargets targets;
  (void)targets.joints.push_back({0, 0.0});
  for (int i = 0; i < 100; ++i) {
    bench.command(targets);
    bench.run(1);
  }
  targets.joints[0].velocity_radps = 0.5;
  bench.command(targets);
  bench.run(10);
  EXPECT_EQ(bench.sent.back().twist.vx_mps, 0);
  EXPECT_EQ(bench.gateway.snapshot().nav.owner, Owner::nobody);
  EXPECT_EQ(bench.gateway.snapshot().joint_command.reason,
            "this robot has no joints: its base takes a twist");
}

TEST(ATwistBaseAtTheGateway, HandsTheGuardItsPacketsAndTellsWhatGoesOn) {
  Bench bench;
  const auto duties = bench.gateway.duties();
  ASSERT_EQ(duties[0].stops.size(), 1U);
  EXPECT_EQ(duties[0].stops[0].recipe.rounds[0].packets.size(), 1U);
  EXPECT_TRUE(bench.gateway.output().streams[0].moves);
  EXPECT_TRUE(bench.gateway.cautions().empty());
  const Gateway careless(
      config::load_text(crawler_with(R"("link": "chassis"})",
                                     R"("link": "chassis", "options": {"stops": false},
                                "accept": ["no_watchdog"]})"))
          .config);
  ASSERT_EQ(careless.cautions().size(), 1U);
  EXPECT_EQ(careless.cautions()[0], "the base, chassis goes on for ever as it was told last");
}

TEST(ATwistBaseAtTheGateway, IsToldNothingWhileTheGuardHasItsLine) {
  Bench bench;
  bench.guard_holds = true;
  for (int i = 0; i < 20; ++i) {
    bench.run(1);
    EXPECT_TRUE(bench.gateway.output().streams[0].bytes.empty()) << "not even to rest";
  }
  bench.guard_holds = false;
  bench.run(1);
  EXPECT_EQ(bench.sent.size(), 1U);
}

TEST(ATwistBaseInTheStatus, StandsInPlaceOfAxes) {
  Bench bench;
  const auto text = publish::status_json(bench.gateway.snapshot(), {});
  const auto status = json::parse(text);
  ASSERT_TRUE(status) << text;
  EXPECT_TRUE(status->root.find("axes")->list()->empty());
  const auto* base = status->root.find("base");
  EXPECT_EQ(*base->find("state")->text(), "running");
  EXPECT_EQ(*base->find("health")->text(), "fresh");
}

TEST(ATwistBaseAtTheGateway, IsReplayedToTheLastOfManyBytes) {
  const auto loaded = config::load_text(test::kCrawlerRobot);
  Gateway gateway(loaded.config);
  PlantedRecording recording(loaded, gateway, bytes_of(200));
  Time now{100s};
  const auto apply = [&](const InputBody& body) {
    recording.input({now, body});
    gateway.apply({now, body});
  };
  apply(LinkUp{0});
  for (int cycle = 0; cycle < 10; ++cycle) {
    now += 5ms;
    const Packet greets = test::crawler::packet(test::crawler::kGreets);
    for (int i = 0; i < 30; ++i) apply(BytesHeard{0, {greets.data(), greets.size()}});
    apply(Tick{true, false});
    recording.output(gateway);
  }
  recording.end();
  expect_found_only_in(recording, "bytes for chassis[");
}

}  // namespace
}  // namespace drover::gateway
