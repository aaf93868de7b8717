#include "ros2/say.h"

#include <dds/dds.h>

#include <algorithm>
#include <string>

#include "runtime/clock.h"

namespace drover::ros2 {
namespace {

constexpr std::int64_t kBurst = 10;
constexpr std::int64_t kPause_ns = 1'000'000'000;

/// Any thread of the library's; calls are one after the other.
void take_line(void*, const dds_log_data_t* data) {
  static std::int64_t full_at_ns = 0;  // when all of the burst may be used again
  const std::int64_t now_ns = runtime::monotonic_now().time_since_epoch().count();
  if (full_at_ns > now_ns + (kBurst - 1) * kPause_ns) return;
  full_at_ns = std::max(full_at_ns, now_ns) + kPause_ns;
  std::string_view text(data->message, data->size);
  while (text.ends_with('\n')) text.remove_suffix(1);
  const bool bad = (data->priority & (DDS_LC_FATAL | DDS_LC_ERROR)) != 0;
  say(bad ? Level::error : Level::warning, "DDS: " + std::string(text));
}

}  // namespace

void take_over_dds_log() {
  dds_set_log_sink(take_line, nullptr);
  dds_set_trace_sink(take_line, nullptr);
}

}  // namespace drover::ros2
