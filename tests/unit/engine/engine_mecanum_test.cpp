// The engine with a base that goes sideways, too.
#include <cmath>

#include "engine_rollers.h"

namespace drover::engine {
namespace {

TEST_F(ARobotOnRollers, FollowsCmdVelToTheSide) {
  rig.settle();
  say_s({}, 0.5);
  say_s({0, 0, 0.3}, 4);
  EXPECT_EQ(rig.snapshot().nav.owner, Owner::cmd_vel) << rig.snapshot().cmd_vel.reason.view();
  EXPECT_NEAR(pose().vy_mps, 0.3, 0.02);
  EXPECT_NEAR(pose().vx_mps, 0, 0.02);
  say_s({}, 2);
  const Pose& truth = rig.plant.truth();
  EXPECT_GT(truth.y_m, 0.8);
  EXPECT_NEAR(truth.x_m, 0, 0.02);
  EXPECT_NEAR(truth.yaw_rad, 0, 0.03);
  EXPECT_NEAR(pose().y_m, truth.y_m, 0.05) << rig.why();
  EXPECT_EQ(rig.why(), "");
  const Odometry& way = rig.snapshot().odometry;
  EXPECT_NEAR(way.y_m, truth.y_m, 0.05);
  EXPECT_GT(way.y_var, way.x_var) << "rollers slip aside";
}

TEST_F(ARobotOnRollers, TakesALongWayToTheSideForNoDriftAndNoShove) {
  rig.settle();
  say_s({}, 0.5);
  for (int i = 0; i < 6; ++i) {
    say_s({0, 0, i % 2 == 0 ? 0.4 : -0.4}, 12);
    ASSERT_EQ(rig.why(), "") << i;
    ASSERT_EQ(rig.snapshot().nav.owner, Owner::cmd_vel) << rig.snapshot().cmd_vel.reason.view();
  }
  EXPECT_NEAR(fastest_mps, 0.4, 0.02);
  EXPECT_NEAR(pose().y_m, rig.plant.truth().y_m, 0.05);
}

TEST_F(ARobotOnRollers, DrivesATaskAsOthersDo) {
  const Path path = straight_path(6);
  rig.settle();
  rig.start(path, 12, 0.5);
  rig.run_s(25);
  EXPECT_EQ(rig.snapshot().nav.status, NavStatus::success) << rig.why();
  EXPECT_NEAR(rig.plant.truth().x_m, 6, 0.15);
}

class ARobotOnRollersBesideItsTrack : public ARobotOnRollers {
 protected:
  static constexpr double kBeside_m = 0.06;
  explicit ARobotOnRollersBesideItsTrack(const EngineConfig& config = on_rollers())
      : ARobotOnRollers(config, kBeside_m) {}
  void drive() {
    rig.settle();
    rig.start(path, 12, 0.5);
    for (int i = 0; i < 25 * 200; ++i) {
      rig.tick();
      turned_rad = std::max(turned_rad, std::abs(rig.plant.truth().yaw_rad));
      aside_mps = std::max(aside_mps, std::abs(rig.plant.truth().vy_mps));
      least_m = std::min(least_m, rig.plant.truth().y_m);
    }
    EXPECT_EQ(rig.snapshot().nav.status, NavStatus::success) << rig.why();
    EXPECT_NEAR(rig.plant.truth().y_m, 0, 0.03);
  }

