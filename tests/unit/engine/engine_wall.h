// An engine in front of a wall, and somebody who looks around for it.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine_rig.h"

namespace drover::engine {

inline EngineConfig looking() {
  EngineConfig config = rig_config();
  config.clearance_required = true;
  return config;
}

/// At the origin, on a track of 6 m along x; the answers come 20 times a second, 35 ms old.
class InFrontOfAWall : public testing::Test {
 protected:
  InFrontOfAWall() {
    path.number = 5;
    tick();
    rig.set_origin();
    run_s(3);
  }
  void tick() {
    if (answers && count++ % 10 == 0) {
      Clearance found;
      found.t = rig.now - std::chrono::milliseconds(35);
      found.path = task_path;
      const Viewpoint& view = rig.engine->viewpoint();
      found.twist = is_zero(view.commanded) ? view.asked : view.commanded;
      const double left_m = std::max(0.0, wall_m - rig.plant.truth().x_m);
      constexpr double kFree = std::numeric_limits<double>::infinity();
      found.ahead_m = std::min({left_m, ahead_m, 3.0});
      found.along_m = wall_m > 6 ? kFree : left_m;  // behind its goal
      found.back_m = 3;
      found.left_rad = found.right_rad = turns ? kFree : 0;
      if (left_m < 3) found.first.format("box1 is in the way, %.2f m ahead", left_m);
      found.broken = broken;
      rig.engine->on_clearance(found);
    }
    rig.tick();
  }
  void turn_wheels(double radps) {
    JointTargets targets;
    for (AxisId id = 0; id < 4; ++id) (void)targets.joints.push_back({id, radps});
    rig.command(targets);
  }
  void stream_s(double radps, double seconds) {
    for (int i = 0; i < static_cast<int>(seconds * 200 + 0.5); ++i) {
      if (i % 4 == 0) turn_wheels(radps);
      tick();
    }
  }
  /// For so long, at that speed and turn.
  void curve_s(double seconds, double vx_mps, double wz_radps) {
    for (int i = 0; i < static_cast<int>(seconds * 200 + 0.5); ++i) {
      if (count % 4 == 0) {
        const JointVelocities radps =
            setpoints(kinematics_of(looking().base), {vx_mps, wz_radps}, Learned{1.0}, 100);
        JointTargets targets;
        for (AxisId id = 0; id < 4; ++id) (void)targets.joints.push_back({id, radps[id]});
        rig.command(targets);
      }
      tick();
    }
  }
  void run_s(double seconds) {
    for (int i = 0; i < static_cast<int>(seconds * 200 + 0.5); ++i) tick();
  }
  void start(double speed_mps = 0.8) {
    task_path = path.number;
    rig.start(path, 12, speed_mps);
  }
  double gap_m() const { return wall_m - rig.plant.truth().x_m; }
  double speed_mps() const { return std::abs(rig.plant.truth().vx_mps); }
  bool told(const char* what) const {
    for (const Reason& why : rig.snapshot().why)
      if (why.view().find(what) != std::string_view::npos) return true;
    return false;
  }

  bool announced(const char* what) const {
    const auto notices = rig.said<Notice>();
    return std::any_of(notices.begin(), notices.end(), [what](const Notice& notice) {
      return notice.text.view().find(what) != std::string_view::npos;
    });
  }

  Path path = straight_path(6);
  EngineRig rig{looking()};
  double ahead_m = 100;  ///< on whatever curve
  double wall_m = 100;   ///< where the footprint with its margin would touch it
  std::uint64_t task_path = 0;
  bool answers = true;
  bool turns = true;  ///< nothing hinders a turn on the spot
  Reason broken;
  int count = 0;
};

}  // namespace drover::engine
