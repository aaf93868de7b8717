// A gateway with a base and joints beside it, each behind its own twin.
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "config/load.h"
#include "drover/registry.h"
#include "gateway/gateway.h"
#include "support/allocation_counter.h"

namespace drover::gateway {

/// The base is on can0, DAMIAO motors of the ids 1, 2, ... on can1, of which the first turns the
/// joint `elbow`, and the e-stop on the only chip. Without a driver's name the base has no twin:
/// nobody hears it.
class ArmBench {
 public:
  ArmBench(const char* text, AxisId elbow, const char* base_driver = nullptr,
           std::size_t motors = 1)
      : gateway(config::load_text(text).config), shafts(motors), elbow_(elbow) {
    Options options = options_of("damiao");
    options.set("model", std::string("DM4310"));
    for (std::size_t i = 0; i < motors; ++i) {
      options.set("id", static_cast<double>(i + 1));
      twins.push_back(std::get<MakeCanTwin>(find_driver("damiao")->make_twin)(options));
    }
    if (base_driver != nullptr)
      base = std::get<MakeCanTwin>(find_driver(base_driver)->make_twin)(options_of(base_driver));
    for (const LinkId link : {LinkId{0}, LinkId{1}}) gateway.apply({now, LinkUp{link}});
  }
  const FixedVector<CanFrame, 128>& to_base() const { return gateway.output().frames[0]; }
  const FixedVector<CanFrame, 128>& to_arm() const { return gateway.output().frames[1]; }
  void cycle() {
    now += std::chrono::milliseconds(5);
    said.clear();
    base_said.clear();
    for (std::size_t i = 0; i < twins.size(); ++i) {
      twins[i]->on_tick(now, {&shafts[i], 1}, said);
      for (const CanFrame& frame : to_arm()) twins[i]->on_frame(frame, now, said);
    }
    if (base != nullptr) {
      base->on_tick(now, base_shafts, base_said);
      for (const CanFrame& frame : to_base()) base->on_frame(frame, now, base_said);
    }
    for (Shaft& joint : shafts) turn(joint, 0.05, 0.5);
    for (Shaft& wheel : base_shafts) turn(wheel, 0.4, 0.2);
    const test::AllocationCounter counter;
    for (const CanFrame& frame : said) gateway.apply({now, FrameHeard{1, frame}});
    for (const CanFrame& frame : base_said) gateway.apply({now, FrameHeard{0, frame}});
    LevelsRead lines;
    lines.link = 2;
    (void)lines.levels.push_back(!estop);
    gateway.apply({now, lines});
    gateway.apply(
        {now, Tick{true, guard_has_bus, guard_latched, guard_refuses_set, guard_has_all}});
    allocations += counter.count();
  }
  void cycles(int count) {
    for (int i = 0; i < count; ++i) cycle();
  }
  void command(const decltype(Command::body)& body) {
    gateway.apply({now, CommandGiven{{{RequestId::Source::aimrt, ++requests}, now, body}}});
  }
  void follow(int count, double position_rad) {
    for (int i = 0; i < count; ++i) {
      JointTargets targets;
      (void)targets.joints.push_back({elbow_, 0, position_rad, 0, 40, 1});
      command(targets);
      cycle();
    }
  }
  const GroupSnapshot& arm() const { return gateway.snapshot().groups[0]; }

  Gateway gateway;
  std::vector<std::unique_ptr<CanTwin>> twins;
  std::unique_ptr<CanTwin> base;
  std::vector<Shaft> shafts;
  std::array<Shaft, 2> base_shafts;
  TwinFrames said;
  TwinFrames base_said;
  Time now{std::chrono::seconds(100)};
  bool estop = false;
  bool guard_has_bus = false;
  bool guard_latched = false;
  bool guard_refuses_set = false;
  bool guard_has_all = false;
  std::uint64_t requests = 0;
  std::uint64_t allocations = 0;

 private:
  static Options options_of(const char* driver) {
    const DriverEntry& entry = *find_driver(driver);
    Options options(entry.options);
    for (const OptionSpec& spec : entry.twin_options) options.set(spec.name, spec.default_value);
    return options;
  }
  static void turn(Shaft& shaft, double inertia_kgm2, double friction) {
    shaft.velocity_radps +=
        0.005 / inertia_kgm2 * (shaft.torque_Nm - friction * shaft.velocity_radps);
    shaft.position_rad += 0.005 * shaft.velocity_radps;
  }

  AxisId elbow_;
};

}  // namespace drover::gateway
