#include "ros2/cmd_vel.h"

#include <array>
#include <cstdio>
#include <memory>

#include "ros2/read_twist.h"

namespace drover::ros2 {
namespace {

constexpr std::int32_t kAtOnce = 20;

}  // namespace

std::string CmdVel::name_of(dds_instance_handle_t writer) const {
  const std::unique_ptr<dds_builtintopic_endpoint_t, void (*)(dds_builtintopic_endpoint_t*)> told(
      dds_get_matched_publication_data(reader_, writer), dds_builtintopic_free_endpoint);
  if (!told) return "one that is gone";
  std::string name;
  for (const auto byte : told->key.v) {
    std::array<char, 4> hex{};
    std::snprintf(hex.data(), hex.size(), "%02x", static_cast<unsigned>(byte));
    name += (name.empty() ? "" : ".") + std::string(hex.data());
  }
  return name;
}

void CmdVel::hear(const void* sample, const dds_sample_info_t& info, Time now, Duration wall,
                  TwistsHeard& heard) {
  const auto rival = writers_.rival_of(info.publication_handle, now);
  const auto refuse = [&heard](const std::string& why) {
    heard.twist.reset();
    heard.refused = why;
  };
  if (rival != 0) {
    heard.rivals = true;
    return refuse("two programs write it, neither is followed: " + name_of(rival) + " and " +
                  name_of(info.publication_handle));
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
