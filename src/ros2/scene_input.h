// What comes on /collision_object or /planning_constraints, as lines for droverd.
#pragma once

#include <dds/dds.h>

#include <cstdint>
#include <functional>
#include <string>

#include "drover/time.h"
#include "publish/token_bucket.h"

namespace drover::ros2 {

class SceneInput final {
 public:
  enum class Kind : std::uint8_t { objects, constraints };

  /// `reader` goes with its participant. `one_clock`: all writers are on this computer, so that a
  /// message's DDS time stamp tells when it was said.
  SceneInput(dds_entity_t reader, Kind kind, bool one_clock)
      : reader_(reader), kind_(kind), one_clock_(one_clock) {}

  enum class Taken : std::uint8_t { all, some, failed };
  /// Takes of what came since the last look so many that a stop behind them waits for
  /// milliseconds, each in its order. `wall`: UTC now, since 1970.
  [[nodiscard]] Taken take(Time now, Duration wall, const std::function<void(std::string)>& give);
  /// Of a flood: not looked at.
  std::uint64_t passed_over() const { return passed_over_; }

 private:
  std::string line_of(const void* sample, const dds_sample_info_t& info, Time now,
                      Duration wall) const;

  dds_entity_t reader_;
  Kind kind_;
  bool one_clock_;
  /// Somewhat more than droverd takes, so that it tells what is too much.
  publish::TokenBucket pace_{150, 250};
  std::uint64_t passed_over_ = 0;
};

}  // namespace drover::ros2
