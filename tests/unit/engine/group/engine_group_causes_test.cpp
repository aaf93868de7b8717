// What is of all of the robot stops an arm, what is the base's alone does not.
#include <gmock/gmock.h>

#include <functional>

#include "engine/health/causes.h"
#include "unit/engine/group/engine_group_fixture.h"

namespace drover::engine {
namespace {

using ::testing::HasSubstr;

/// What is the matter, by how it comes and goes.
struct Trouble {
  const char* name;
  const char* says;  ///< a part of it
  bool stops_arm = true;
  std::function<void(EngineRig&, bool)> is;
};

void line(EngineRig& rig, Line which, bool active) {
  rig.lines[static_cast<std::size_t>(which)] = active;
}

void charge(EngineRig& rig, double soc_percent) {
  BatterySample sample;
  sample.soc_percent = soc_percent;
  Measurement m;
  m.time = m.received = rig.now;
  m.value = sample;
  rig.engine->on_measurement(m);
}

const Trouble kTroubles[] = {
    {"e-stop", "e-stop pressed", true, [](auto& rig, bool on) { line(rig, Line::estop, on); }},
    {"a lost line", "e-stop", true, [](auto& rig, bool on) { rig.line_lost[0] = on; }},
    {"bumper", "bumper touched", true, [](auto& rig, bool on) { line(rig, Line::bumper, on); }},
    {"the base's own e-stop", "its emergency stop is pressed", true,
     [](auto& rig, bool on) { rig.drives[2].fault = rig.drives[2].stops_all = on; }},
    {"a hit", "the robot was hit", true,
     [](auto& rig, bool on) { rig.gravity_mps2.y = on ? -24 : 0; }},
    {"tilt", "tilted", true,
     [](auto& rig, bool on) {
       const double rad = on ? to_rad(35) : 0;
       rig.gravity_mps2 = {9.81 * std::sin(rad), 0, 9.81 * std::cos(rad)};
     }},
    {"no guard", "the guard", true, [](auto& rig, bool on) { rig.guard_alive = !on; }},
    {"the guard has the bus", "guard", true, [](auto& rig, bool on) { rig.guard_has_bus = on; }},
    {"the program", "a thread hangs", true,
     [](auto& rig, bool on) { rig.environment.program = Reason(on ? "a thread hangs" : ""); }},
    {"an empty battery", "empty", true, [](auto& rig, bool on) { charge(rig, on ? 1 : 70); }},
    {"a low battery", "low", false, [](auto& rig, bool on) { charge(rig, on ? 12 : 70); }},
    {"the near zone", "", false, [](auto& rig, bool on) { line(rig, Line::zone_near, on); }},
    {"the far zone", "", false, [](auto& rig, bool on) { line(rig, Line::zone_far, on); }},
    {"a silent receiver", "", false, [](auto& rig, bool on) { rig.receiver_silent = on; }},
    {"a silent wheel", "", false, [](auto& rig, bool on) { rig.drives[2].silent = on; }},
};

class EngineGroupCauses : public EngineGroup {
 protected:
  EngineGroupCauses() : EngineGroup(with_battery()) {
    rig.imu = true;
    rig.environment.battery[0].state = SourceState::fresh;
    charge(rig, 70);
  }
  static EngineConfig with_battery() {
    EngineConfig config = arm_config();
    config.battery_configured = true;
    config.health.battery_stale_s = 120;
    config.health.battery_hold_s = 0;
    return config;
  }
};

TEST_F(EngineGroupCauses, StopAnArmWhereTheyAreOfAllOfTheRobot) {
  settle();
  for (const Trouble& trouble : kTroubles) {
    run_s(1.2);
    send_s(4, 0.4);
    ASSERT_EQ(told().state, GroupState::following) << "before " << trouble.name << reason();
    const double was = arm[0].position_rad;
    trouble.is(rig, true);
    for (int i = 0; i < 15 && (i == 0 || told().state == GroupState::following); ++i)
      send_s(0.8, 0.4);
    if (trouble.stops_arm) {
      EXPECT_NE(told().state, GroupState::following) << trouble.name;
      EXPECT_EQ(arm[0].state, AxisState::running) << trouble.name;
      EXPECT_NEAR(arm[0].position_rad, was, 0.03) << trouble.name;
      EXPECT_THAT(reason(), HasSubstr(trouble.says)) << trouble.name;
    } else {
      EXPECT_EQ(told().state, GroupState::following) << trouble.name << ": " << reason();
    }
    trouble.is(rig, false);
    send_s(1, 0.4);
    EXPECT_EQ(told().state == GroupState::following, !trouble.stops_arm)
        << "its commands did not pause: " << trouble.name;
  }
}

/// Each cause of the table that is of all is played above, and each that is not may be.
TEST(GroupCauses, AreAllPlayed) {
  const auto of_all =
      std::count_if(kCauses.begin(), kCauses.end(), [](const CauseRow& row) { return row.of_all; });
  const auto played = std::count_if(std::begin(kTroubles), std::end(kTroubles),
                                    [](const Trouble& each) { return each.stops_arm; });
  EXPECT_EQ(of_all, played);
}

// --- two groups -------------------------------------------------------------------------------

/// The elbow is a mast of its own.
class EngineTwoGroups : public EngineGroup {
 protected:
  EngineTwoGroups() : EngineGroup(two_groups()) {}
  static EngineConfig two_groups() {
    EngineConfig config = arm_config();
    GroupConfig mast;
    mast.name = "mast";
    (void)mast.joints.push_back(config.groups[0].joints[1]);
    GroupConfig arm;
    arm.name = "arm";
    (void)arm.joints.push_back(config.groups[0].joints[0]);
    config.groups.clear();
    (void)config.groups.push_back(arm);
    (void)config.groups.push_back(mast);
    return config;
  }
  const GroupSnapshot& mast() const { return rig.snapshot().groups[1]; }
};

TEST_F(EngineTwoGroups, AFaultOfOneLeavesTheOther) {
  settle();
  send_s(4, 0.4);
  ASSERT_EQ(told().state, GroupState::following);
  ASSERT_EQ(mast().state, GroupState::following);
  arm[0].state = AxisState::fault;
  send_s(3, 0.8);
  EXPECT_THAT(reason(), HasSubstr("stopped by shoulder: too hot"));
  EXPECT_NE(told().state, GroupState::following);
  EXPECT_EQ(mast().state, GroupState::following);
  EXPECT_EQ(mast().reason, "");
  EXPECT_NEAR(arm[1].position_rad, 0.8, 0.05);
}

TEST_F(EngineTwoGroups, ASilentDriveOfOneLeavesTheOther) {
  settle();
  send_s(4, 0.4);
  silent[1] = true;
  send_s(3, 0.8);
  EXPECT_THAT(std::string(mast().reason.view()), HasSubstr("elbow"));
  EXPECT_EQ(told().state, GroupState::following);
  EXPECT_NEAR(arm[0].position_rad, 0.8, 0.05);
}

TEST_F(EngineTwoGroups, EachHasItsOwnStream) {
  settle();
  send_s(4, 0.4);
  for (int i = 0; i < 600; ++i) {
    JointTargets targets;
    (void)targets.joints.push_back({static_cast<AxisId>(first), 0, 0.8, 0, 60, 3});
    rig.command(targets);
    tick();
  }
  EXPECT_EQ(told().state, GroupState::following);
  EXPECT_NEAR(arm[0].position_rad, 0.8, 0.05);
  EXPECT_EQ(mast().state, GroupState::holding);
  EXPECT_EQ(mast().owner, GroupOwner::nobody);
  EXPECT_NEAR(arm[1].position_rad, 0.4, 0.05);
}

// --- one of a group ---------------------------------------------------------------------------

TEST_F(EngineGroup, AJointThatIsLeftOutCeasesWhileItsNeighbourFollows) {
  settle();
  send_s(4, 0.4);
  const Time left_out = rig.now;
  const auto send_shoulder = [&](double position_rad) {
    JointTargets targets;
    (void)targets.joints.push_back({static_cast<AxisId>(first), 0, position_rad, 0, 60, 3});
    rig.command(targets);
    tick();
  };
  while (reason().empty()) {
    ASSERT_LT(rig.now - left_out, std::chrono::milliseconds(150));
    send_shoulder(0.8);
  }
  EXPECT_EQ(reason(), "elbow: its commands have ceased");
  EXPECT_GE(rig.now - left_out, std::chrono::milliseconds(95));
  for (int i = 0; i < 600; ++i) send_shoulder(0.8);
  EXPECT_EQ(told().state, GroupState::following);
  EXPECT_EQ(reason(), "");
  EXPECT_NEAR(arm[0].position_rad, 0.8, 0.05);
  EXPECT_NEAR(arm[1].position_rad, 0.4, 0.05);
  send_s(3, 0.8);  // both again
  EXPECT_NEAR(arm[1].position_rad, 0.8, 0.05);
}

}  // namespace
}  // namespace drover::engine
