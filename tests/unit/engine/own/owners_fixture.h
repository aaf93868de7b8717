// A robot that somebody moves, and a stream of joint commands to it.
#pragma once

#include <algorithm>
#include <array>
#include <memory>
#include <string>

#include "../engine_fixture.h"
#include "engine/base/kinematics.h"

namespace drover::engine {

using ::testing::HasSubstr;

class AnOwner : public AnEngine {
 protected:
  /// How often the journal said so.
  std::ptrdiff_t told(const std::string& text) const {
    const auto notices = rig.said<Notice>();
    return std::count_if(notices.begin(), notices.end(),
                         [&](const Notice& notice) { return notice.text == text; });
  }
};

class JointCommands : public AnOwner {
 protected:
  /// One message: the same velocity for all four joints.
  void send(double radps) {
    JointTargets targets;
    for (AxisId id = 0; id < 4; ++id) (void)targets.joints.push_back({id, radps});
    rig.command(targets);
  }
  void send(const std::array<double, 4>& radps) {
    JointTargets targets;
    for (AxisId id = 0; id < 4; ++id) (void)targets.joints.push_back({id, radps[id]});
    rig.command(targets);
  }
  /// What the front wheels are commanded, as a motion of a base whose wheels do not slip.
  Twist commanded() const {
    const double radius_m = rig.config.base.wheel_radius_m;
    return twist_from_wheels(sides_of(rig.config.base), 1.0,
                             rig.out.axes[0].velocity_radps * radius_m,
                             rig.out.axes[1].velocity_radps * radius_m);
  }
  /// A stream at 50 Hz.
  void stream_s(double radps, double seconds) {
    for (int i = 0; i < static_cast<int>(seconds * 50 + 0.5); ++i) {
      send(radps);
      for (int k = 0; k < 4; ++k) rig.tick();
    }
  }
  void drive_by_joints() {
    stream_s(0, 0.5);
    stream_s(2, 2);
    ASSERT_NEAR(rig.out.axes[0].velocity_radps, 2, 1e-9) << reason() << rig.why();
    ASSERT_EQ(rig.snapshot().nav.owner, Owner::joint_command);
  }
  /// Pressed or touched for an instant.
  void tap(Line line) {
    rig.lines[static_cast<std::size_t>(line)] = true;
    rig.tick();
    EXPECT_EQ(rig.fastest_command_radps(), 0);
    rig.lines = {};
    rig.run_s(1);
  }
  void expect_no_joint_moves(const std::string& why) {
    stream_s(0, 1);
    stream_s(2, 1);
    EXPECT_EQ(rig.fastest_command_radps(), 0);
    EXPECT_THAT(reason(), HasSubstr(why));
  }
  /// The gateway died and another one is back, with what was remembered; the stream went on.
  void restart() {
    const Remembered left = rig.out.remembered;
    rig.engine = std::make_unique<Engine>(rig.config);
    rig.engine->recall(left, rig.now);
    for (auto& drive : rig.drives) drive = {};
    rig.tick();
    rig.set_origin();
    stream_s(0, 0.1);
  }
  std::string reason() const { return std::string(rig.snapshot().joint_command.reason.view()); }
};

}  // namespace drover::engine
