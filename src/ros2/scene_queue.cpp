#include "ros2/scene_queue.h"

#include <array>
#include <utility>

namespace drover::ros2 {

SceneQueue::~SceneQueue() {
  while (pop()) ++lost_;
}

void SceneQueue::fill(dds_entity_t reader) {
  if (fills_.fetch_add(1, std::memory_order_acq_rel) > 0) return;
  std::uint32_t asked = 1;
  do {
    take_all(reader);
  } while (!fills_.compare_exchange_strong(asked, 0, std::memory_order_acq_rel));
}

void SceneQueue::take_all(dds_entity_t reader) {
  constexpr std::int32_t kAtOnce = 10;
  std::array<ddsi_serdata*, kAtOnce> messages{};
  std::array<dds_sample_info_t, kAtOnce> infos{};
  std::int32_t taken = kAtOnce;
  while (taken == kAtOnce) {
    taken = dds_takecdr(reader, messages.data(), kAtOnce, infos.data(), DDS_ANY_STATE);
    if (taken < 0) failed_.store(true, std::memory_order_relaxed);
    for (std::int32_t i = 0; i < taken; ++i) {
      WireMessage message(messages[i]);
      if (!infos[i].valid_data) continue;
      const std::size_t bytes = ddsi_serdata_size(message.get());
      put(std::move(message), Duration{infos[i].source_timestamp}, bytes);
    }
  }
}

void SceneQueue::put(WireMessage message, Duration said, std::size_t bytes) {
  bytes += kBytesBeside;
  const bool fits = bytes_.load(std::memory_order_relaxed) + bytes <= kMostBytes;
  // Before it can be taken out.
  if (fits) bytes_.fetch_add(bytes, std::memory_order_relaxed);
  if (fits && waiting_.push(Waiting{std::move(message), said, bytes})) return;
  if (fits) bytes_.fetch_sub(bytes, std::memory_order_relaxed);
  ++lost_;
}

std::optional<SceneQueue::Waiting> SceneQueue::pop() {
  Waiting oldest;
  if (!waiting_.pop(oldest)) return std::nullopt;
  bytes_.fetch_sub(oldest.bytes, std::memory_order_relaxed);
  return oldest;
}

}  // namespace drover::ros2
