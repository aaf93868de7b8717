// Tells the journal of drives of a group that are not heard, or have a fault.
#include "engine/group/joint_notices.h"

namespace drover::engine {
namespace {

constexpr Duration kOneJointAtMostEach = std::chrono::seconds(1);
constexpr Duration kQuietFirst = std::chrono::seconds(1);

}  // namespace

void JointNotices::update(Time now, std::size_t joint, const Name& group, const Name& name,
                          const Reason& trouble, bool said, EventQueue& events) {
  if (begun_ == kNever) begun_ = now;
  if (now - begun_ < kQuietFirst) return;
  Joint& one = joints_[joint];
  const bool holds = !trouble.empty();
  if (holds == one.told) return;
  if (holds && one.told_at != kNever && now - one.told_at < kOneJointAtMostEach) return;
  one.told = holds;
  if (holds) one.told_at = now;
  if (holds && said) return;
  Reason text = group.view();
  text.append(": ");
  text.append(holds ? trouble.view() : name.view());
  if (!holds) text.append(" answers, and has no fault");
  events.notice(now, holds ? Notice::Level::warning : Notice::Level::info, text);
}

}  // namespace drover::engine
