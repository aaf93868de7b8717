#include "ros2/cmd_vel.h"

#include <algorithm>

#include "ros2/read_twist.h"
#include "ros2/samples.h"
#include "ros2/writer_names.h"

namespace drover::ros2 {
namespace {

constexpr std::int32_t kAtOnce = 20;

}  // namespace

void CmdVel::hear(const void* sample, const dds_sample_info_t& info, Time now, Duration wall,
                  Time came, TwistsHeard& heard) {
  const auto rival = writers_.rival_of(info.publication_handle, now);
  const auto refuse = [&heard](const std::string& why) {
    heard.twist.reset();
    heard.refused = why;
  };
  if (rival != 0) {
    heard.rivals = true;
    // Whoever was last, in the same words: the journal has a row of them once.
    const auto [first, second] = std::minmax(rival, info.publication_handle);
    return refuse("two programs write it, neither is followed: " + writer_name(reader_, first) +
                  " and " + writer_name(reader_, second));
  }
  const auto late = one_clock_ ? too_late(info, wall, kOldestTwist) : std::string();
  if (!late.empty()) return refuse(late);
  const auto& message =
      stamped_ ? static_cast<const geometry_msgs_msg_dds__TwistStamped_*>(sample)->twist_
               : *static_cast<const geometry_msgs_msg_dds__Twist_*>(sample);
  const auto twist = read_twist(message);
  if (!twist) return refuse(twist.error());
  heard.twist = *twist;
  heard.said = one_clock_ ? said_at(info, now, wall) : came;
  heard.moved = heard.moved || !is_zero(*twist);
}

TwistsHeard CmdVel::take(Time now, Duration wall, Time came) {
  TwistsHeard heard;
  const auto taken = take_samples<kAtOnce>(reader_, [&](const void* sample, const auto& info) {
    hear(sample, info, now, wall, came, heard);
  });
  heard.failed = taken < 0;
  return heard;
}

}  // namespace drover::ros2
