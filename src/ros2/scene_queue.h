// Messages of the planning scene as they came, until the loop looks at them: bounded in bytes, with
// a count of what found no room. What DDS itself keeps for a reader either forgets without a word
// (KEEP_LAST) or, full, holds up the thread that delivers to all readers, a stop's too (KEEP_ALL).
#pragma once

#include <dds/dds.h>
#include <dds/ddsi/ddsi_serdata.h>

#include <atomic>
#include <cstdint>
#include <memory>
#include <optional>

#include "drover/spsc_ring.h"
#include "drover/time.h"

namespace drover::ros2 {

struct GiveBack {
  void operator()(ddsi_serdata* data) const { ddsi_serdata_unref(data); }
};
/// A message as it was on the wire.
using WireMessage = std::unique_ptr<ddsi_serdata, GiveBack>;

class SceneQueue final {
 public:
  static constexpr std::size_t kMost = 4096;
  /// Some seventy of the longest messages.
  static constexpr std::size_t kMostBytes = std::size_t{4} << 20;
  /// What one costs beside its bytes.
  static constexpr std::size_t kBytesBeside = 256;

  struct Waiting {
    WireMessage message;
    Duration said{};  ///< its DDS time stamp: UTC, since 1970
    std::size_t bytes = 0;
  };

  /// `lost` is told of each that is never looked at.
  explicit SceneQueue(std::atomic<std::uint64_t>& lost) : lost_(lost) {}
  ~SceneQueue();
  SceneQueue(const SceneQueue&) = delete;
  SceneQueue& operator=(const SceneQueue&) = delete;

  /// Takes all that `reader` has, in its order. Any thread, none waits: who comes while another one
  /// takes leaves it to that one.
  void fill(dds_entity_t reader);
  /// Of `bytes`. No room: it is lost. Whoever fills.
  void put(WireMessage message, Duration said, std::size_t bytes);
  /// The oldest. The loop's.
  std::optional<Waiting> pop();
  /// DDS did not give what came.
  bool failed() const { return failed_.load(std::memory_order_relaxed); }

 private:
  void take_all(dds_entity_t reader);

  std::atomic<std::uint64_t>& lost_;
  SpscRing<Waiting, kMost> waiting_;
  std::atomic<std::size_t> bytes_{0};
  std::atomic<std::uint32_t> fills_{0};  ///< that were asked for and are not over
  std::atomic<bool> failed_{false};
};

}  // namespace drover::ros2
