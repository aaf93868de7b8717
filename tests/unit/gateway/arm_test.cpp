// A base and a joint beside it, each behind its own twin: what one may do opens nothing for the
// other, and what the guard has after a stop from outside is the base alone.
#include <gtest/gtest.h>

#include "config/load.h"
#include "drover/registry.h"
#include "gateway/gateway.h"
#include "support/allocation_counter.h"

namespace drover::gateway {
namespace {

using namespace std::chrono_literals;

constexpr auto kArm = R"({
  "links": {"can0": {"can": "can0"}, "can1": {"can": "can1"}, "panel": {"gpio": "chip0"}},
  "devices": {
    "elbow": {"driver": "damiao", "link": "can1", "options": {"id": 1, "model": "DM4310"}},
    "wheels": {"driver": "zlac8015d", "link": "can0",
      "joints": {"left": {"channel": "left"}, "right": {"channel": "right"}}},
    "estop": {"driver": "gpio_line", "link": "panel", "line": "a", "is": "estop"}},
  "groups": {"base": {"kind": "differential", "wheel_radius_m": 0.085, "track_m": 0.42,
                      "left": ["left"], "right": ["right"], "hold": "brake"},
             "arm": {"joints": {"elbow": {"min_rad": -1, "max_rad": 1, "max_velocity_radps": 1,
                                          "max_effort_Nm": 5, "stiffness_Nmprad": 40}}}},
  "guard": {"required": false},
  "mqtt": {"host": "127.0.0.1", "port": 1883}
})";

constexpr AxisId kElbow = 2;  // behind the wheels, though it is written before them

class ArmBench {
 public:
  ArmBench() : gateway(config::load_text(kArm).config) {
    const DriverEntry& entry = *find_driver("damiao");
    Options options(entry.options);
    for (const OptionSpec& spec : entry.twin_options) options.set(spec.name, spec.default_value);
    options.set("id", 1.0);
    options.set("model", std::string("DM4310"));
    twin = std::get<MakeCanTwin>(entry.make_twin)(options);
    for (const LinkId link : {LinkId{0}, LinkId{1}}) gateway.apply({now, LinkUp{link}});
  }
  const FixedVector<CanFrame, 128>& to_arm() const { return gateway.output().frames[1]; }
  void cycle() {
    now += 5ms;
    said.clear();
    twin->on_tick(now, {&shaft, 1}, said);
    for (const CanFrame& frame : to_arm()) twin->on_frame(frame, now, said);
    shaft.velocity_radps += 0.005 / 0.05 * (shaft.torque_Nm - 0.5 * shaft.velocity_radps);
    shaft.position_rad += 0.005 * shaft.velocity_radps;
    const test::AllocationCounter counter;
    for (const CanFrame& frame : said) gateway.apply({now, FrameHeard{1, frame}});
    LevelsRead released;
    released.link = 2;
    (void)released.levels.push_back(true);
    gateway.apply({now, released});
    gateway.apply({now, Tick{true, guard_has_bus, guard_latched}});
    allocations += counter.count();
  }
  void cycles(int count) {
    for (int i = 0; i < count; ++i) cycle();
  }
  void follow(int count, double position_rad) {
    for (int i = 0; i < count; ++i) {
      JointTargets targets;
      (void)targets.joints.push_back({kElbow, 0, position_rad, 0, 40, 1});
      gateway.apply({now, CommandGiven{{{RequestId::Source::aimrt, ++requests}, now, targets}}});
      cycle();
    }
  }
  const GroupSnapshot& arm() const { return gateway.snapshot().groups[0]; }

  Gateway gateway;
  std::unique_ptr<CanTwin> twin;
  Shaft shaft;
  TwinFrames said;
  Time now{100s};
  bool guard_has_bus = false;
  bool guard_latched = false;
  std::uint64_t requests = 0;
  std::uint64_t allocations = 0;
};

TEST(AnArmAtTheGateway, FollowsWithoutItsBaseAndWithoutAnAllocation) {
  ArmBench bench;
  ASSERT_EQ(bench.gateway.snapshot().axes.size(), 3U);
  EXPECT_EQ(bench.gateway.snapshot().axes[kElbow].joint, "elbow");
  bench.cycles(400);
  EXPECT_EQ(bench.arm().state, GroupState::idle);
  bench.follow(600, 0.5);
  EXPECT_EQ(bench.arm().state, GroupState::following) << bench.arm().reason.view();
  EXPECT_NEAR(bench.shaft.position_rad, 0.5, 0.02);
  EXPECT_EQ(bench.gateway.refused(1), 0U);
  EXPECT_EQ(bench.allocations, 0U);
  for (const CanFrame& frame : bench.gateway.output().frames[0])
    EXPECT_NE(frame.id, 0x201U) << "a target for wheels that nobody moves";
}

TEST(AnArmAtTheGateway, IsHeldByItAfterAStopFromOutsideAndNotWhenTheGuardHasAll) {
  ArmBench bench;
  bench.cycles(400);
  bench.follow(600, 0.5);
  bench.guard_has_bus = bench.guard_latched = true;
  bench.cycles(100);
  EXPECT_EQ(bench.arm().state, GroupState::holding);
  EXPECT_FALSE(bench.to_arm().empty());
  EXPECT_EQ(bench.gateway.refused(1), 0U);
  EXPECT_NEAR(bench.shaft.position_rad, 0.5, 0.02);
  bench.guard_latched = false;  // its heartbeat was late: the guard has every axis
  const auto before = bench.gateway.refused(1);
  bench.cycles(100);
  EXPECT_GT(bench.gateway.refused(1), before);
}

TEST(AnArmAtTheGateway, TellsTheGuardWhatItCannotHold) {
  const ArmBench bench;
  const auto duties = bench.gateway.duties();
  ASSERT_EQ(duties[0].stops.size(), 1U);
  EXPECT_FALSE(duties[0].stops[0].held_by_daemon);
  ASSERT_EQ(duties[1].stops.size(), 1U);
  EXPECT_TRUE(duties[1].stops[0].held_by_daemon);
  EXPECT_EQ(duties[1].stops[0].recipe.ends, StopEnds::damps);
}

}  // namespace
}  // namespace drover::gateway
