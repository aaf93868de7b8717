// What a group says of itself: what it waits for, what hinders it, and who holds it no more.
#include <gmock/gmock.h>

#include "unit/engine/group/engine_group_fixture.h"

namespace drover::engine {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr const char* kPause = "pause your commands for a second, then send again";

class EngineGroupReason : public EngineGroup {
 protected:
  void estop(bool pressed) { rig.lines[static_cast<std::size_t>(Line::estop)] = pressed; }
  /// What the journal has of it.
  std::vector<std::string> told_of(std::string_view what) {
    std::vector<std::string> texts;
    for (const Notice& notice : rig.said<Notice>())
      if (notice.text.view().find(what) != std::string_view::npos)
        texts.emplace_back(notice.text.view());
    return texts;
  }
  void find_running() {
    for (ArmJoint& joint : arm) {
      joint.state = AxisState::running;  // as the guard left it
      joint.found_on = joint.damps_while_arming = true;
      joint.damps_Nmsprad = 5;
      joint.arms_in = 20;
      joint.position_rad = 0.7;
    }
  }
};

// --- after a stop -----------------------------------------------------------------------------

TEST_F(EngineGroupReason, AfterAStopIsThatItsCommandsHaveToPause) {
  settle();
  send_s(4, 0.4);
  estop(true);
  send_s(1, 0.4);
  EXPECT_EQ(reason(), "e-stop pressed") << "as long as it is";
  EXPECT_THAT(told_of(kPause), IsEmpty());
  estop(false);
  send_s(4, 0.4);
  EXPECT_EQ(told().state, GroupState::holding);
  EXPECT_EQ(reason(), std::string(kPause) + ": it was stopped by e-stop pressed");
  EXPECT_THAT(told_of(kPause), ElementsAre(std::string("arm: ") + kPause + ": it was stopped"));
  run_s(1.2);
  EXPECT_EQ(reason(), "");
  send_s(1, 0.4);
  EXPECT_EQ(told().state, GroupState::following);
  EXPECT_EQ(reason(), "");
  EXPECT_EQ(told_of(kPause).size(), 1U);
}

/// He paused, but not for long enough.
TEST_F(EngineGroupReason, AfterAStopIsThatForWhoBeginsAnewTooSoonToo) {
  settle();
  send_s(4, 0.4);
  estop(true);
  run_s(0.5);
  estop(false);
  run_s(0.2);
  send_s(3, 0.4);
  EXPECT_EQ(told().state, GroupState::holding);
  EXPECT_THAT(reason(), HasSubstr(kPause));
  EXPECT_EQ(told_of(kPause).size(), 1U);
}

TEST_F(EngineGroupReason, AfterAFaultNamesItsJointWithIt) {
  settle();
  send_s(4, 0.4);
  arm[1].state = AxisState::fault;
  send_s(2, 0.4);
  EXPECT_EQ(reason(), std::string(kPause) + ": it was stopped by elbow: too hot");
}

TEST_F(EngineGroupReason, OfAPauseIsToldOnceForEachStop) {
  settle();
  for (int i = 0; i < 3; ++i) {
    send_s(4, 0.4);
    ASSERT_EQ(told().state, GroupState::following) << reason();
    rig.command(CancelTask{});
    send_s(2, 0.4);
    run_s(1.2);
    EXPECT_EQ(told_of(kPause).size(), static_cast<std::size_t>(i + 1));
  }
}

/// Who ends with the stop has nothing to be told.
TEST_F(EngineGroupReason, IsNoneWhereNobodySends) {
  settle();
  send_s(4, 0.4);
  run_s(2);
  rig.command(CancelTask{});
  run_s(2);
  send_s(1, 0.4);
  EXPECT_EQ(told().state, GroupState::following);
  EXPECT_THAT(told_of(kPause), IsEmpty());
}

// --- who holds it no more ---------------------------------------------------------------------

/// The e-stop cuts its power: that it was pressed tells nobody that it falls.
TEST_F(EngineGroupReason, WhileAStopHoldsTellsWhoIsNotHeldByAnybody) {
  settle();
  send_s(4, 0.4);
  estop(true);
  run_s(0.5);
  ASSERT_EQ(reason(), "e-stop pressed");
  silent = {true, true};
  run_s(1);
  EXPECT_THAT(reason(), testing::StartsWith("shoulder, elbow: not held by anybody: "));
  EXPECT_THAT(reason(), testing::EndsWith("; e-stop pressed"));
  silent = {};
  run_s(1);
  EXPECT_EQ(reason(), "e-stop pressed");
}

// --- one joint commanded, the others left --------------------------------------------------------

class EngineGroupOneOfTwo : public EngineGroupReason {
 protected:
  void send_one_s(double seconds, std::size_t i, int every = 2) {
    for (int n = 0; n < static_cast<int>(seconds * 200 + 0.5); ++n) {
      JointTargets targets;
      (void)targets.joints.push_back({static_cast<AxisId>(first + i), 0, 0.4, 0, 60, 3});
      if (n % every == 0) rig.command(targets, source);
      tick();
    }
  }
};

/// That the other's have ceased refuses nothing of it.
TEST_F(EngineGroupOneOfTwo, CountsNoRefusalWhileItsRowBegins) {
  settle();
  send_one_s(2, 0);
  run_s(0.2);
  ASSERT_EQ(reason(), "shoulder: its commands have ceased");
  send_one_s(0.2, 1);
  EXPECT_EQ(told().refused, 0U) << reason();
  send_one_s(2, 1);
  EXPECT_EQ(told().state, GroupState::following);
  EXPECT_EQ(told().refused, 0U);
}

TEST_F(EngineGroupOneOfTwo, TellsWhyItIsRefusedBeforeWhatTheOtherLeft) {
  settle();
  send_s(4, 0.4);
  run_s(0.2);
  send_one_s(0.7, 1, 30);
  EXPECT_EQ(reason(), "elbow: its commands come 150 ms apart, 100 ms are allowed");
  EXPECT_GE(told().refused, 2U);
}

// --- drives that do not answer, or have a fault -----------------------------------------------

TEST_F(EngineGroupReason, NamesADriveInFaultThoughNobodyCommandsIt) {
  arm[1].state = AxisState::fault;
  settle();
  EXPECT_EQ(told().state, GroupState::idle);
  EXPECT_EQ(reason(), "elbow: too hot");
  EXPECT_THAT(told_of("elbow"), ElementsAre("arm: elbow: too hot"));
  send_s(0.4, 0.4);
  EXPECT_EQ(told().state, GroupState::arming);
  EXPECT_EQ(reason(), "elbow: too hot");
  EXPECT_EQ(told().refused, 0U) << "it clears the fault, if it can";
}

TEST_F(EngineGroupReason, NamesADriveThatDoesNotComeIntoClosedLoopYet) {
  settle();
  arm[1].arms_in = 200;
  send_s(0.5, 0.4);
  EXPECT_EQ(told().state, GroupState::arming);
  EXPECT_EQ(reason(), "elbow: its drive comes into closed loop");
  send_s(4, 0.4);
  EXPECT_EQ(reason(), "");
}

TEST_F(EngineGroupReason, OfASilentDriveStandsInTheJournalToo) {
  silent[1] = true;
  settle();
  ASSERT_THAT(reason(), testing::StartsWith("elbow: "));
  EXPECT_THAT(told_of("elbow"), ElementsAre("arm: " + reason()));
  EXPECT_THAT(told_of("drives of the base answer"), IsEmpty());
  silent[1] = false;
  run_s(2);
  EXPECT_EQ(reason(), "");
  EXPECT_THAT(told_of("elbow"), ElementsAre(testing::_, "arm: elbow answers, and has no fault"));
}

TEST_F(EngineGroupReason, OfADriveThatComesAndGoesIsToldOnceASecondAtMost) {
  settle();
  for (int i = 0; i < 50; ++i) {
    silent[1] = !silent[1];
    run_s(0.1);
  }
  EXPECT_LE(told_of("elbow").size(), 12U);
  EXPECT_GE(told_of("elbow").size(), 4U);
}

/// What is told as an end of its commands, or as an error, is not told again.
TEST_F(EngineGroupReason, OfAFaultIsToldOnce) {
  settle();
  send_s(4, 0.4);
  arm[1].state = AxisState::fault;
  run_s(3);
  EXPECT_THAT(told_of("too hot"), ElementsAre("arm: joint commands ended: elbow: too hot"));
}

// --- what a restart finds ---------------------------------------------------------------------

TEST_F(EngineGroupReason, ThatItWasTakenOverStandsInTheJournal) {
  find_running();
  rig.guard_has_bus = true;
  run_s(0.3);
  EXPECT_THAT(told_of("found running"), IsEmpty()) << "the guard has it";
  rig.guard_has_bus = false;
  settle();
  ASSERT_EQ(told().state, GroupState::holding);
  EXPECT_THAT(told_of("found running"),
              ElementsAre("arm: its drives were found running: held where it is"));
  send_s(4, 0.2);
  run_s(3);
  EXPECT_EQ(told_of("found running").size(), 1U);
}

TEST_F(EngineGroupReason, ThatItWasTakenOverIsNotToldOfWhatWasArmed) {
  settle();
  send_s(4, 0.2);
  run_s(3);
  EXPECT_THAT(told_of("found running"), IsEmpty());
}

// --- released ---------------------------------------------------------------------------------

/// Somebody pushes the base by hand: an arm that moves is a danger to him, one that falls, too.
TEST_F(EngineGroupReason, WhileTheBaseIsReleasedAnArmIsHeldAndFollowsNobody) {
  settle();
  send_s(4, 0.4);
  const double was = arm[0].position_rad;
  rig.command(ReleaseHold{true});
  send_s(3, 1.0);
  EXPECT_EQ(rig.snapshot().hold, HoldState::released);
  EXPECT_EQ(told().state, GroupState::holding);
  EXPECT_EQ(reason(), "the robot is released, to be pushed by hand: drover hold");
  EXPECT_NEAR(arm[0].position_rad, was, 0.03);
  const auto answers = rig.said<CommandAccepted>();
  ASSERT_FALSE(answers.empty());
  EXPECT_EQ(answers.back().note,
            "the drives let go: the robot can be pushed, and can roll; its other joints follow "
            "nobody, what runs is held");
  run_s(1.2);
  send_s(2, 1.0);
  EXPECT_EQ(told().state, GroupState::holding) << "nor who begins anew";
  rig.command(ArmHold{});
  send_s(2, 1.0);
  EXPECT_EQ(told().state, GroupState::holding) << "nor who did not pause";
  EXPECT_THAT(reason(), HasSubstr(kPause));
  run_s(1.2);
  send_s(3, 1.0);
  EXPECT_EQ(told().state, GroupState::following);
  EXPECT_NEAR(arm[0].position_rad, 1.0, 0.05);
}

TEST_F(EngineGroupReason, WhileTheBaseIsReleasedNothingOfAnArmIsArmed) {
  settle();
  rig.command(ReleaseHold{true});
  send_s(2, 1.0);
  EXPECT_EQ(told().state, GroupState::idle);
  for (std::size_t i = 0; i < arm.size(); ++i)
    EXPECT_EQ(rig.out.axes[first + i].request, AxisRequest::rest);
}

}  // namespace
}  // namespace drover::engine
