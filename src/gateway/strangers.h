// What speaks on a bus and is none of its devices: two buses that are swapped, or a wrong id.
#pragma once

#include <cstdint>
#include <string_view>

#include "drover/can_frame.h"
#include "drover/fixed_text.h"
#include "drover/fixed_vector.h"
#include "drover/time.h"

namespace drover::gateway {

/// Frames that no device of the bus listens to. Pure; a few of their ids are kept, no counts: what
/// is told stands still while nothing changes.
class Strangers final {
 public:
  void on_frame(const CanFrame& frame, Time received);
  void clear();

  /// Instead of a device that said nothing since `last_heard`; kNever: it never did.
  /// `others_heard`: another device of the bus is. Empty: it is not silent for long enough, or
  /// nobody else speaks.
  Reason text(std::string_view bus, Time last_heard, bool others_heard, Time now) const;

 private:
  struct Id {
    std::uint32_t id = 0;
    bool extended = false;
  };
  /// It was heard already, or nothing more is kept.
  bool knows(const CanFrame& frame) const;

  FixedVector<Id, 4> ids_;
  Time since_ = kNever;
  Time last_ = kNever;
};

}  // namespace drover::gateway
