// What is wrong with a CAN bus, as its error frames, its counts and the system tell.
#pragma once

#include <cstdint>

#include "drover/can_frame.h"
#include "drover/fixed_text.h"
#include "drover/time.h"
#include "gateway/can_condition.h"
#include "gateway/strangers.h"

namespace drover::gateway {

class BusState final {
 public:
  /// One that takes no frames for `jammed_after` is as good as gone, though it still hears.
  BusState(const Name& name, Duration jammed_after) : name_(name), jammed_after_(jammed_after) {}

  void on_up();
  void on_lost(const Reason& why) { lost_ = why; }
  void on_frame(const CanFrame& frame, Time received);
  /// How many frames it took and refused so far.
  void on_sent(std::uint64_t sent, std::uint64_t refused, Time now);

  bool lost() const { return !lost_.empty(); }
  /// Nobody on it can be reached, whatever was heard a moment ago.
  bool cut(Time now) const;
  /// In words; empty when all is well.
  Reason trouble(Time now) const;
  std::string_view name() const { return name_; }
  Strangers& strangers() { return strangers_; }

 private:
  bool jammed(Time now) const {
    return jammed_since_ != kNever && now - jammed_since_ >= jammed_after_;
  }

  Name name_;
  Duration jammed_after_;
  CanCondition condition_;
  Strangers strangers_;
  Reason lost_;
  std::uint64_t sent_ = 0;
  std::uint64_t refused_ = 0;
  Time jammed_since_ = kNever;
};

}  // namespace drover::gateway
