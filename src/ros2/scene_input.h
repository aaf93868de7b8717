// What comes on /collision_object or /planning_constraints, as lines for droverd.
#pragma once

#include <dds/dds.h>

#include <atomic>
#include <cstdint>
#include <functional>
#include <string>

#include "drover/time.h"
#include "publish/token_bucket.h"
#include "ros2/scene_queue.h"

namespace drover::ros2 {

class SceneInput final {
 public:
  enum class Kind : std::uint8_t { objects, constraints };

  /// `one_clock`: all writers are on this computer, so that a message's DDS time stamp tells when
  /// it was said. `lost` is told of each message that is never looked at; `wake` is called when
  /// there is something to take.
  SceneInput(Kind kind, bool one_clock, std::atomic<std::uint64_t>& lost,
             std::function<void()> wake)
      : kind_(kind), one_clock_(one_clock), lost_(lost), wake_(std::move(wake)), queue_(lost) {}

  /// Something has come to `reader`: for the thread of DDS that brought it.
  void came(dds_entity_t reader) {
    queue_.fill(reader);
    wake_();
  }

  /// `some`: there may be more.
  enum class Taken : std::uint8_t { all, some, failed };
  /// Takes of what came since the last look so many that a stop behind them waits for
  /// milliseconds, each in its order. `wall`: UTC now, since 1970.
  [[nodiscard]] Taken take(Time now, Duration wall, const std::function<void(std::string)>& give);

 private:
  /// Empty: it cannot be read.
  std::string line_of(const SceneQueue::Waiting& waiting, Time now, Duration wall) const;

  Kind kind_;
  bool one_clock_;
  std::atomic<std::uint64_t>& lost_;
  std::function<void()> wake_;
  SceneQueue queue_;
  /// Somewhat more than droverd takes, so that it tells what is too much.
  publish::TokenBucket pace_{150, 250};
};

}  // namespace drover::ros2
