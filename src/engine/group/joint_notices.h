// Tells the journal of drives of a group that are not heard, or have a fault.
#pragma once

#include <vector>

#include "engine/event_queue.h"

namespace drover::engine {

/// One notice when that begins and one when it is over, of a joint at most one pair a second.
/// Nothing of the first moments, unless it stays so.
class JointNotices final {
 public:
  explicit JointNotices(std::size_t joints) : joints_(joints) {}

  /// `trouble`: of the joint of that number, with its name; empty: none. `said`: the journal has it
  /// already, in other words.
  void update(Time now, std::size_t joint, const Name& group, const Name& name,
              const Reason& trouble, bool said, EventQueue& events);

 private:
  struct Joint {
    bool told = false;
    Time told_at = kNever;
  };
  std::vector<Joint> joints_;  ///< made once
  Time begun_ = kNever;
};

}  // namespace drover::engine
