// The table of causes, row by row: each is provoked, and does what its row says and no more.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

#include "engine/health/causes.h"
#include "engine_rig.h"

namespace drover::engine {
namespace {

struct Provoked {
  const char* name;
  Cause cause;
  void (*begin)(EngineRig&);
  void (*end)(EngineRig&);
};

bool& line(EngineRig& rig, Line which) {
  return rig.lines[static_cast<std::size_t>(which)];
}

const Provoked kProvoked[] = {
    {"estop", Cause::estop, [](EngineRig& rig) { line(rig, Line::estop) = true; },
     [](EngineRig& rig) { line(rig, Line::estop) = false; }},
    {"line_lost", Cause::line_lost, [](EngineRig& rig) { rig.line_lost[1] = true; },
     [](EngineRig& rig) { rig.line_lost[1] = false; }},
    {"guard_has_bus", Cause::guard_has_bus, [](EngineRig& rig) { rig.guard_has_bus = true; },
     [](EngineRig& rig) { rig.guard_has_bus = false; }},
    {"bumper", Cause::bumper, [](EngineRig& rig) { line(rig, Line::bumper) = true; },
     [](EngineRig& rig) { line(rig, Line::bumper) = false; }},
    {"base_stop", Cause::base_stop,
     [](EngineRig& rig) { rig.drives[0].fault = rig.drives[0].stops_all = true; },
     [](EngineRig& rig) { rig.drives[0].fault = rig.drives[0].stops_all = false; }},
    {"drive_silent", Cause::drive_silent, [](EngineRig& rig) { rig.drives[0].silent = true; },
     [](EngineRig& rig) { rig.drives[0].silent = false; }},
    {"guard_silent", Cause::guard_silent, [](EngineRig& rig) { rig.guard_alive = false; },
     [](EngineRig& rig) { rig.guard_alive = true; }},
    {"program", Cause::program,
     [](EngineRig& rig) { rig.environment.program = "the storage hangs"; },
     [](EngineRig& rig) { rig.environment.program = Reason(); }},
    {"foreign", Cause::foreign,
     [](EngineRig& rig) { rig.environment.foreign = "somebody else commands them"; },
     [](EngineRig& rig) { rig.environment.foreign = Reason(); }},
    {"bus", Cause::bus, [](EngineRig& rig) { rig.environment.bus = "can0: error passive"; },
     [](EngineRig& rig) { rig.environment.bus = Reason(); }},
    {"far_zone", Cause::far_zone, [](EngineRig& rig) { line(rig, Line::zone_far) = true; },
     [](EngineRig& rig) { line(rig, Line::zone_far) = false; }},
};

/// What these do is not of their rows alone: their own tests show it.
const std::set<Cause> kShownElsewhere = {
    Cause::hit,               // engine_stops_test
    Cause::tilt,              // engine_slope_test
    Cause::drive_fault,       // own/arming_test: a start clears it
    Cause::latched,           // latch_test
    Cause::steep,             // engine_slope_test
    Cause::charger,           // engine_battery_test
    Cause::charger_unknown,   // engine_battery_test
    Cause::near_zone,         // engine_test: a task waits
    Cause::surroundings,      // engine_clearance_test
    Cause::constraint,        // engine_constraint_test
    Cause::moved,             // engine_moved_test
    Cause::origin,            // engine_test
    Cause::imu,               // health_test
    Cause::spare,             // engine_spare_test
    Cause::locate,            // engine_test
    Cause::jumped,            // engine_place_test
    Cause::sensors,           // engine_accept_test
    Cause::receiver,          // engine_test: the place is good for a while
    Cause::battery_critical,  // engine_battery_test
    Cause::battery_low,       // engine_battery_test
    Cause::battery_warning,   // battery_test
    Cause::battery_silent,    // engine_battery_test
};

class ACause : public testing::TestWithParam<Provoked> {
 protected:
  ACause() { rig.settle(); }
  const CauseRow& row() const { return kCauses[static_cast<std::size_t>(GetParam().cause)]; }
  void begin() { GetParam().begin(rig); }
  void end() { GetParam().end(rig); }
  void drive_task() {
    rig.start(path, 80, 0.5);
    rig.run_s(4);
    ASSERT_EQ(rig.snapshot().nav.status, NavStatus::run) << rig.why();
    ASSERT_GT(rig.fastest_command_radps(), 2);
  }
  void stream_s(double radps, double seconds) {
    for (int i = 0; i < static_cast<int>(seconds * 50 + 0.5); ++i) {
      JointTargets targets;
      for (AxisId id = 0; id < 4; ++id) (void)targets.joints.push_back({id, radps});
      rig.command(targets);
      for (int k = 0; k < 4; ++k) rig.tick();
    }
  }
  bool is_stopped_at_once() {
    rig.tick();
    rig.tick();
    return rig.fastest_command_radps() == 0;
  }

