// The straight way that finds the heading.
#include "owners_fixture.h"

namespace drover::engine {
namespace {

class FindingTheHeading : public AnOwner {
 protected:
  void settle_without_heading() {
    rig.no_heading = true;
    rig.settle();
    ASSERT_EQ(rig.snapshot().nav.locate, LocateState::uninit);
  }
  std::string last_notice() const { return std::string(rig.said<Notice>().back().text.view()); }
};

TEST_F(FindingTheHeading, IsRefusedWhenItIsKnown) {
  rig.settle();
  rig.command(FindHeading{});
  rig.run_s(1);
  EXPECT_EQ(rig.fastest_command_radps(), 0);
  EXPECT_THAT(std::string(rig.said<CommandRefused>().back().reason.view()), HasSubstr("known"));
}
/// One antenna, no gyro: a short press of the e-stop, and nobody knows how far it was turned.
TEST_F(FindingTheHeading, BeginsAgainWhenItIsNotKnownWellEnoughAnyMore) {
  settle_without_heading();
  const auto find = [this] {
    const std::size_t refused = rig.said<CommandRefused>().size();
    rig.command(FindHeading{});
    rig.run_s(15);
    EXPECT_EQ(rig.said<CommandRefused>().size(), refused) << rig.why();
    EXPECT_EQ(rig.snapshot().nav.locate, LocateState::good) << rig.why();
  };
  find();
  for (auto& drive : rig.drives) drive.silent = true;
  rig.run_s(0.5);
  for (auto& drive : rig.drives) drive.silent = false;
  rig.run_s(10);
  ASSERT_EQ(rig.snapshot().nav.locate, LocateState::lost) << rig.why();
  EXPECT_THAT(std::string(rig.why()), HasSubstr("drover heading find"));
  find();
}
TEST_F(FindingTheHeading, DrivesNoFartherThanItMay) {
  settle_without_heading();
  rig.quality = FixQuality::none;  // nothing will ever show it
  rig.command(FindHeading{});
  rig.run_s(3);
  EXPECT_EQ(rig.snapshot().nav.owner, Owner::manual);
  EXPECT_GT(rig.fastest_command_radps(), 0);
  rig.run_s(40);
  EXPECT_EQ(rig.fastest_command_radps(), 0);
  EXPECT_THAT(last_notice(), HasSubstr("no heading"));
  EXPECT_LE(rig.plant.truth().x_m, rig.config.navigate.find_heading_distance_m);
  EXPECT_GT(rig.plant.truth().x_m, rig.config.navigate.find_heading_distance_m - 0.2);
}
TEST_F(FindingTheHeading, WaitsForDrivesThatHeldFromBeforeThoughAnEncoderTrembles) {
  settle_without_heading();
  for (auto& drive : rig.drives) drive.state = AxisState::running;
  rig.drives[0].by_itself_radps = 0.05;
  rig.run_s(1);
  rig.command(FindHeading{});
  rig.tick();
  EXPECT_EQ(rig.fastest_command_radps(), 0) << "the drives have yet to hear of it";
  rig.run_s(1);
  EXPECT_EQ(rig.snapshot().nav.owner, Owner::manual) << last_notice();
  EXPECT_GT(rig.fastest_command_radps(), 0);
}
TEST_F(FindingTheHeading, SlowsDownForSomebodyInTheFarZone) {
  EngineConfig config = rig_config();
  config.navigate.find_heading_speed_mps = 0.5;
  rig = EngineRig(config);
  settle_without_heading();
  rig.quality = FixQuality::none;
  rig.command(FindHeading{});
  rig.lines[static_cast<std::size_t>(Line::zone_far)] = true;
  rig.run_s(3);
  EXPECT_NEAR(rig.fastest_command_radps() * rig.config.base.wheel_radius_m,
              rig.config.navigate.far_zone_speed_mps, 1e-6);
}
TEST_F(FindingTheHeading, TellsThatAnOperatorsEmergencyStopEndedIt) {
  settle_without_heading();
  rig.command(FindHeading{});
  rig.run_s(2);
  ASSERT_GT(rig.fastest_command_radps(), 0);
  rig.command(EngageStop{});
  rig.tick();
  EXPECT_EQ(rig.fastest_command_radps(), 0);
  EXPECT_EQ(told("no heading: emergency stop of an operator"), 1);
}
TEST_F(FindingTheHeading, EndsWithACancelAndWithAnEstop) {
  settle_without_heading();
  rig.command(FindHeading{});
  rig.run_s(2);
  rig.command(CancelTask{});
  rig.run_s(1.5);
  EXPECT_EQ(rig.fastest_command_radps(), 0);
  rig.command(FindHeading{});
  rig.run_s(2);
  rig.lines[0] = true;
  rig.tick();
  EXPECT_EQ(rig.fastest_command_radps(), 0);
  rig.lines[0] = false;
  expect_no_motion_for_s(2);
}

}  // namespace
}  // namespace drover::engine
