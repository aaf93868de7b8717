// The first way aside after the start shows a base that goes aside the other way than its wheels
// say: its front and rear wheels are listed the wrong way round, or its rollers mounted so.
#include "engine_rollers.h"

namespace drover::engine {
namespace {

using ::testing::HasSubstr;

class ARobotOnItsFirstWayAside : public ARobotOnRollers {
 protected:
  static EngineConfig unproved() {
    EngineConfig config = on_rollers();
    config.navigate.first_way_m = 0.3;
    return config;
  }
  explicit ARobotOnItsFirstWayAside(double y_m = 0) : ARobotOnRollers(unproved(), y_m) {}
  void go_ahead() {
    rig.settle();
    say_s({}, 0.5);
    say_s({0.3, 0, 0}, 15);
    say_s({}, 2);
    ASSERT_TRUE(rig.out.remembered.mechanics_proved);
    from_m = rig.plant.truth().y_m;
    fastest_mps = 0;
  }
  double aside_m() const { return std::abs(rig.plant.truth().y_m - from_m); }
  std::string cmd_vel() const { return std::string(rig.snapshot().cmd_vel.reason.view()); }
  void expect_no_error() const {
    for (const Notice& notice : rig.said<Notice>())
      EXPECT_NE(notice.level, Notice::Level::error) << notice.text.view();
  }