  Path path = straight_path(40);
  EngineRig rig;
};

TEST_P(ACause, StopsATaskAtOnceOrEndsItOrLeavesItAlone) {
  drive_task();
  begin();
  EXPECT_EQ(is_stopped_at_once(), row().stops) << rig.why();
  rig.run_s(4);
  const bool ends = row().stops || row().ends_task;
  EXPECT_EQ(rig.snapshot().nav.status == NavStatus::run, !ends) << rig.why();
  EXPECT_EQ(rig.fastest_command_radps() == 0, ends);
}

TEST_P(ACause, RefusesAStartWhileItHolds) {
  begin();
  rig.run_s(1);
  rig.start(path, 80, 0.5);
  rig.run_s(3);
  const bool refuses = row().stops || row().ends_task || row().refuses_task;
  EXPECT_EQ(rig.snapshot().nav.status == NavStatus::run, !refuses) << rig.why();
}

/// What stops them latches; what ends them with a ramp does not: they begin anew, with zeros.
TEST_P(ACause, EndsJointCommandsWhichWaitForAPersonAfterAStop) {
  stream_s(0, 0.5);
  stream_s(2, 2);
  ASSERT_GT(rig.fastest_command_radps(), 1.9) << rig.why();
  begin();
  stream_s(2, 4);
  const bool ends = row().stops || row().ends_task || row().ends_free_driving;
  EXPECT_EQ(rig.fastest_command_radps() == 0, ends) << rig.why();
  end();
  rig.run_s(2);
  stream_s(0, 1);
  stream_s(2, 2);
  EXPECT_EQ(rig.fastest_command_radps() == 0, row().stops) << rig.why();
  rig.command(ResetStop{});
  rig.run_s(2);
  stream_s(0, 1);
  stream_s(2, 2);
  EXPECT_GT(rig.fastest_command_radps(), 1.9) << rig.why();
}

/// Where a person at the robot stopped a task, joint commands wait for one, too.
TEST_P(ACause, KeepsJointCommandsBackAfterATaskWherePeopleEndedIt) {
  if (!row().stops && !row().ends_task) return;
  drive_task();
  begin();
  rig.run_s(4);
  end();
  rig.run_s(2);
  stream_s(0, 1);
  stream_s(2, 2);
  EXPECT_EQ(rig.fastest_command_radps() == 0, row().by_people) << rig.why();
}

TEST_P(ACause, IsSaidToBeOver) {
  begin();
  rig.run_s(2);
  end();
  rig.run_s(2);
  const auto notices = rig.said<Notice>();
  EXPECT_TRUE(std::any_of(notices.begin(), notices.end(), [this](const Notice& said) {
    return said.text == row().over;
  })) << row().over;
}

INSTANTIATE_TEST_SUITE_P(OfTheTable, ACause, testing::ValuesIn(kProvoked),
                         [](const auto& it) { return std::string(it.param.name); });

TEST(TheTableOfCauses, IsWalkedWhole) {
  std::set<Cause> shown = kShownElsewhere;
  for (const Provoked& provoked : kProvoked)
    EXPECT_TRUE(shown.insert(provoked.cause).second) << provoked.name << " stands twice";
  EXPECT_EQ(shown.size(), kCauseCount) << "a new row: provoke it here";
}

}  // namespace
}  // namespace drover::engine
