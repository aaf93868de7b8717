// When the guard takes the bus: pure, so that it can be tested without processes.
#pragma once

#include <algorithm>
#include <cstdint>

#include "drover/time.h"

namespace drover::guard {

class Watch final {
 public:
  /// What the daemon gets to show itself when the guard was held up too, once for each silence:
  /// then the machine stood still, and the guard with its higher priority runs first.
  static constexpr Duration kGrace = std::chrono::milliseconds(20);

  /// A new set is in force; beats are expected from now on. Does not end a hold.
  void begin(std::uint64_t beats, Duration limit, Time now) {
    watching_ = true;
    limit_ = limit;
    beats_ = beats;
    last_step_ = now;
    hear(now);
  }
  /// A set of the daemon whose beats are counted already: that it is offered is no beat.
  void begin_again(std::uint64_t beats, Duration limit, Time now) {
    if (!watching_ || beats != beats_) return begin(beats, limit, now);
    deadline_ += limit - limit_;
    limit_ = limit;
  }
  /// The daemon's socket closed: it died, however politely. Or somebody stops it from outside, also
  /// before there is a set. It has to ask for the bus.
  void lost() { holds_ = true; }
  /// The daemon asked for the bus. Refused while its heartbeat is late.
  void hand_back(Time now) {
    if (!late(now)) holds_ = false;
  }
  /// Once a cycle of 10 ms: true while stop frames are due.
  bool step(std::uint64_t beats, Time now) {
    if (!watching_) return false;
    const bool held_up = now - last_step_ > kGrace;
    last_step_ = now;
    if (beats != beats_) {
      beats_ = beats;
      hear(now);
    } else if (held_up && !graced_) {
      graced_ = true;
      deadline_ = std::max(deadline_, now + kGrace);
    }
    if (late(now)) holds_ = true;
    return holds_;
  }
  bool late(Time now) const { return watching_ && now > deadline_; }
  Duration age(Time now) const { return now - last_change_; }

 private:
  void hear(Time now) {
    last_change_ = now;
    deadline_ = now + limit_;
    graced_ = false;
  }

  bool watching_ = false;
  bool holds_ = false;
  Duration limit_{};
  std::uint64_t beats_ = 0;
  Time last_change_ = kNever;
  Time deadline_ = kNever;
  Time last_step_ = kNever;
  bool graced_ = false;
};

}  // namespace drover::guard
