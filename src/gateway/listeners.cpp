#include "gateway/listeners.h"

#include <algorithm>

namespace drover::gateway {

bool Listeners::matches(std::span<const FrameFilter> filters, const CanFrame& frame) {
  return std::any_of(filters.begin(), filters.end(),
                     [&](const FrameFilter& filter) { return filter.matches(frame); });
}

void Listeners::add(SlotId slot, std::span<const FrameFilter> filters,
                    std::span<const FrameRule> rules) {
  all_.push_back({slot, {filters.begin(), filters.end()}, {rules.begin(), rules.end()}});
  const auto of_long_ids = [](const auto& item) { return item.extended; };
  if (std::any_of(filters.begin(), filters.end(), of_long_ids)) {
    const bool sends = std::any_of(rules.begin(), rules.end(), of_long_ids);
    extended_.emplace_back(Listener{slot, sends}, all_.back().filters);
  }
  others_.clear();
  for (std::uint32_t id = 0; id < kStandardIds; ++id) {
    Those& those = standard_[id];
    those = {{}, 0, static_cast<std::uint32_t>(others_.size())};
    CanFrame frame;
    frame.id = id;
    const auto of_this_id = [id](const FrameRule& rule) { return !rule.extended && rule.id == id; };
    for (const Device& device : all_) {
      if (!matches(device.filters, frame)) continue;
      const bool sends = std::any_of(device.rules.begin(), device.rules.end(), of_this_id);
      if (those.count++ == 0)
        those.first = {device.slot, sends};
      else
        others_.push_back({device.slot, sends});
    }
  }
}

}  // namespace drover::gateway
