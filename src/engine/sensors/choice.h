// Which of several receivers or inertial sensors the robot goes by.
#pragma once

#include <array>

#include "drover/time.h"
#include "engine/config.h"

namespace drover::engine {

/// What is known of one of them.
struct SensorCondition {
  bool well = false;  ///< it is heard, and says what it is there for
  bool fits = true;   ///< it does not contradict the estimate
};
using SensorConditions = std::array<SensorCondition, kMaxOfKind>;

/// The one that steers, until it is not well; then the first spare that is. While the robot moves,
/// only one that fits takes over: otherwise it is as if there were none, and the robot comes to
/// rest for that reason. The one that steers is taken back when it was well for kProved and the
/// robot stands: never while it moves. Nobody is left for somebody who is not well.
class Choice final {
 public:
  static constexpr Duration kProved = std::chrono::seconds(10);
  /// So long after the start one that was never heard may still come.
  static constexpr Duration kBoots = std::chrono::seconds(5);
  /// One that has just taken over is given time: two that fail in turn are not swapped each cycle.
  static constexpr Duration kSettles = std::chrono::seconds(2);

  explicit Choice(const SensorList& all);
  /// `stands`: nobody drives and no wheel turns. True: the choice has changed.
  bool update(Time now, const SensorConditions& candidates, bool stands);
  std::size_t in_use() const { return in_use_; }
  bool is_spare() const { return in_use_ != steers_; }
  std::size_t steers() const { return steers_; }

 private:
  bool take(std::size_t which, Time now);

  SensorList all_;
  std::size_t steers_ = 0;
  std::size_t in_use_ = 0;
  bool was_well_ = false;  ///< the one in use, ever
  Time begun_ = kNever;
  Time changed_ = kNever;
  Time steers_well_since_ = kNever;
};

/// Whether two contradict each other: for a second without a break. They agree again after three.
class Agreement final {
 public:
  void update(Time now, bool apart);
  bool agree() const { return agree_; }

 private:
  bool agree_ = true;
  Time opposite_since_ = kNever;
};

}  // namespace drover::engine
