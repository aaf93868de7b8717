// What DDS has of a topic, sample by sample.
#pragma once

#include <dds/dds.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <string>
#include <string_view>

#include "drover/time.h"

namespace drover::ros2 {

/// Shows `look` up to `kMost` of what has come, in its order. How many it took; negative: DDS gives
/// nothing.
template <std::int32_t kMost, class Look>
[[nodiscard]] std::int32_t take_samples(dds_entity_t reader, const Look& look) {
  std::array<void*, kMost> samples{};
  std::array<dds_sample_info_t, kMost> infos{};
  const auto taken = dds_take(reader, samples.data(), infos.data(), kMost, kMost);
  for (std::int32_t i = 0; i < taken; ++i)
    if (infos[i].valid_data) look(samples[i], infos[i]);
  if (taken > 0) dds_return_loan(reader, samples.data(), taken);
  return taken;
}

/// Said so much later than now, by one clock: that was set back since, and how long ago it was said
/// nobody knows. Less is how two threads read a clock.
constexpr Duration kAhead = std::chrono::milliseconds(100);

/// When it was said, by this computer's monotonic time, of its DDS time stamp `stamp`; its writer
/// shares the clock. `wall`: UTC at `now`, since 1970.
inline Time said_at(Duration stamp, Time now, Duration wall) {
  if (stamp - wall > kAhead) return Time{Duration{1}};
  const Duration age = std::max(wall - stamp, Duration{});
  // A stamp before this computer's start, or none, is as old as can be told.
  return std::max(now - age, Time{Duration{1}});
}

/// The same of a sample.
inline Time said_at(const dds_sample_info_t& info, Time now, Duration wall) {
  return said_at(Duration{info.source_timestamp}, now, wall);
}

/// Why it is not of now, by its DDS time stamp; empty: it is. `wall`: UTC now, since 1970.
inline std::string too_late(const dds_sample_info_t& info, Duration wall, Duration oldest) {
  if (info.source_timestamp <= 0) return "a message has no DDS time stamp";
  const Duration age = wall - Duration{info.source_timestamp};
  if (-age > kAhead)
    return "a message is from after now: the clock was set back, or its DDS time stamp is wrong";
  if (age <= oldest) return {};
  // The same words each time: the journal has a row of them once.
  return "a message came too late: it is more than " +
         std::to_string(oldest / std::chrono::milliseconds(1)) + " ms old";
}

/// A text that may be missing.
inline std::string_view text_of(const char* text) {
  return text == nullptr ? std::string_view() : text;
}

}  // namespace drover::ros2
