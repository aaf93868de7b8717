// The whole engine with an arm of two joints beside its base.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <deque>
#include <string>

#include "unit/engine/engine_rig.h"
#include "unit/engine/group/arm_joint.h"

namespace drover::engine {

inline constexpr std::array kArmNames{"shoulder", "elbow"};

/// The arm's joints come after the wheels.
inline EngineConfig arm_config(EngineConfig config = rig_config()) {
  GroupConfig arm;
  arm.name = "arm";
  for (std::size_t i = 0; i < kArmNames.size(); ++i) {
    JointRules rules;
    rules.axis = static_cast<AxisId>(config.joints.size());
    (void)config.joints.push_back(kArmNames[i]);
    rules.min_rad = -1.5;
    rules.max_rad = 1.5;
    rules.max_effort_Nm = 6;
    rules.stiffness_Nmprad = 60;
    rules.damping_Nmsprad = 3;
    rules.carries_weight = true;
    (void)arm.joints.push_back(rules);
  }
  (void)config.groups.push_back(arm);
  return config;
}

class EngineGroup : public ::testing::Test {
 protected:
  explicit EngineGroup(const EngineConfig& config = arm_config())
      : rig(config), first(config.joints.size() - kArmNames.size()) {
    for (ArmJoint& joint : arm) joint.position_rad = -1.45;  // it hangs
  }

  void tick() {
    const Time told = rig.now + kRigTick;
    for (std::size_t i = 0; i < arm.size(); ++i) {
      const auto axis = static_cast<AxisId>(first + i);
      const AxisCommand told_now = guards ? AxisCommand{} : rig.out.axes[axis];
      if (!deaf) arm[i].obey(late_cycles > 0 ? late(i, told_now) : told_now);
      for (int k = 0; k < 5; ++k) arm[i].step(to_s(kRigTick) / 5);
      rig.environment.axes[axis].state = silent[i] ? SourceState::stale : SourceState::fresh;
      if (silent[i] || mute) continue;
      measure(told, AxisMotion{axis, arm[i].told_rad(), arm[i].told_radps(), arm[i].torque_Nm});
      measure(told, AxisStatus{axis, arm[i].state},
              arm[i].state == AxisState::fault ? "too hot" : "");
    }
    rig.tick();
  }
  /// Of each joint with this stiffness, at 100 Hz.
  void send_s(double seconds, double position_rad, double stiffness = 60) {
    for (int i = 0; i < static_cast<int>(seconds * 200 + 0.5); ++i) {
      if (i % 2 == 0) send(position_rad, stiffness);
      tick();
    }
  }
  void send(double position_rad, double stiffness = 60) {
    JointTargets targets;
    for (std::size_t i = 0; i < arm.size(); ++i)
      (void)targets.joints.push_back(
          {static_cast<AxisId>(first + i), 0, position_rad, 0, stiffness, 3});
    rig.command(targets, source);
  }
  void run_s(double seconds) {
    for (int i = 0; i < static_cast<int>(seconds * 200 + 0.5); ++i) tick();
  }
  /// As the guard, or the program before this one, left them: their drives ask first.
  void find_running(double position_rad) {
    for (ArmJoint& joint : arm) {
      joint.state = AxisState::running;
      joint.found_on = joint.damps_while_arming = true;
      joint.damps_Nmsprad = 5;
      joint.arms_in = 20;
      joint.position_rad = position_rad;
    }
  }
  void settle() {
    tick();
    rig.set_origin();
    run_s(3);
  }
  const GroupSnapshot& told() const { return rig.snapshot().groups[0]; }
  std::string reason() const { return std::string(told().reason.view()); }
  bool may_move(std::size_t i) const { return rig.out.joint_may_move[first + i]; }
  /// So often the journal was told something with these words.
  int said(const char* words) {
    int times = 0;
    for (const Notice& notice : rig.said<Notice>())
      if (notice.text.view().find(words) != std::string_view::npos) ++times;
    return times;
  }

  EngineRig rig;
  const std::size_t first;  ///< of its axes
  std::array<ArmJoint, kArmNames.size()> arm;
  std::array<bool, kArmNames.size()> silent{};
  RequestId::Source source = RequestId::Source::aimrt;  ///< of what is sent
  bool guards = false;                                  ///< the guard commands the drives
  std::size_t late_cycles = 0;                          ///< it reaches the drives so much later
  bool deaf = false;  ///< what the drives are told waits on their line
  bool mute = false;  ///< and so does what they tell, not long enough to be missed

 private:
  AxisCommand late(std::size_t i, const AxisCommand& told_now) {
    underway_[i].push_back(told_now);
    if (underway_[i].size() > late_cycles + 1) underway_[i].pop_front();
    return underway_[i].front();
  }
  template <class Value>
  void measure(Time time, const Value& value, const char* words = "") {
    Measurement m;
    m.time = m.received = time;
    m.value = value;
    rig.engine->on_measurement(m);
    rig.engine->on_words(m, words);
  }

  std::array<std::deque<AxisCommand>, kArmNames.size()> underway_;
};

}  // namespace drover::engine
