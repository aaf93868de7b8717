#include "ros2/cmd_vel.h"

#include <array>

#include "ros2/read_twist.h"
#include "ros2/writer_names.h"

namespace drover::ros2 {
namespace {

constexpr std::int32_t kAtOnce = 20;

}  // namespace

void CmdVel::hear(const void* sample, const dds_sample_info_t& info, Time now, Duration wall,
                  TwistsHeard& heard) {
  const auto rival = writers_.rival_of(info.publication_handle, now);
  const auto refuse = [&heard](const std::string& why) {
    heard.twist.reset();
    heard.refused = why;
  };
  if (rival != 0) {
    heard.rivals = true;
    return refuse("two programs write it, neither is followed: " + writer_name(reader_, rival) +
                  " and " + writer_name(reader_, info.publication_handle));
  }
  const Duration age = wall - Duration{info.source_timestamp};
  if (one_clock_ && age > kOldestTwist)
    return refuse("a message came too late: it is " +
                  std::to_string(age / std::chrono::milliseconds(1)) + " ms old");
  const auto& message =
      stamped_ ? static_cast<const geometry_msgs_msg_dds__TwistStamped_*>(sample)->twist_
               : *static_cast<const geometry_msgs_msg_dds__Twist_*>(sample);
  const auto twist = read_twist(message);
  if (!twist) return refuse(twist.error());
  heard.twist = *twist;
  heard.moved = heard.moved || !is_zero(*twist);
}

TwistsHeard CmdVel::take(Time now, Duration wall) {
  TwistsHeard heard;
  std::array<void*, kAtOnce> samples{};
  std::array<dds_sample_info_t, kAtOnce> infos{};
  const auto taken = dds_take(reader_, samples.data(), infos.data(), kAtOnce, kAtOnce);
  for (std::int32_t i = 0; i < taken; ++i)
    if (infos[i].valid_data) hear(samples[i], infos[i], now, wall, heard);
  heard.failed = taken < 0;
  if (taken > 0) dds_return_loan(reader_, samples.data(), taken);
  return heard;
}

}  // namespace drover::ros2