  const Path path = straight_path(6);
  double turned_rad = 0;
  double aside_mps = 0;
  double least_m = kBeside_m;
};

TEST_F(ARobotOnRollersBesideItsTrack, ComesBackToItAsideInATask) {
  drive();
  EXPECT_GT(aside_mps, 0.03);
  EXPECT_LT(aside_mps, 0.16);
  EXPECT_LT(turned_rad, to_rad(2.5));
  EXPECT_GT(least_m, -0.03);
  for (const Notice& notice : rig.said<Notice>())
    EXPECT_NE(notice.level, Notice::Level::error) << notice.text.view();
}

class ARobotOnRollersBesideItsTrackUnproved : public ARobotOnRollersBesideItsTrack {
 protected:
  static EngineConfig unproved() {
    EngineConfig config = on_rollers();
    config.navigate.first_way_m = 0.3;
    return config;
  }
  ARobotOnRollersBesideItsTrackUnproved() : ARobotOnRollersBesideItsTrack(unproved()) {}
};

TEST_F(ARobotOnRollersBesideItsTrackUnproved, GoesAsideOnlyBehindTheFirstWay) {
  rig.settle();
  rig.start(path, 12, 0.5);
  double early_mps = 0;
  while (rig.plant.truth().x_m < 0.25) {
    rig.tick();
    early_mps = std::max(early_mps, std::abs(rig.plant.truth().vy_mps));
  }
  EXPECT_LT(early_mps, 1e-9);
  for (int i = 0; i < 25 * 200; ++i) {
    rig.tick();
    aside_mps = std::max(aside_mps, std::abs(rig.plant.truth().vy_mps));
  }
  EXPECT_GT(aside_mps, 0.01);
  EXPECT_EQ(rig.snapshot().nav.status, NavStatus::success) << rig.why();
}

TEST_F(ARobotOnRollers, StopsWhereOneOfItsWheelsIsSilent) {
  rig.settle();
  say_s({}, 0.5);
  say_s({0, 0, 0.3}, 3);
  ASSERT_GT(pose().vy_mps, 0.2);
  rig.drives[2].silent = true;
  say_s({0, 0, 0.3}, 0.5);
  EXPECT_EQ(rig.fastest_command_radps(), 0);
  EXPECT_NE(rig.snapshot().nav.owner, Owner::cmd_vel);
}

TEST_F(ARobotOnRollers, GoesAsideNoFasterThanItsLimit) {
  rig.settle();
  say_s({}, 0.5);
  say_s({2, 0, 2}, 5);
  EXPECT_NEAR(std::hypot(pose().vx_mps, pose().vy_mps), rig.config.limits.max_speed_mps, 0.02);
  EXPECT_NEAR(pose().vx_mps, pose().vy_mps, 0.02);
}

class ARobotOnRollersThatDidNotProveThem : public ARobotOnRollers {
 protected:
  static EngineConfig unproved() {
    EngineConfig config = on_rollers();
    config.navigate.first_way_m = 0.3;
    return config;
  }
  ARobotOnRollersThatDidNotProveThem() : ARobotOnRollers(unproved()) {}
};

TEST_F(ARobotOnRollersThatDidNotProveThem, GoesAheadBeforeItGoesAside) {
  rig.settle();
  say_s({}, 0.5);
  say_s({0, 0, 0.3}, 1);
  EXPECT_EQ(fastest_mps, 0) << "it did not move";
  EXPECT_THAT(std::string(rig.snapshot().cmd_vel.reason.view()),
              ::testing::HasSubstr("linear.y is 0.3: this base goes sideways once"));
  say_s({}, 0.5);
  say_s({0.3, 0, 0}, 15);
  say_s({}, 1);
  say_s({0, 0, 0.3}, 12);
  EXPECT_NEAR(pose().vy_mps, 0.3, 0.03) << rig.snapshot().cmd_vel.reason.view();
}

class ARobotOnRollersInAScene : public ARobotOnRollers {
 protected:
  static EngineConfig in_a_scene() {
    EngineConfig config = on_rollers();
    config.clearance_required = true;
    return config;
  }
  ARobotOnRollersInAScene() : ARobotOnRollers(in_a_scene()) {}
};

TEST_F(ARobotOnRollersInAScene, GoesNowhereAsideAsNobodyLooksThere) {
  rig.settle();
  say_s({}, 0.5);
  say_s({0, 0, 0.3}, 1);
  EXPECT_EQ(fastest_mps, 0);
  EXPECT_THAT(std::string(rig.snapshot().cmd_vel.reason.view()),
              ::testing::HasSubstr("nobody looks where it would go sideways"));
}

/// A wall to its left, and somebody who looks to the sides.
class ARobotOnRollersBesideAWall : public ARobotOnRollers {
 protected:
  static constexpr double kWall_m = 1.2;
  static EngineConfig looking_aside() {
    EngineConfig config = on_rollers();
    config.clearance_required = config.clearance_aside = true;
    return config;
  }
  ARobotOnRollersBesideAWall() : ARobotOnRollers(looking_aside()) {}
  void settle() {
    rig.tick();
    rig.set_origin();
    go_s({}, 3);
  }
  void go_s(const Twist& twist, double seconds) {
    for (int i = 0; i < static_cast<int>(seconds * 200 + 0.5); ++i) {
      if (i % 10 == 0) {
        rig.command(FollowTwist{twist});
        look();
      }
      rig.tick();
      const Pose& truth = rig.plant.truth();
      if (std::abs(truth.vy_mps) > 0.05) aslant_mps = std::max(aslant_mps, std::abs(truth.vx_mps));
    }
  }
  void look() {
    Clearance found;
    found.t = rig.now - std::chrono::milliseconds(35);
    found.twist = rig.engine->viewpoint().asked;
    found.ahead_m = found.back_m = found.aside_right_m = 3;
    found.left_rad = found.right_rad = 3;
    found.aside_left_m = std::max(0.0, kWall_m - rig.plant.truth().y_m);
    found.bare.aside_left_m = found.aside_left_m;
    found.first.format("box1 is in the way, %.2f m to the left", found.aside_left_m);
    rig.engine->on_clearance(found);
  }
  std::string cmd_vel() const { return std::string(rig.snapshot().cmd_vel.reason.view()); }

