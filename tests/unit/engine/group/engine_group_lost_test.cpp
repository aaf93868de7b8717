// A joint that was held, and that nobody holds any more, is told of.
#include <gmock/gmock.h>

#include "unit/engine/group/engine_group_fixture.h"

namespace drover::engine {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

class EngineGroupLost : public EngineGroup {
 protected:
  explicit EngineGroupLost(const EngineConfig& config = arm_config()) : EngineGroup(config) {}
  void hold() {
    settle();
    send_s(4, 0.4);
    run_s(1.5);
    ASSERT_EQ(told().state, GroupState::holding);
    ASSERT_EQ(reason(), "");
  }
  /// Before anybody tells it anything else.
  void drop(std::size_t i) {
    arm[i].state = AxisState::idle;
    guards = true;
    tick();
    guards = false;
  }
  std::vector<std::string> errors() {
    std::vector<std::string> texts;
    for (const Notice& notice : rig.said<Notice>())
      if (notice.level == Notice::Level::error &&
          notice.text.view().find("not held") != std::string_view::npos)
        texts.emplace_back(notice.text.view());
    return texts;
  }
};

TEST_F(EngineGroupLost, OutOfClosedLoop) {
  hold();
  drop(0);
  run_s(3);
  EXPECT_LT(arm[0].position_rad, 0);  // it fell
  EXPECT_EQ(reason(), "shoulder: its drive is not in closed loop");
  EXPECT_EQ(told().state, GroupState::holding);  // the elbow
  EXPECT_NEAR(arm[1].position_rad, 0.4, 0.05);
  EXPECT_THAT(errors(),
              ElementsAre("arm: shoulder is not held any more: its drive is not in closed loop"));
  EXPECT_EQ(rig.out.axes[first].request, AxisRequest::rest) << "nothing is armed by itself";
  EXPECT_EQ(rig.why(), "");
  // Whoever begins anew arms it.
  send_s(4, 0.4);
  EXPECT_EQ(told().state, GroupState::following);
  EXPECT_EQ(reason(), "");
  run_s(1.5);
  EXPECT_EQ(reason(), "");
}

TEST_F(EngineGroupLost, ByAFault) {
  hold();
  arm[1].state = AxisState::fault;
  run_s(3);
  EXPECT_EQ(reason(), "elbow: too hot");
  EXPECT_THAT(errors(), ElementsAre("arm: elbow is not held any more: too hot"));
  EXPECT_NEAR(arm[0].position_rad, 0.4, 0.05);
}

/// The text of its fault stays though its stream is long over.
TEST_F(EngineGroupLost, ByAFaultWhileItFollowed) {
  settle();
  send_s(4, 0.4);
  arm[1].state = AxisState::fault;
  run_s(3);
  EXPECT_EQ(reason(), "elbow: too hot");
  EXPECT_THAT(errors(), IsEmpty()) << "it was told as the end of its commands";
}

TEST_F(EngineGroupLost, SilentAndBackIsHeldWhereItIs) {
  hold();
  silent[0] = true;
  run_s(1);
  EXPECT_EQ(errors().size(), 1u);
  EXPECT_THAT(reason(), testing::StartsWith("shoulder: "));
  const double sank = arm[0].position_rad;
  silent[0] = false;
  run_s(2);
  EXPECT_EQ(reason(), "");
  EXPECT_EQ(told().state, GroupState::holding);
  EXPECT_LT(arm[0].position_rad, sank + 0.02);
  EXPECT_EQ(errors().size(), 1u);
}

TEST_F(EngineGroupLost, AfterAStopToo) {
  settle();
  send_s(4, 0.4);
  rig.lines[static_cast<std::size_t>(Line::estop)] = true;
  run_s(1);
  drop(0);  // it cuts the power
  run_s(0.5);
  EXPECT_THAT(errors(),
              ElementsAre("arm: shoulder is not held any more: its drive is not in closed loop"));
  rig.lines[static_cast<std::size_t>(Line::estop)] = false;
  run_s(2);
  EXPECT_EQ(reason(), "shoulder: its drive is not in closed loop");
}

TEST_F(EngineGroupLost, IsNotWhatTheGuardHas) {
  hold();
  rig.guard_has_bus = guards = true;
  run_s(0.5);
  for (ArmJoint& joint : arm) joint.state = AxisState::idle;
  run_s(1);
  EXPECT_THAT(errors(), IsEmpty());
}

class EngineGroupLetGo : public EngineGroupLost {
 protected:
  EngineGroupLetGo() : EngineGroupLost(let_go()) {}
  static EngineConfig let_go() {
    EngineConfig config = arm_config();
    for (JointRules& joint : config.groups[0].joints) joint.on_silence = OnSilence::release;
    return config;
  }
};

TEST_F(EngineGroupLetGo, IsNotLost) {
  settle();
  send_s(4, 0.4);
  run_s(3);
  ASSERT_EQ(arm[0].state, AxisState::idle);
  EXPECT_EQ(reason(), "");
  rig.lines[static_cast<std::size_t>(Line::estop)] = true;
  run_s(1);
  rig.lines[static_cast<std::size_t>(Line::estop)] = false;
  run_s(2);
  EXPECT_EQ(reason(), "");
  EXPECT_THAT(errors(), IsEmpty());
}

}  // namespace
}  // namespace drover::engine
