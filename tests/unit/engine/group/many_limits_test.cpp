// Of a group with many joints that are all asked for too much.
#include <gtest/gtest.h>

#include "engine/group/joint_group.h"

namespace drover::engine {
namespace {

TEST(ManyLimits, AreToldAsFarAsThereIsRoomAndTheOthersCounted) {
  GroupConfig config;
  config.name = "arm";
  std::array<AxisSnapshot, 12> axes;
  for (std::size_t i = 0; i < axes.size(); ++i) {
    JointRules rules;
    rules.axis = static_cast<AxisId>(i);
    (void)config.joints.push_back(rules);
    axes[i].joint.format("joint_%zu", i + 1);
    axes[i].state = AxisState::running;
    axes[i].health = SourceState::fresh;
  }
  JointGroup group(config, std::chrono::seconds(1));
  std::array<AxisCommand, axes.size()> commands{};
  std::array<bool, axes.size()> may_move{};
  EventQueue events;
  const Reason nothing;
  Time now = Time{} + std::chrono::seconds(1);
  for (int i = 0; i < 100; ++i) {
    now += std::chrono::milliseconds(5);
    JointTargets targets;
    for (AxisSnapshot& axis : axes) {
      axis.motion.position_rad = i % 2 * 0.0004;  // a bit of a living encoder
      axis.motion.velocity_radps = 0;
      axis.last_motion = now;
      (void)targets.joints.push_back({static_cast<AxisId>(targets.joints.size()), 0, 99, 0, 20, 1});
    }
    group.take(targets, RequestId::Source::aimrt, now);
    group.step({now, std::chrono::milliseconds(5), axes, std::chrono::milliseconds(100), nothing},
               commands, may_move, events);
  }
  ASSERT_EQ(group.snapshot().state, GroupState::following);
  FixedVector<Event, 8> said;
  events.drain(said);
  ASSERT_EQ(said.size(), 2U) << "that its drives were found running comes first";
  const auto* notice = std::get_if<Notice>(&said[1].body);
  ASSERT_NE(notice, nullptr);
  EXPECT_EQ(notice->text,
            "arm: more was asked than the limits allow: joint_1 (position), joint_2 (position), "
            "joint_3 (position), joint_4 (position), joint_5 (position) and 7 more");
}

}  // namespace
}  // namespace drover::engine