  double aslant_mps = 0;  ///< ahead, while it went aside
};

TEST_F(ARobotOnRollersBesideAWall, StopsBeforeItAndMayLeaveIt) {
  settle();
  go_s({0, 0, 0.4}, 10);
  const double stands_m = rig.plant.truth().y_m;
  EXPECT_GT(stands_m, 0.8) << cmd_vel();
  EXPECT_LT(stands_m, kWall_m);
  EXPECT_EQ(rig.fastest_command_radps(), 0);
  std::string told;
  for (const Notice& notice : rig.said<Notice>()) told += std::string(notice.text.view()) + "\n";
  EXPECT_THAT(told, ::testing::HasSubstr("box1 is in the way"));
  go_s({}, 1);
  go_s({0, 0, -0.4}, 3);
  EXPECT_LT(rig.plant.truth().y_m, stands_m - 0.5) << cmd_vel();
}

TEST_F(ARobotOnRollersBesideAWall, GoesAsideAloneOrAheadAlone) {
  settle();
  go_s({0.3, 0, 0.2}, 1);
  EXPECT_EQ(rig.fastest_command_radps(), 0);
  EXPECT_THAT(cmd_vel(), ::testing::HasSubstr("aslant"));
  go_s({}, 0.5);
  go_s({0.4, 0, 0}, 3);
  EXPECT_GT(rig.plant.truth().vx_mps, 0.3) << cmd_vel();
  go_s({0, 0, -0.3}, 4);
  EXPECT_NEAR(rig.plant.truth().vy_mps, -0.3, 0.03) << cmd_vel();
  go_s({0.4, 0, 0}, 3);
  EXPECT_GT(rig.plant.truth().vx_mps, 0.3) << cmd_vel();
  EXPECT_LT(aslant_mps, 0.05) << "one ends before the other begins";
}

class ARobotWithoutRollers : public ARobotOnRollers {
 protected:
  ARobotWithoutRollers() : ARobotOnRollers(rig_config()) {}
};

TEST_F(ARobotWithoutRollers, RefusesAWayToTheSide) {
  rig.settle();
  say_s({}, 0.5);
  say_s({0.2, 0, 0.3}, 1);
  EXPECT_EQ(rig.fastest_command_radps(), 0);
  EXPECT_THAT(std::string(rig.snapshot().cmd_vel.reason.view()),
              ::testing::HasSubstr("linear.y is 0.3: this base cannot go sideways"));
}

}  // namespace
}  // namespace drover::engine
