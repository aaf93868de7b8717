// A device with two joints, its twin on the other end of the bus: from silence over the set-up to a
// drive by joint commands and to rest.
#include <gtest/gtest.h>

#include "config/load.h"
#include "drover/registry.h"
#include "gateway/gateway.h"
#include "support/allocation_counter.h"

namespace drover::gateway {
namespace {

using namespace std::chrono_literals;

constexpr auto kRobot = R"({
  "links": {"can0": {"can": "can0"}, "panel": {"gpio": "chip0"}},
  "devices": {
    "wheels": {"driver": "zlac8015d", "link": "can0",
      "joints": {"left": {"channel": "left"}, "right": {"channel": "right"}}},
    "estop": {"driver": "gpio_line", "link": "panel", "line": "a", "is": "estop"}},
  "groups": {"base": {"kind": "differential", "wheel_radius_m": 0.085, "track_m": 0.42,
                      "left": ["left"], "right": ["right"], "hold": "brake"}},
  "guard": {"required": false},
  "mqtt": {"host": "127.0.0.1", "port": 1883}
})";

class Bench {
 public:
  Bench() : gateway(config::load_text(kRobot).config) {
    const DriverEntry& entry = *find_driver("zlac8015d");
    Options options(entry.options);
    for (const OptionSpec& spec : entry.twin_options) options.set(spec.name, spec.default_value);
    twin = std::get<MakeCanTwin>(entry.make_twin)(options);
    gateway.apply({now, LinkUp{0}});
  }
  void cycle() {
    now += 5ms;
    said.clear();
    twin->on_tick(now, shafts, said);
    for (const CanFrame& frame : gateway.output().frames[0]) twin->on_frame(frame, now, said);
    most_frames = std::max(most_frames, gateway.output().frames[0].size());
    for (Shaft& shaft : shafts) {
      shaft.velocity_radps += 0.005 / 0.4 * (shaft.torque_Nm - 0.2 * shaft.velocity_radps);
      shaft.position_rad += 0.005 * shaft.velocity_radps;
    }
    const test::AllocationCounter counter;
    for (const CanFrame& frame : said) gateway.apply({now, FrameHeard{0, frame}});
    LevelsRead released;
    released.link = 1;
    (void)released.levels.push_back(true);
    gateway.apply({now, released});
    gateway.apply({now, Tick{true, false}});
    allocations += counter.count();
  }
  void cycles(int count) {
    for (int i = 0; i < count; ++i) cycle();
  }
  void joints(int count, double left_radps, double right_radps) {
    for (int i = 0; i < count; ++i) {
      JointTargets targets;
      (void)targets.joints.push_back({0, left_radps});
      (void)targets.joints.push_back({1, right_radps});
      gateway.apply({now, CommandGiven{{{RequestId::Source::mqtt, ++requests}, now, targets}}});
      cycle();
    }
  }

  Gateway gateway;
  std::unique_ptr<CanTwin> twin;
  std::array<Shaft, 2> shafts{};
  TwinFrames said;
  Time now{100s};
  std::uint64_t requests = 0;
  std::size_t most_frames = 0;
  std::uint64_t allocations = 0;
};

TEST(TwoHubMotors, AreSetUpDrivenAndBroughtToRestWithoutAnAllocation) {
  Bench bench;
  bench.cycles(300);
  const auto& axes = bench.gateway.snapshot().axes;
  ASSERT_EQ(axes.size(), 2U);
  EXPECT_EQ(axes[0].state, AxisState::idle);
  bench.joints(300, 0, 0);
  EXPECT_EQ(axes[0].state, AxisState::running) << axes[0].fault.view();
  EXPECT_EQ(axes[1].state, AxisState::running) << axes[1].fault.view();
  bench.joints(400, 2, 1);
  // The first way is slow, and the wheels keep their ratio.
  EXPECT_NEAR(bench.shafts[0].velocity_radps, 0.05 / 0.085, 0.02);
  EXPECT_NEAR(bench.shafts[1].velocity_radps, 0.025 / 0.085, 0.02);
  bench.cycles(600);  // the stream is gone
  EXPECT_NEAR(bench.shafts[0].velocity_radps, 0, 0.02);
  EXPECT_NEAR(bench.shafts[1].velocity_radps, 0, 0.02);
  EXPECT_EQ(axes[1].state, AxisState::running) << "it holds";
  bench.twin->set_power(false, bench.now);
  bench.cycles(200);
  bench.twin->set_power(true, bench.now);
  bench.cycles(600);
  EXPECT_EQ(bench.allocations, 0U);
  EXPECT_EQ(bench.gateway.refused(0), 0U);
  EXPECT_EQ(bench.gateway.no_room(0), 0U);
  EXPECT_LE(bench.most_frames, bench.gateway.duties()[0].messages_per_cycle);
}

}  // namespace
}  // namespace drover::gateway
