// What is told of the topics' types to whoever looks for them.
#include "ros2/topics.h"

#include <gtest/gtest.h>

#include <vector>

namespace drover::ros2 {
namespace {

/// Where both sides have it DDS compares the members' names, and newer ROS 2 has others: a pair
/// that matches by the type's name does not then.
TEST(TopicKinds, CarryNoTypeInformation) {
  std::vector<TopicKind> kinds(topic_kinds().begin(), topic_kinds().end());
  for (const auto* kind :
       {&stop_kind(), &cmd_vel_kind(false), &cmd_vel_kind(true), &joint_command_kind(),
        &collision_object_kind(), &planning_constraints_kind()})
    kinds.push_back(*kind);
  for (const TopicKind& kind : kinds) {
    SCOPED_TRACE(kind.type->m_typename);
    EXPECT_EQ(kind.type->m_flagset & DDS_TOPIC_XTYPES_METADATA, 0U) << "idlc without -t";
    EXPECT_EQ(kind.type->type_information.data, nullptr);
    EXPECT_EQ(kind.type->type_information.sz, 0U);
    EXPECT_EQ(kind.type->type_mapping.data, nullptr);
  }
}

}  // namespace
}  // namespace drover::ros2