  double from_m = 0;
};

TEST_F(ARobotOnItsFirstWayAside, StopsCmdVelWhereItGoesTheOtherWayThanItsWheelsSay) {
  rig.mechanics.aside = -1;
  go_ahead();
  say_s({0, 0, -0.3}, 8);
  EXPECT_LT(aside_m(), 0.2);
  EXPECT_GT(rig.plant.truth().y_m, from_m + 0.01);
  EXPECT_EQ(rig.fastest_command_radps(), 0);
  EXPECT_THAT(cmd_vel(), HasSubstr("it goes to the left where its wheels say right"));
  EXPECT_THAT(cmd_vel(), HasSubstr("front wheel first in groups.base.left/right"));
  EXPECT_THAT(cmd_vel(), HasSubstr("X from above?"));
}

TEST_F(ARobotOnItsFirstWayAside, NamesTheOtherSideToo) {
  rig.mechanics.aside = -1;
  go_ahead();
  say_s({0, 0, 0.3}, 8);
  EXPECT_LT(aside_m(), 0.2);
  EXPECT_THAT(cmd_vel(), HasSubstr("it goes to the right where its wheels say left"));
}

TEST_F(ARobotOnItsFirstWayAside, FindsItByPositionsASecondApart) {
  rig.mechanics.aside = -1;
  rig.receiver_ticks = 200;
  go_ahead();
  say_s({0, 0, 0.3}, 10);
  EXPECT_LT(aside_m(), 0.2);
  EXPECT_THAT(cmd_vel(), HasSubstr("it goes to the right where its wheels say left"));
}

TEST_F(ARobotOnItsFirstWayAside, FindsItAslantToo) {
  rig.mechanics.aside = -1;
  go_ahead();
  say_s({0.2, 0, 0.2}, 10);
  EXPECT_LT(aside_m(), 0.2);
  EXPECT_THAT(cmd_vel(), HasSubstr("it goes to the right where its wheels say left"));
}

TEST_F(ARobotOnItsFirstWayAside, StopsAStreamOfJointCommands) {
  rig.mechanics.aside = -1;
  rig.settle();
  const auto stream_s = [&](double radps, double seconds) {
    const double to_left[] = {-radps, radps, radps, -radps};
    for (int i = 0; i < static_cast<int>(seconds * 20 + 0.5); ++i) {
      JointTargets stream;
      for (AxisId id = 0; id < 4; ++id) (void)stream.joints.push_back({id, to_left[id]});
      rig.command(stream);
      rig.run_s(0.05);
    }
  };
  stream_s(0, 0.5);
  stream_s(3.5, 10);
  EXPECT_LT(aside_m(), 0.2);
  EXPECT_EQ(rig.fastest_command_radps(), 0);
  EXPECT_THAT(rig.why() + std::string(rig.snapshot().joint_command.reason.view()),
              HasSubstr("it goes to the right where its wheels say left"));
}

TEST_F(ARobotOnItsFirstWayAside, IsSlowForThirtyCentimetresAndThenAsAsked) {
  go_ahead();
  for (const double left : {1.0, -1.0}) {
    const bool first = left > 0;
    while (aside_m() < 0.28) {
      say_s({0, 0, left * 0.3}, 0.05);
      if (first) {
        ASSERT_LT(fastest_mps, 0.06);
      }
      if (first && aside_m() > 0.05 && aside_m() < 0.25) {
        ASSERT_THAT(cmd_vel(), HasSubstr("slowly: the way aside"));
      }
    }
    say_s({0, 0, left * 0.3}, 3);
    EXPECT_NEAR(fastest_mps, 0.3, 0.02) << cmd_vel();
    EXPECT_EQ(cmd_vel(), "");
    say_s({}, 2);
    from_m = rig.plant.truth().y_m;
  }
  expect_no_error();
}

/// On wet grass, say: that is no mirror.
TEST_F(ARobotOnItsFirstWayAside, DoesNotAccuseRollersThatSlip) {
  rig.mechanics.aside = 0.3;
  go_ahead();
  say_s({0, 0, 0.3}, 12);
  EXPECT_GT(aside_m(), 0.1);
  EXPECT_THAT(cmd_vel(), ::testing::Not(HasSubstr("wheels say")));
}

TEST_F(ARobotOnItsFirstWayAside, TakesAPositionThatJumpsForNoMirror) {
  go_ahead();
  say_s({0, 0, 0.3}, 2.5);
  rig.aside_m = -0.15;
  say_s({0, 0, 0.3}, 10);
  EXPECT_GT(aside_m(), 0.5) << cmd_vel();
  EXPECT_THAT(cmd_vel(), ::testing::Not(HasSubstr("wheels say")));
}

TEST_F(ARobotOnItsFirstWayAside, GoesOnAsAskedWhereNobodyCouldSeeIt) {
  go_ahead();
  rig.quality = FixQuality::rtk_float;
  say_s({0, 0, 0.3}, 12);
  EXPECT_NEAR(fastest_mps, 0.3, 0.02) << cmd_vel();
}

/// A receiver with two antennas is mounted to some degrees: ahead, that is a way aside, too.
TEST_F(ARobotOnItsFirstWayAside, DoesNotAccuseAHeadingThatIsThreeDegreesOff) {
  rig.heading_off_deg = 3;
  go_ahead();
  for (int i = 0; i < 4; ++i) {
    say_s({0.5, 0, i % 2 == 0 ? 0.05 : -0.05}, 5);
    ASSERT_THAT(cmd_vel(), ::testing::Not(HasSubstr("wheels say")));
  }
}

class ATaskBesideItsTrackOnRollers : public ARobotOnItsFirstWayAside {
 protected:
  static constexpr double kBeside_m = 0.06;
  ATaskBesideItsTrackOnRollers() : ARobotOnItsFirstWayAside(kBeside_m) {}
  std::string ended() const {
    const auto ends = rig.said<TaskEnded>();
    return ends.empty() ? "" : std::string(ends[0].reason.view());
  }
  const Path path = straight_path(12);
};

TEST_F(ATaskBesideItsTrackOnRollers, EndsWhereItGoesTheOtherWayThanItsWheelsSay) {
  rig.mechanics.aside = -1;
  rig.settle();
  rig.start(path, 24, 0.5);
  double beside_m = 0;
  for (int i = 0; i < 40 * 200; ++i) {
    rig.tick();
    beside_m = std::max(beside_m, std::abs(rig.plant.truth().y_m));
  }
  EXPECT_LT(beside_m, kBeside_m + 0.2);
  EXPECT_EQ(rig.snapshot().nav.status, NavStatus::error);
  EXPECT_THAT(ended(), HasSubstr("it goes to the left where its wheels say right"));
}

TEST_F(ATaskBesideItsTrackOnRollers, ArrivesWhereItsRollersAreRight) {
  rig.heading_off_deg = 1;
  rig.settle();
  rig.start(path, 24, 0.5);
  rig.run_s(45);
  EXPECT_EQ(rig.snapshot().nav.status, NavStatus::success) << ended();
}

}  // namespace
}  // namespace drover::engine
