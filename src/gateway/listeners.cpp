#include "gateway/listeners.h"

#include <algorithm>

namespace drover::gateway {

bool Listeners::matches(std::span<const FrameFilter> filters, const CanFrame& frame) {
  return std::any_of(filters.begin(), filters.end(),
                     [&](const FrameFilter& filter) { return filter.matches(frame); });
}

void Listeners::add(SlotId slot, std::span<const FrameFilter> filters) {
  all_.emplace_back(slot, std::vector(filters.begin(), filters.end()));
  if (std::any_of(filters.begin(), filters.end(),
                  [](const FrameFilter& filter) { return filter.extended; }))
    extended_.push_back(all_.back());
  standard_.clear();
  for (std::uint32_t id = 0; id < kStandardIds; ++id) {
    begin_[id] = static_cast<std::uint32_t>(standard_.size());
    CanFrame frame;
    frame.id = id;
    for (const auto& [who, wants] : all_)
      if (matches(wants, frame)) standard_.push_back(who);
  }
  begin_[kStandardIds] = static_cast<std::uint32_t>(standard_.size());
}

}  // namespace drover::gateway
